// Light as pen strokes: lit faces stay plain, and the darker a face, the more lines cross it, in up to three directions.
// Lines are `spacing` pixels apart and `width` pixels wide, in `color`, on the surface's own unlit colour, or over a false
// colour; they lie in the picture, not on the surface.

fn hatch_surface(op: Op, before: Surface) -> Surface {
    var s = before;
    s.hatch = vec4f(op.a.rgb, 1.0);
    s.hatch_lines = op.b.xy;
    s.unlit = 0.0;
    s.opacity = s.opacity * op.a.a;
    return s;
}

// The colour of a hatched surface of which `lit` is the light.
fn hatched(s: Surface, lit: vec3f) -> vec3f {
    let base = base_color(s);
    let shade = luminance(lit + s.emissive) / max(luminance(base), 1e-4);
    let p = s.pixel;
    var ink = hatch_ink(0.7071068 * (p.x + p.y), s.hatch_lines, shade, 0.85);
    ink = max(ink, hatch_ink(0.7071068 * (p.x - p.y), s.hatch_lines, shade, 0.55));
    ink = max(ink, hatch_ink(p.y, s.hatch_lines, shade, 0.3));
    return mix(base, s.hatch.rgb, ink);
}

// Lines of one direction, `across` pixels from the first: where the shade falls below a threshold they grow to their width.
fn hatch_ink(across: f32, lines: vec2f, shade: f32, threshold: f32) -> f32 {
    let turns = across / lines.x;
    let away = abs(turns - floor(turns + 0.5)) * lines.x;
    let grown = clamp((threshold - shade) * 8.0, 0.0, 1.0);
    return line_coverage(away, lines.y * grown);
}
