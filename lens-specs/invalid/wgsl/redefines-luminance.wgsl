fn luminance(c: vec3f) -> f32 {
    return c.g;
}

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return vec3f(luminance(c));
}
