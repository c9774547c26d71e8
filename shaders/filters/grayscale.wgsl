// Takes the colour out and keeps the brightness (BT.709 luminance of linear light); `amount` says how much of it.

fn grayscale_color(op: Op, c: vec3f) -> vec3f {
    return mix(c, vec3f(luminance(c)), op.b.x);
}
