fn filter_color(c: vec3f, s: Surface) -> vec3f {
    if c.x > 0.0 {
        return c;
    } else if c.x > 1.0 {
        return c * 1.0;
    } else if c.x > 2.0 {
        return c * 2.0;
    } else if c.x > 3.0 {
        return c * 3.0;
    } else if c.x > 4.0 {
        return c * 4.0;
    } else if c.x > 5.0 {
        return c * 5.0;
    } else if c.x > 6.0 {
        return c * 6.0;
    } else if c.x > 7.0 {
        return c * 7.0;
    } else if c.x > 8.0 {
        return c * 8.0;
    } else if c.x > 9.0 {
        return c * 9.0;
    } else if c.x > 10.0 {
        return c * 10.0;
    } else if c.x > 11.0 {
        return c * 11.0;
    } else if c.x > 12.0 {
        return c * 12.0;
    } else if c.x > 13.0 {
        return c * 13.0;
    } else if c.x > 14.0 {
        return c * 14.0;
    } else if c.x > 15.0 {
        return c * 15.0;
    } else if c.x > 16.0 {
        return c * 16.0;
    } else if c.x > 17.0 {
        return c * 17.0;
    } else if c.x > 18.0 {
        return c * 18.0;
    } else if c.x > 19.0 {
        return c * 19.0;
    } else if c.x > 20.0 {
        return c * 20.0;
    } else if c.x > 21.0 {
        return c * 21.0;
    } else if c.x > 22.0 {
        return c * 22.0;
    } else if c.x > 23.0 {
        return c * 23.0;
    } else if c.x > 24.0 {
        return c * 24.0;
    } else if c.x > 25.0 {
        return c * 25.0;
    } else if c.x > 26.0 {
        return c * 26.0;
    } else if c.x > 27.0 {
        return c * 27.0;
    } else if c.x > 28.0 {
        return c * 28.0;
    } else if c.x > 29.0 {
        return c * 29.0;
    } else if c.x > 30.0 {
        return c * 30.0;
    } else if c.x > 31.0 {
        return c * 31.0;
    } else if c.x > 32.0 {
        return c * 32.0;
    } else if c.x > 33.0 {
        return c * 33.0;
    } else if c.x > 34.0 {
        return c * 34.0;
    } else if c.x > 35.0 {
        return c * 35.0;
    } else if c.x > 36.0 {
        return c * 36.0;
    } else if c.x > 37.0 {
        return c * 37.0;
    } else if c.x > 38.0 {
        return c * 38.0;
    } else if c.x > 39.0 {
        return c * 39.0;
    } else if c.x > 40.0 {
        return c * 40.0;
    } else if c.x > 41.0 {
        return c * 41.0;
    } else if c.x > 42.0 {
        return c * 42.0;
    } else if c.x > 43.0 {
        return c * 43.0;
    } else if c.x > 44.0 {
        return c * 44.0;
    } else if c.x > 45.0 {
        return c * 45.0;
    } else if c.x > 46.0 {
        return c * 46.0;
    } else if c.x > 47.0 {
        return c * 47.0;
    } else if c.x > 48.0 {
        return c * 48.0;
    } else if c.x > 49.0 {
        return c * 49.0;
    } else if c.x > 50.0 {
        return c * 50.0;
    } else if c.x > 51.0 {
        return c * 51.0;
    } else if c.x > 52.0 {
        return c * 52.0;
    } else if c.x > 53.0 {
        return c * 53.0;
    } else if c.x > 54.0 {
        return c * 54.0;
    } else if c.x > 55.0 {
        return c * 55.0;
    } else if c.x > 56.0 {
        return c * 56.0;
    } else if c.x > 57.0 {
        return c * 57.0;
    } else if c.x > 58.0 {
        return c * 58.0;
    } else if c.x > 59.0 {
        return c * 59.0;
    } else if c.x > 60.0 {
        return c * 60.0;
    } else if c.x > 61.0 {
        return c * 61.0;
    } else if c.x > 62.0 {
        return c * 62.0;
    } else if c.x > 63.0 {
        return c * 63.0;
    } else if c.x > 64.0 {
        return c * 64.0;
    } else if c.x > 65.0 {
        return c * 65.0;
    } else if c.x > 66.0 {
        return c * 66.0;
    } else if c.x > 67.0 {
        return c * 67.0;
    } else if c.x > 68.0 {
        return c * 68.0;
    } else if c.x > 69.0 {
        return c * 69.0;
    } else if c.x > 70.0 {
        return c * 70.0;
    } else if c.x > 71.0 {
        return c * 71.0;
    } else if c.x > 72.0 {
        return c * 72.0;
    } else if c.x > 73.0 {
        return c * 73.0;
    } else if c.x > 74.0 {
        return c * 74.0;
    } else if c.x > 75.0 {
        return c * 75.0;
    } else if c.x > 76.0 {
        return c * 76.0;
    } else if c.x > 77.0 {
        return c * 77.0;
    } else if c.x > 78.0 {
        return c * 78.0;
    } else if c.x > 79.0 {
        return c * 79.0;
    } else if c.x > 80.0 {
        return c * 80.0;
    } else if c.x > 81.0 {
        return c * 81.0;
    } else if c.x > 82.0 {
        return c * 82.0;
    } else if c.x > 83.0 {
        return c * 83.0;
    } else if c.x > 84.0 {
        return c * 84.0;
    } else if c.x > 85.0 {
        return c * 85.0;
    } else if c.x > 86.0 {
        return c * 86.0;
    } else if c.x > 87.0 {
        return c * 87.0;
    } else if c.x > 88.0 {
        return c * 88.0;
    } else if c.x > 89.0 {
        return c * 89.0;
    } else if c.x > 90.0 {
        return c * 90.0;
    } else if c.x > 91.0 {
        return c * 91.0;
    } else if c.x > 92.0 {
        return c * 92.0;
    } else if c.x > 93.0 {
        return c * 93.0;
    } else if c.x > 94.0 {
        return c * 94.0;
    } else if c.x > 95.0 {
        return c * 95.0;
    } else if c.x > 96.0 {
        return c * 96.0;
    } else if c.x > 97.0 {
        return c * 97.0;
    } else if c.x > 98.0 {
        return c * 98.0;
    } else if c.x > 99.0 {
        return c * 99.0;
    } else if c.x > 100.0 {
        return c * 100.0;
    } else if c.x > 101.0 {
        return c * 101.0;
    } else if c.x > 102.0 {
        return c * 102.0;
    } else if c.x > 103.0 {
        return c * 103.0;
    } else if c.x > 104.0 {
        return c * 104.0;
    } else if c.x > 105.0 {
        return c * 105.0;
    } else if c.x > 106.0 {
        return c * 106.0;
    } else if c.x > 107.0 {
        return c * 107.0;
    } else if c.x > 108.0 {
        return c * 108.0;
    } else if c.x > 109.0 {
        return c * 109.0;
    } else if c.x > 110.0 {
        return c * 110.0;
    } else if c.x > 111.0 {
        return c * 111.0;
    } else if c.x > 112.0 {
        return c * 112.0;
    } else if c.x > 113.0 {
        return c * 113.0;
    } else if c.x > 114.0 {
        return c * 114.0;
    } else if c.x > 115.0 {
        return c * 115.0;
    } else if c.x > 116.0 {
        return c * 116.0;
    } else if c.x > 117.0 {
        return c * 117.0;
    } else if c.x > 118.0 {
        return c * 118.0;
    } else if c.x > 119.0 {
        return c * 119.0;
    } else if c.x > 120.0 {
        return c * 120.0;
    } else if c.x > 121.0 {
        return c * 121.0;
    } else if c.x > 122.0 {
        return c * 122.0;
    } else if c.x > 123.0 {
        return c * 123.0;
    } else if c.x > 124.0 {
        return c * 124.0;
    } else if c.x > 125.0 {
        return c * 125.0;
    } else if c.x > 126.0 {
        return c * 126.0;
    } else if c.x > 127.0 {
        return c * 127.0;
    } else if c.x > 128.0 {
        return c * 128.0;
    } else if c.x > 129.0 {
        return c * 129.0;
    } else if c.x > 130.0 {
        return c * 130.0;
    }
    return c;
}
