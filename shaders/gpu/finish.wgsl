// Puts the mean of a pixel's samples over the background, as straight alpha, encoded as the target asks.
fn finished(front: vec4f) -> vec4f {
    let back = vec4f(frame.background.rgb, 1.0) * frame.background.a;
    let sum = front + back * (1.0 - front.a);
    if sum.a <= 0.0 {
        return vec4f(0.0);
    }
    let straight = sum.rgb / sum.a;
    if frame.target_is_srgb != 0u {
        return vec4f(straight, sum.a);
    }
    let encoded = vec3f(srgb_from_linear(straight.x), srgb_from_linear(straight.y), srgb_from_linear(straight.z));
    return vec4f(encoded, sum.a);
}
