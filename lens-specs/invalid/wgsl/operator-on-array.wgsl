fn filter_color(c: vec3f, s: Surface) -> vec3f {
    let weights = array(0.2, 0.7, 0.1);
    return c * weights;
}
