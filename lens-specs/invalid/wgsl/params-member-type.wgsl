struct Params {
    strength: f32,
    turn: mat3x3f,
}

fn filter_color(c: vec3f, s: Surface, p: Params) -> vec3f {
    return p.turn * c * p.strength;
}
