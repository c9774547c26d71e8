// What the screen-space filters share.

// How far a filter looks, in pixels.
fn screen_reach(op: Op) -> f32 {
    if op.kind == OP_BLUR {
        return floor(op.b.x);
    }
    if op.kind == OP_PIXELATE {
        return pixelate_side(op) - 1.0;
    }
    // A line, and the neighbour that makes it one.
    return edges_reach(op) + 1.0;
}

// The weight of another pixel of the same row or column in a filter that takes means.
fn mean_weight(op: Op, at: f32, other: f32) -> f32 {
    if op.kind == OP_PIXELATE {
        return pixelate_weight(op, at, other);
    }
    return blur_weight(op, other - at);
}
