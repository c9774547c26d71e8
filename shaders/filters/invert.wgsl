// The negative of the picture, as the eye sees it: the encoded colour is inverted. `amount` mixes it in.

fn invert_color(op: Op, c: vec3f) -> vec3f {
    let encoded = vec3f(srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z));
    return mix(c, linear_from_srgb3(vec3f(1.0) - encoded), op.b.x);
}
