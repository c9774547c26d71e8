// Mixes `amount` of a colour into the lit picture, in linear light. The colour's alpha counts towards opacity.

fn tint_surface(op: Op, before: Surface) -> Surface {
    var s = before;
    s.opacity = s.opacity * op.a.a;
    return s;
}

fn tint_color(op: Op, c: vec3f) -> vec3f {
    return mix(c, op.a.rgb, op.b.x);
}
