//! The point of a triangle nearest to another.

use glam::DVec3;

/// By the region of the plane that the point is over (Ericson, "Real-Time Collision Detection", 5.1.5).
pub fn nearest_on_triangle(p: DVec3, [a, b, c]: [DVec3; 3]) -> DVec3 {
    let (ab, ac) = (b - a, c - a);
    let [d1, d2] = [ab, ac].map(|side| side.dot(p - a));
    let [d3, d4] = [ab, ac].map(|side| side.dot(p - b));
    let [d5, d6] = [ab, ac].map(|side| side.dot(p - c));
    if d1 <= 0.0 && d2 <= 0.0 {
        return a;
    }
    if d3 >= 0.0 && d4 <= d3 {
        return b;
    }
    if d6 >= 0.0 && d5 <= d6 {
        return c;
    }
    let [va, vb, vc] = [d3 * d6 - d5 * d4, d5 * d2 - d1 * d6, d1 * d4 - d3 * d2];
    if vc <= 0.0 && d1 >= 0.0 && d3 <= 0.0 {
        return a + ab * (d1 / (d1 - d3));
    }
    if vb <= 0.0 && d2 >= 0.0 && d6 <= 0.0 {
        return a + ac * (d2 / (d2 - d6));
    }
    if va <= 0.0 && d4 >= d3 && d5 >= d6 {
        return b + (c - b) * ((d4 - d3) / ((d4 - d3) + (d5 - d6)));
    }
    a + (ab * vb + ac * vc) / (va + vb + vc)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn no_point_of_the_triangle_is_nearer() {
        let corners = [DVec3::new(0.2, -0.1, 0.3), DVec3::new(1.1, 0.4, -0.2), DVec3::new(-0.3, 0.9, 0.1)];
        let steps = || (0..=40).flat_map(|i| (0..=40 - i).map(move |j| (f64::from(i) / 40.0, f64::from(j) / 40.0)));
        for k in 0..343 {
            let p = DVec3::new(f64::from(k % 7), f64::from(k / 7 % 7), f64::from(k / 49)) * 0.5 - 1.5;
            let best = nearest_on_triangle(p, corners).distance(p);
            let of_grid = steps()
                .map(|(u, v)| (corners[0] + (corners[1] - corners[0]) * u + (corners[2] - corners[0]) * v).distance(p))
                .fold(f64::INFINITY, f64::min);
            assert!(best <= of_grid + 1e-12 && best >= of_grid - 0.04, "{p}: {best}, a grid has {of_grid}");
        }
    }
}
