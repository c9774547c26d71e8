struct Params {
    // = [1, 0]: where it comes from
    direction: vec3f,
}

fn filter_color(c: vec3f, s: Surface, p: Params) -> vec3f {
    return c * dot(s.normal, p.direction);
}
