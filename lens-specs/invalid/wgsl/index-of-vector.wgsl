fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c * c[3];
}
