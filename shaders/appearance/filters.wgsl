// What each built-in filter does to a surface and to a lit colour.

const MATERIAL_COLOR: u32 = 1u;
const MATERIAL_METALLIC: u32 = 2u;
const MATERIAL_ROUGHNESS: u32 = 4u;
const MATERIAL_EMISSIVE: u32 = 8u;

const HAS_COLOR: u32 = 1u;

// The surface stage. `texel` is the filter's own texture at this place, for OP_TEXTURE. The alpha of a
// filter's colour counts towards opacity at whatever stage the colour acts.
fn filter_surface(op: Op, before: Surface, texel: vec4f) -> Surface {
    var s = before;
    switch op.kind {
        case OP_OPACITY: {
            s.opacity = s.opacity * op.a.x;
        }
        case OP_UNLIT: {
            s.unlit = 1.0;
            if (op.flags & HAS_COLOR) != 0u {
                s = with_base_color(s, op.a);
            }
        }
        case OP_MATERIAL: {
            if (op.flags & MATERIAL_COLOR) != 0u {
                s = with_base_color(s, op.a);
            }
            if (op.flags & MATERIAL_METALLIC) != 0u {
                s.metallic = op.b.x;
            }
            if (op.flags & MATERIAL_ROUGHNESS) != 0u {
                s.roughness = op.b.y;
            }
            if (op.flags & MATERIAL_EMISSIVE) != 0u {
                s.emissive = op.c.rgb;
                s.opacity = s.opacity * op.c.a;
            }
        }
        case OP_TEXTURE: {
            s.texel = texel;
        }
        case OP_NORMALS: {
            s.unlit = 1.0;
            let encoded = linear_from_srgb3(s.normal * 0.5 + vec3f(0.5));
            s = with_base_color(s, vec4f(encoded, 1.0));
        }
        case OP_TINT: {
            s.opacity = s.opacity * op.a.a;
        }
        default: {
        }
    }
    return s;
}

// Replaces the base colour, texture and all; its alpha multiplies the opacity.
fn with_base_color(before: Surface, color: vec4f) -> Surface {
    var s = before;
    s.factor = vec4f(color.rgb, s.factor.a);
    s.texel = vec4f(1.0, 1.0, 1.0, s.texel.a);
    s.opacity = s.opacity * color.a;
    return s;
}

// The colour stage, after lighting.
fn filter_color(op: Op, c: vec3f) -> vec3f {
    var result = c;
    switch op.kind {
        case OP_TINT: {
            result = mix(c, op.a.rgb, op.b.x);
        }
        case OP_GRAYSCALE: {
            result = mix(c, vec3f(luminance(c)), op.b.x);
        }
        case OP_INVERT: {
            // Inverted as the eye sees it, on the encoded colour.
            let encoded = vec3f(srgb_from_linear(c.x), srgb_from_linear(c.y), srgb_from_linear(c.z));
            result = mix(c, linear_from_srgb3(vec3f(1.0) - encoded), op.b.x);
        }
        default: {
        }
    }
    return result;
}

// A lit fragment on its way to the picture: straight colour, opacity, coverage.
struct Shaded {
    color: vec3f,
    opacity: f32,
    coverage: f32,
}

// As `faded_surface`, for the coverage stage.
fn faded_shaded(before: Shaded, after: Shaded, amount: f32) -> Shaded {
    return Shaded(
        mix(before.color, after.color, amount),
        mix(before.opacity, after.opacity, amount),
        mix(before.coverage, after.coverage, amount),
    );
}

// The coverage stage of `wireframe`; `edge` is the distance to the nearest triangle edge in pixels.
fn filter_wireframe(op: Op, before: Shaded, edge: f32) -> Shaded {
    var s = before;
    let wire = wire_coverage(edge, op.b.x);
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

// How much of a one-pixel filter a line of `width` pixels covers, at `edge` pixels from its middle.
fn wire_coverage(edge: f32, width: f32) -> f32 {
    let half_width = 0.5 * width;
    let covered = clamp(half_width + 0.5 - edge, 0.0, 1.0);
    // A line thinner than a pixel never covers a whole one.
    return min(covered, clamp(width, 0.0, 1.0));
}
