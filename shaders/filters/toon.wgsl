// Light in a few flat steps, as in a drawn film: `levels` of them, evenly spaced up to full light, at which a surface has
// its plain base colour. Colours keep their hue, and nothing is brighter. Over an unlit surface it brings light back.

fn toon_surface(op: Op, before: Surface) -> Surface {
    var s = before;
    s.toon = vec2f(op.b.x, 1.0);
    s.unlit = 0.0;
    return s;
}

// Lit colour in `levels` steps of its brightness against the base colour's.
fn toon_light(lit: vec3f, base: vec3f, levels: f32) -> vec3f {
    let brightness = luminance(lit);
    let shade = brightness / max(luminance(base), 1e-4);
    // The upper end of each step, so that none is black.
    let drawn = (min(floor(shade * levels), levels - 1.0) + 1.0) / levels;
    return lit * (drawn * luminance(base) / max(brightness, 1e-6));
}
