// A surface sample on its way through a stack: what the filters read and change.
// These files are the one source of appearance: the GPU runs them, the build translates them for the CPU.
// Only plain functions may stand here: no bindings, no textures, no pointers, no derivatives.

// One filter of a lens with its parameters; twin of `plan::Op`.
struct Op {
    // An OP_... constant: the build numbers the filters.
    kind: u32,
    // Of the filter's image or colour map.
    texture: u32,
    // Its own in the lowest byte, see `filters.wgsl` for the others.
    flags: u32,
    // Not 0: acts where a later filter of its lens moves content from.
    inner: u32,
    a: vec4f,
    b: vec4f,
    c: vec4f,
}

const ALPHA_OPAQUE: u32 = 0u;
const ALPHA_MASK: u32 = 1u;
const ALPHA_BLEND: u32 = 2u;

struct Surface {
    // Relative to the view's origin, along the world's axes.
    position: vec3f,
    // World space, unit length, on the viewer's side.
    normal: vec3f,
    // From the surface to the eye, unit length.
    view: vec3f,
    // Linear light and alpha: the material's factor with the vertex colour, and the base colour texel.
    factor: vec4f,
    texel: vec4f,
    metallic: f32,
    // Perceptual roughness.
    roughness: f32,
    emissive: vec3f,
    occlusion: f32,
    alpha_mode: u32,
    alpha_cutoff: f32,
    // What the stack multiplies the material's alpha by.
    opacity: f32,
    // 0: lit; 1: shown in its base colour, without lighting; between where that fades in.
    unlit: f32,
    // Where it is seen, in pixels from the top left corner of the picture.
    pixel: vec2f,
    // Steps of light, and how much they count.
    toon: vec2f,
    // Colour of pen strokes, and how much they count; how far apart they are, and how wide, in pixels.
    hatch: vec4f,
    hatch_lines: vec2f,
}

fn base_color(s: Surface) -> vec3f {
    return s.factor.rgb * s.texel.rgb;
}

// Opacity of a surface: the material's alpha by its mode, times the stack's.
fn surface_opacity(s: Surface) -> f32 {
    let alpha = s.factor.a * s.texel.a;
    var material = 1.0;
    if s.alpha_mode == ALPHA_MASK {
        material = select(0.0, 1.0, alpha >= s.alpha_cutoff);
    } else if s.alpha_mode == ALPHA_BLEND {
        material = alpha;
    }
    return clamp(material * s.opacity, 0.0, 1.0);
}

// From here on a fragment counts as opaque; products of filtered alphas may miss one by rounding.
const OPAQUE_FROM: f32 = 0.9999;

// What a stack makes of a surface before its colour filters act: lit, or its plain base colour.
fn emitted(s: Surface, lit: vec3f) -> vec3f {
    var color = lit;
    if HAS_TOON && s.toon.y > 0.0 {
        color = mix(lit, toon_light(lit, base_color(s), s.toon.x), s.toon.y);
    }
    color += s.emissive;
    if HAS_HATCH && s.hatch.a > 0.0 {
        color = mix(color, hatched(s, lit), s.hatch.a);
    }
    return mix(color, base_color(s), s.unlit);
}

// A normal that a filter has turned, turned by `amount` (0..1) of it. What no filter turned stays the same to the bit.
fn faded_normal(before: vec3f, after: vec3f, amount: f32) -> vec3f {
    let turn = after - before;
    let between = before + amount * turn;
    // Between opposite normals there is no way that would be the right one.
    if dot(turn, turn) == 0.0 || dot(between, between) < 1e-12 {
        return after;
    }
    return normalize(between);
}

// A filter's work on a surface, of which `amount` (0..1) counts: less than 1 near the boundary of a soft lens.
fn faded_surface(before: Surface, after: Surface, amount: f32) -> Surface {
    var s = after;
    s.factor = mix(before.factor, after.factor, amount);
    s.texel = mix(before.texel, after.texel, amount);
    s.metallic = mix(before.metallic, after.metallic, amount);
    s.roughness = mix(before.roughness, after.roughness, amount);
    s.emissive = mix(before.emissive, after.emissive, amount);
    s.normal = faded_normal(before.normal, after.normal, amount);
    s.occlusion = mix(before.occlusion, after.occlusion, amount);
    s.opacity = mix(before.opacity, after.opacity, amount);
    s.unlit = mix(before.unlit, after.unlit, amount);
    s.toon.y = mix(before.toon.y, after.toon.y, amount);
    s.hatch.a = mix(before.hatch.a, after.hatch.a, amount);
    return s;
}
