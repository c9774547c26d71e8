// Draws the vertices of meshes as discs, `size` pixels wide, in the surface's own colours and light, and nothing between
// them: dense scans thin out to their samples. Discs lie on the surface around their vertex; what is not covered hides
// nothing.

fn points_coverage(op: Op, before: Shaded, spot: Spot) -> Shaded {
    var s = before;
    s.coverage = s.coverage * disc_coverage(spot.corner, op.b.x);
    return s;
}

// How much of a one-pixel filter a disc covers, at `away` pixels from its middle.
fn disc_coverage(away: f32, size: f32) -> f32 {
    return clamp(0.5 * size + 0.5 - away, 0.0, 1.0) * clamp(size * size, 0.0, 1.0);
}
