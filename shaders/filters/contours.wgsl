// Draws lines of equal height, every `spacing` scene units from 0 on, `width` pixels wide however far they are. `quantity`
// may also be `depth`, `curvature`, or a vertex attribute of the file such as `_TEMPERATURE`; the spacing is in its units.
// Lines lie on the surface, unlit, in `color`; between them it stays as it is. Where lines come closer than three of their
// widths they fade, so that steep faces do not turn black. What is flat and lies at a line's height, a sea or a floor, is no
// line: of the line along its shore the half is drawn that lies on what rises.

fn contours_surface(op: Op, before: Surface, reading: Reading) -> Surface {
    if reading.change <= 0.0 {
        return before;
    }
    let spacing = op.b.z;
    // Values are counted from where it costs no digits; `b.x` brings them back to a whole number of spacings.
    let turns = (reading.value + op.b.x) / spacing;
    // From the nearest line, in pixels.
    let away = abs(turns - floor(turns + 0.5)) * spacing / max(reading.change, 1e-20);
    let pixels_apart = spacing / max(reading.change, 1e-20);
    let crowded = clamp(pixels_apart / (2.0 * max(op.b.w, 1.0)) - 0.5, 0.0, 1.0);
    let line = line_coverage(away, op.b.w) * crowded * op.a.a;
    var s = before;
    s.factor = vec4f(mix(base_color(before), op.a.rgb, line), before.factor.a);
    s.texel = vec4f(1.0, 1.0, 1.0, before.texel.a);
    s.emissive = before.emissive * (1.0 - line);
    s.unlit = mix(before.unlit, 1.0, line);
    return s;
}
