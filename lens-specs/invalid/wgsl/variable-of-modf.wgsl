fn filter_color(c: vec3f, s: Surface) -> vec3f {
    var parts = modf(c.x);
    parts.fract *= 2.0;
    return vec3f(parts.fract);
}
