// Draws the edges of triangles, anti-aliased, `width` pixels wide, in `color` or the surface's own colours and light, and
// leaves `fill` of the surface between them. What is not covered hides nothing: edges of far surfaces are seen through near
// ones. With `hidden = false` they are not: a surface of the lens shows its edges only where no nearer surface of the lens
// is, whatever is seen between.

fn wireframe_coverage(op: Op, before: Shaded, spot: Spot) -> Shaded {
    var s = before;
    let wire = select(line_coverage(spot.edge, op.b.x), 0.0, spot.hidden != 0u && (op.flags & HIDES_LINES) != 0u);
    let fill = op.b.y;
    let covered = wire + (1.0 - wire) * fill;
    if (op.flags & HAS_COLOR) != 0u && covered > 0.0 {
        let share = wire / covered;
        s.color = mix(s.color, op.a.rgb, share);
        s.opacity = s.opacity * mix(1.0, op.a.a, share);
    }
    s.coverage = s.coverage * covered;
    return s;
}
