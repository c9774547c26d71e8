// The surface of a cap, which closes a solid that an eraser cuts.

const CAP_OWN: u32 = 0u;
const CAP_COLOR: u32 = 1u;
const CAP_HATCH: u32 = 2u;

// How a cap looks.
struct Cap {
    kind: u32,
    // Of the solid, whichever lines tell it from its neighbours: see `cap_direction`.
    variant: u32,
    // Linear light, straight alpha.
    color: vec4f,
}

const CAP_ROUGHNESS: f32 = 0.75;

// A cap's surface: `own` is that of the solid's material, without textures. `along` and `span`: see `cap_ink`.
fn cap_surface(cap: Cap, own: Surface, along: f32, span: f32) -> Surface {
    if cap.kind == CAP_OWN {
        return own;
    }
    var s = own;
    s.metallic = 0.0;
    s.roughness = CAP_ROUGHNESS;
    s.emissive = vec3f(0.0);
    s.unlit = 0.0;
    s.alpha_mode = ALPHA_BLEND;
    s.factor = cap.color;
    if cap.kind == CAP_HATCH {
        let ground = mix(vec3f(1.0), cap.color.rgb, CAP_GROUND);
        s.factor = vec4f(mix(ground, cap.color.rgb, cap_ink(along, span)), cap.color.a);
    }
    return s;
}

// How much of the lines' colour the ground has.
const CAP_GROUND: f32 = 0.12;
// Lines along the longest side of the scene.
const CAP_LINES: f32 = 56.0;
// What a line takes of the way to the next.
const CAP_LINE_WIDTH: f32 = 0.24;

// The way across the lines of a hatch, in lines over the longest side of the scene. It lies in no cap's normal: two axes
// count, other than that which the normal follows most. Neighbouring solids differ in slant and density, as drawings have it.
fn cap_direction(normal: vec3f, variant: u32) -> vec3f {
    let n = abs(normal);
    let turn = select(1.0, -1.0, (variant & 1u) != 0u);
    var across = vec3f(1.0, turn, 0.0);
    if n.x >= n.y && n.x >= n.z {
        across = vec3f(0.0, 1.0, turn);
    } else if n.y >= n.z {
        across = vec3f(1.0, 0.0, turn);
    }
    return across * (0.70710678 * CAP_LINES * select(1.0, 1.5, (variant & 2u) != 0u));
}

// How many lines a pixel spans whose steps lead so far.
fn cap_span(steps: PlaneSteps, direction: vec3f) -> f32 {
    return abs(dot(steps.right, direction)) + abs(dot(steps.down, direction));
}

// The share of a pixel that lines cover: `along` lines from the first, where the pixel spans `span` of them. Exact for a
// pixel that is a box across the lines; of lines too fine to be seen their mean is left.
fn cap_ink(along: f32, span: f32) -> f32 {
    let width = max(span, 2e-3);
    return clamp((cap_ink_before(along + 0.5 * width) - cap_ink_before(along - 0.5 * width)) / width, 0.0, 1.0);
}

// How much line there is from the first up to a place.
fn cap_ink_before(along: f32) -> f32 {
    let whole = floor(along);
    return whole * CAP_LINE_WIDTH + min(along - whole, CAP_LINE_WIDTH);
}

// The sides of the triangle that stands for a cap where a ray meets it at a depth: some pixels long.
fn cap_piece(ray: PixelRay, depth: f32) -> f32 {
    return 8.0 * length(ray.origin_dx + ray.direction_dx * depth);
}

// A corner of that triangle: the point where the ray meets it, and two beside it.
fn cap_corner(number: u32, position: vec3f, normal: vec3f, size: f32) -> vec3f {
    let n = abs(normal);
    var least = vec3f(0.0, 0.0, 1.0);
    if n.x <= min(n.y, n.z) {
        least = vec3f(1.0, 0.0, 0.0);
    } else if n.y <= n.z {
        least = vec3f(0.0, 1.0, 0.0);
    }
    var side = normalize(cross(normal, least));
    if number == 2u {
        side = cross(normal, side);
    }
    return position + side * select(size, 0.0, number == 0u);
}
