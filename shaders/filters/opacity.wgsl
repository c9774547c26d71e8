// Makes surfaces see-through: what a stack leaves of the material's alpha is multiplied by `value`. 1 changes nothing,
// and 0 takes the surface away. Factors of several lenses multiply, in any order.

fn opacity_surface(op: Op, before: Surface) -> Surface {
    var s = before;
    s.opacity = s.opacity * op.a.x;
    return s;
}
