// Coarse pixels, to push context back or to make it unrecognisable: squares of `2 radius + 1` pixels a side, each the mean
// of its pixels in the lens.

// Side of a square, in pixels.
fn pixelate_side(op: Op) -> f32 {
    return 2.0 * floor(op.b.x + 0.5) + 1.0;
}
