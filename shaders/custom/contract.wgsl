// What every filter file (`wgsl` in a spec) finds declared: the surface it is called for, and a few helpers.
// Colours are linear light.

struct Surface {
    // World space, scene units.
    position: vec3f,
    // World space, unit length, on the viewer's side.
    normal: vec3f,
    // From the surface to the eye, unit length.
    view: vec3f,
    base_color: vec3f,
    metallic: f32,
    // Perceptual roughness.
    roughness: f32,
    emissive: vec3f,
    occlusion: f32,
    // 0: removed; 1: opaque.
    opacity: f32,
    // 0: lit; 1: shown in its base colour, without lighting.
    unlit: f32,
    // Of the picture, from its top left corner, pixels.
    pixel: vec2f,
    // Along the camera's forward axis, scene units.
    depth: f32,
}

// The sRGB transfer function of IEC 61966-2-1, each channel clamped to 0..1.
fn srgb_from_linear(c: vec3f) -> vec3f {
    let x = clamp(c, vec3f(0.0), vec3f(1.0));
    return select(1.055 * pow(x, vec3f(1.0 / 2.4)) - 0.055, x * 12.92, x <= vec3f(0.0031308));
}

// Its inverse.
fn linear_from_srgb(c: vec3f) -> vec3f {
    let x = clamp(c, vec3f(0.0), vec3f(1.0));
    return select(pow((x + 0.055) / 1.055, vec3f(2.4)), x / 12.92, x <= vec3f(0.04045));
}

// Relative luminance of BT.709 primaries.
fn luminance(c: vec3f) -> f32 {
    return dot(c, vec3f(0.2126, 0.7152, 0.0722));
}

// A number from 0 to 1 for each cell of the integer grid, the same on every machine: it is computed in whole
// numbers (PCG3D, Jarzynski and Olano 2020).
fn hash3(cell: vec3i) -> f32 {
    var v = bitcast<vec3u>(cell) * 1664525u + 1013904223u;
    v.x += v.y * v.z;
    v.y += v.z * v.x;
    v.z += v.x * v.y;
    v ^= v >> vec3u(16u);
    v.x += v.y * v.z;
    return f32(v.x >> 8u) / 16777216.0;
}

// Smooth noise from 0 to 1; its lumps are about one unit wide.
fn noise3(p: vec3f) -> f32 {
    let low = floor(p);
    let t = p - low;
    let w = t * t * (3.0 - 2.0 * t);
    let cell = vec3i(low);
    let x00 = mix(hash3(cell), hash3(cell + vec3i(1, 0, 0)), w.x);
    let x10 = mix(hash3(cell + vec3i(0, 1, 0)), hash3(cell + vec3i(1, 1, 0)), w.x);
    let x01 = mix(hash3(cell + vec3i(0, 0, 1)), hash3(cell + vec3i(1, 0, 1)), w.x);
    let x11 = mix(hash3(cell + vec3i(0, 1, 1)), hash3(cell + vec3i(1, 1, 1)), w.x);
    return mix(mix(x00, x10, w.y), mix(x01, x11, w.y), w.z);
}

// How much of a stripe there is at x: stripes repeat each unit, lie around the whole numbers and take up `width`
// (0..1) of it. Their edges are blended over `footprint`, what a pixel spans of x; where that nears a whole stripe,
// all is the mean.
fn stripe(x: f32, width: f32, footprint: f32) -> f32 {
    let soft = max(footprint, 1e-6);
    let from_middle = abs(fract(x + 0.5) - 0.5);
    let covered = clamp((0.5 * width - from_middle) / soft + 0.5, 0.0, 1.0);
    return mix(covered, width, smoothstep(0.5, 1.0, footprint));
}
