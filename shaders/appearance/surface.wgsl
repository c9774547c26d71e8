// A surface sample on its way through a stack: what the filters read and change.
// These files are the one source of appearance: the GPU runs them, the build translates them for the CPU.
// Only plain functions may stand here: no bindings, no textures, no pointers, no derivatives.

// One filter of a lens with its parameters; twin of `plan::Op`.
struct Op {
    kind: u32,
    // Index into the filter textures, for OP_TEXTURE.
    texture: u32,
    flags: u32,
    // Not 0: acts where a later filter of its lens moves content from.
    inner: u32,
    a: vec4f,
    b: vec4f,
    c: vec4f,
}

// Surface stage.
const OP_OPACITY: u32 = 1u;
const OP_UNLIT: u32 = 2u;
const OP_MATERIAL: u32 = 3u;
const OP_TEXTURE: u32 = 4u;
const OP_NORMALS: u32 = 5u;
// Colour stage.
const OP_TINT: u32 = 16u;
const OP_GRAYSCALE: u32 = 17u;
const OP_INVERT: u32 = 18u;
// Coverage stage.
const OP_WIREFRAME: u32 = 32u;

const STAGE_SURFACE: u32 = 0u;
const STAGE_COLOR: u32 = 1u;
const STAGE_COVERAGE: u32 = 2u;

fn op_stage(kind: u32) -> u32 {
    return kind / 16u;
}

const ALPHA_OPAQUE: u32 = 0u;
const ALPHA_MASK: u32 = 1u;
const ALPHA_BLEND: u32 = 2u;

struct Surface {
    // World space.
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
    return mix(lit + s.emissive, base_color(s), s.unlit);
}

// A filter's work on a surface, of which `amount` (0..1) counts: less than 1 near the boundary of a soft lens.
fn faded_surface(before: Surface, after: Surface, amount: f32) -> Surface {
    var s = after;
    s.factor = mix(before.factor, after.factor, amount);
    s.texel = mix(before.texel, after.texel, amount);
    s.metallic = mix(before.metallic, after.metallic, amount);
    s.roughness = mix(before.roughness, after.roughness, amount);
    s.emissive = mix(before.emissive, after.emissive, amount);
    s.opacity = mix(before.opacity, after.opacity, amount);
    s.unlit = mix(before.unlit, after.unlit, amount);
    return s;
}
