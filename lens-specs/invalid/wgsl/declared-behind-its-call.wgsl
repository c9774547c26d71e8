fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return brightened(c);
}

fn brightened(c: vec3f) -> vec3f {
    let bright = 2.0 * c;
}
