fn filter_color(c: vec3f, s: Surface) -> vec3f {
    if !c.x {
        return s.base_color;
    }
    return c;
}
