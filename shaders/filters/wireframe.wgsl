// Draws the edges of triangles, anti-aliased, `width` pixels wide, in `color` or the surface's own colours and light, and
// leaves `fill` of the surface between them. Where a surface ends or turns away all of the line lies on it. What is not
// covered hides nothing: edges of far surfaces are seen through near ones. With `hidden = false` they are not: a surface of
// the lens shows its edges only where no nearer surface of the lens is, whatever is seen between. `edges = "feature"` leaves
// out those within flat polygons.

fn wireframe_coverage(op: Op, before: Shaded, spot: Spot) -> Shaded {
    var s = before;
    var wire = 0.0;
    if spot.hidden == 0u || (op.flags & HIDES_LINES) == 0u {
        // Beyond a rim nothing can be drawn: the line's other half lies on this side, too.
        wire = max(line_coverage(spot.edge, op.b.x), line_coverage(max(spot.rim - 0.5 * op.b.x, 0.0), op.b.x));
        if (op.flags & FEATURE_EDGES) == 0u {
            wire = max(wire, line_coverage(spot.flat_edge, op.b.x));
        }
    }
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
