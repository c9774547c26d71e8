// Puts the mean of a pixel's samples over the background, as straight alpha, encoded as the target asks.
fn finished(front: vec4f) -> vec4f {
    var mapped = front;
    if front.a > 0.0 {
        // The background comes out as given.
        mapped = vec4f(tone_mapped(frame.tone_mapping, front.rgb / front.a) * front.a, front.a);
    }
    let back = vec4f(frame.background.rgb, 1.0) * frame.background.a;
    let sum = mapped + back * (1.0 - mapped.a);
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
