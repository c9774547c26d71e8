struct Params {
    strength: f32,
}

fn filter_color(c: vec3f, p: Params, s: Surface) -> vec3f {
    return c * p.strength;
}
