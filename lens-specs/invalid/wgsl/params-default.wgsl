struct Params {
    strength: f32, // = much: how strong
}

fn filter_color(c: vec3f, s: Surface, p: Params) -> vec3f {
    return c * p.strength;
}
