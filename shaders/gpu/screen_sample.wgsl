// What filters of the screen are told of a pixel's sample: `resolve.wgsl` writes it, `screen.wgsl` reads and colours it.
// Its size has a twin in `targets.rs`.

const SEEN_CAP: u32 = 0x80000000u;

struct ScreenSample {
    // Premultiplied and linear.
    color: vec4f,
    // Of the visible fragment, like all that follows.
    normal: vec3f,
    depth: f32,
    // The number of its item plus one, with SEEN_CAP where it is a cap; 0: nothing is visible.
    item: u32,
    // Of a cap the number of the filter that draws a line around it, plus one; else 0.
    outline: u32,
    around: Set,
    stack: Set,
}
