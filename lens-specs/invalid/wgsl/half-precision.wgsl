fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return quantizeToF16(c);
}
