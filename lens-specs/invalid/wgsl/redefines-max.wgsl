fn max(a: f32, b: f32, c: f32) -> f32 {
    return select(select(c, b, b > c), a, a > b && a > c);
}

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return vec3f(max(c.x, c.y, c.z));
}
