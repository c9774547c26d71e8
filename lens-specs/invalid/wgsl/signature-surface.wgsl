fn filter_surface(s: Surface) -> vec3f {
    return s.base_color;
}
