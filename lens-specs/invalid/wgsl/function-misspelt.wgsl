fn filter_colour(c: vec3f, s: Surface) -> vec3f {
    return c;
}
