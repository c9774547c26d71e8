// Multiplies the lit colour by `amount`, in linear light: 1 changes nothing, 0 is black, 2 is one photographic stop more.

fn brightness_color(op: Op, c: vec3f) -> vec3f {
    return c * op.b.x;
}
