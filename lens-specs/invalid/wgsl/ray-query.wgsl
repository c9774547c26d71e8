fn filter_color(c: vec3f, s: Surface) -> vec3f {
    var query: ray_query;
    return c;
}
