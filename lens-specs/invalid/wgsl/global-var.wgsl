var strength = 0.5;

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c * strength;
}
