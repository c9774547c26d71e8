// Puts the mean of the samples over the background, as straight alpha in sRGB.

@group(2) @binding(0) var<storage, read> accumulated: array<vec4f>;

@vertex
fn whole_target(@builtin(vertex_index) index: u32) -> @builtin(position) vec4f {
    // One triangle that covers everything.
    let corner = vec2f(f32(index & 1u), f32(index >> 1u));
    return vec4f(corner * 4.0 - 1.0, 0.0, 1.0);
}

@fragment
fn finish(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let pixel = vec2u(position.xy);
    let front = accumulated[pixel.y * frame.window_size.x + pixel.x] / f32(frame.samples);
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
