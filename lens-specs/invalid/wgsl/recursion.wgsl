fn halve(x: f32) -> f32 {
    if x < 0.1 {
        return x;
    }
    return halve(0.5 * x);
}

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return vec3f(halve(c.x));
}
