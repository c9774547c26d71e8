fn filter_color(c: vec4f, s: Surface) -> vec4f {
    return c;
}
