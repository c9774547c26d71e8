fn read(start: ptr<private, f32>) -> f32 {
    return *start;
}

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c;
}
