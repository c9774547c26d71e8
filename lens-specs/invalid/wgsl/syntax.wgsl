fn filter_color(c: vec3f, s: Surface) -> vec3f {
    let grey = luminance(c)
    return vec3f(grey);
}
