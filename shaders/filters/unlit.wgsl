// Shows a surface in its base colour as it is given, without light and shadow: flat areas to read, or a plain ground for
// other filters. With `color` everything has that colour; its alpha counts towards opacity.

fn unlit_surface(op: Op, before: Surface) -> Surface {
    var s = before;
    s.unlit = 1.0;
    if (op.flags & HAS_COLOR) != 0u {
        s = with_base_color(s, op.a);
    }
    return s;
}
