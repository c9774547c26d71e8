// The look of an x-ray picture: surfaces that face the eye clear away, and those seen edge on stay, so that outlines of
// everything stand one behind the other. `strength` is how clear a surface gets face on, from 0 (as it was) to 1 (gone).
// With `color` they glow in it, unlit; without, they keep their own colours and light.

fn ghost_surface(op: Op, before: Surface) -> Surface {
    var s = before;
    if (op.flags & HAS_COLOR) != 0u {
        s = with_base_color(s, op.a);
        s.unlit = 1.0;
    }
    let facing = clamp(abs(dot(s.normal, s.view)), 0.0, 1.0);
    let edge_on = 1.0 - facing;
    s.opacity = s.opacity * mix(1.0, edge_on * edge_on, op.b.x);
    return s;
}
