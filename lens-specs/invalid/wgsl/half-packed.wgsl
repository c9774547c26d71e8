fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return vec3f(unpack2x16float(u32(s.pixel.x)), 0.0);
}
