// Blurs what is seen in the lens, to push context back: each pixel becomes the mean of those up to `radius` pixels away,
// with the weights of a bell curve. Only pixels of the lens take part, so that nothing leaks over its boundary.

// Of a pixel so far away along a row or a column.
fn blur_weight(op: Op, away: f32) -> f32 {
    let radius = max(op.b.x, 1e-3);
    if abs(away) > radius {
        return 0.0;
    }
    return exp(-2.0 * away * away / (radius * radius));
}
