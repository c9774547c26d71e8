// Blurs what is seen in the lens, to push context back: each pixel becomes the mean of those up to `radius` pixels away,
// with the weights of a bell curve. Only pixels of the lens take part, so that nothing leaks over its boundary.

// By how much the bell curve, a cosine, turns from pixel to pixel: it is zero just beyond the radius.
fn blur_turn(op: Op) -> f32 {
    return 3.14159265 / (op.b.x + 1.0);
}

// Of a pixel so far away along a row or a column.
fn blur_weight(op: Op, away: f32) -> f32 {
    return 0.5 + 0.5 * cos(blur_turn(op) * away);
}
