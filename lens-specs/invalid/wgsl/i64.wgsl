fn filter_color(c: vec3f, s: Surface) -> vec3f {
    var large: i64 = 5;
    return c;
}
