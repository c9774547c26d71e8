// Draws the faces of parts with many planes: which face each pixel's ray enters by, and which it leaves by. The depth
// itself comes from the face's plane. Faces are cut by the eye's plane only, never by near and far.

// Behind the layers stand the maps: for each pixel of a part's rectangle its entry face plus one and its exit face plus one.
@group(2) @binding(0) var<storage, read_write> layers: array<atomic<u32>>;

struct FaceVarying {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) part: u32,
    @location(1) @interpolate(flat) face: u32,
}

@vertex
fn face_vertex(@location(0) corner: vec3f, @location(1) part: u32, @location(2) face: u32) -> FaceVarying {
    let w = select(1.0, dot(corner, frame.forward.xyz), frame.perspective != 0u);
    let across = vec2f(dot(corner, frame.right.xyz), dot(corner, frame.up.xyz));
    return FaceVarying(vec4f(across * frame.clip_scale + frame.clip_shift * w, 0.5 * w, w), part, face);
}

@fragment
fn face_fragment(in: FaceVarying) -> @location(0) vec2u {
    let pixel = vec2u(in.position.xy);
    let low = parts[in.part].map_min;
    let size = parts[in.part].map_size;
    if all(pixel >= low) && all(pixel < low + size) {
        let rate = plane_crossing(in.part, in.face, lens_ray(sample_point(pixel))).rate;
        let cell = parts[in.part].map_first + 2u * ((pixel.y - low.y) * size.x + pixel.x - low.x);
        // At an edge two faces may meet in one pixel; the choice must not depend on who comes first.
        if rate < 0.0 {
            atomicMax(&layers[cell], in.face + 1u);
        } else if rate > 0.0 {
            atomicMax(&layers[cell + 1u], in.face + 1u);
        }
    }
    // The target is masked: a pass must have one.
    return vec2u(0u);
}
