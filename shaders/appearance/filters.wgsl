// What the filters of `shaders/filters` share. Each of those files may have functions for three stages of the work on a
// fragment: `NAME_surface` before it is lit, `NAME_color` on its lit colour, `NAME_coverage` last. The build joins them
// into `filter_surface`, `filter_color` and `filter_coverage`, which stand at the end.

// The filter has a colour of its own, in `a`.
const HAS_COLOR: u32 = 1u;
// The filter looks its reading up in a colour map.
const MAPPED: u32 = 16u;
// The wires of nearer surfaces of the lens hide those of farther ones.
const HIDES_LINES: u32 = 32u;

// What a filter's reading is of; in the second byte of its flags.
const QUANTITY_NONE: u32 = 0u;
// The normal's part along the scene's up axis.
const QUANTITY_SLOPE: u32 = 1u;
const QUANTITY_DEPTH: u32 = 2u;
const QUANTITY_HEIGHT: u32 = 3u;
// Values at vertices; which of them stands in the upper half of the flags.
const QUANTITY_VERTEX: u32 = 4u;

fn op_quantity(op: Op) -> u32 {
    return (op.flags >> 8u) & 0xffu;
}

fn op_channel(op: Op) -> u32 {
    return op.flags >> 16u;
}

// What a backend has looked up for a filter at a fragment.
struct Reading {
    // Of the filter's texture or colour map, linear light.
    texel: vec4f,
    // The filter's quantity, and by how much it changes over a pixel, at the most.
    value: f32,
    change: f32,
}

// Where a value lies in the filter's range, 0 to 1: from `b.x` on, times `b.y`.
fn in_range(op: Op, value: f32) -> f32 {
    return clamp((value - op.b.x) * op.b.y, 0.0, 1.0);
}

// A value that is linear over a triangle, at a pixel, and by how much it changes over a pixel.
fn value_on_triangle(ray: PixelRay, a: vec3f, b: vec3f, c: vec3f, values: vec3f) -> vec2f {
    let here = triangle_hit(ray.origin, ray.direction, a, b, c).weights;
    let right = triangle_hit(ray.origin + ray.origin_dx, ray.direction + ray.direction_dx, a, b, c).weights;
    let down = triangle_hit(ray.origin + ray.origin_dy, ray.direction + ray.direction_dy, a, b, c).weights;
    let value = dot(values, here);
    // The weights add up to one: only differences between the corners count, so that a large value loses no digits.
    let others = values - vec3f(values.x);
    return vec2f(value, length(vec2f(dot(others, right - here), dot(others, down - here))));
}

// Where a fragment lies on its triangle, in pixels.
struct Spot {
    // From the nearest edge.
    edge: f32,
    // From the nearest corner.
    corner: f32,
    // Not 0: a nearer surface of the filter's lens is in front of it.
    hidden: u32,
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

// Replaces the base colour, texture and all; its alpha multiplies the opacity.
fn with_base_color(before: Surface, color: vec4f) -> Surface {
    var s = before;
    s.factor = vec4f(color.rgb, s.factor.a);
    s.texel = vec4f(1.0, 1.0, 1.0, s.texel.a);
    s.opacity = s.opacity * color.a;
    return s;
}

// Shows a colour as it is, unlit, in place of a surface's own.
fn false_colored(before: Surface, color: vec3f) -> Surface {
    var s = with_base_color(before, vec4f(color, 1.0));
    s.unlit = 1.0;
    return s;
}

// How much of a one-pixel filter a line of `width` pixels covers, at `away` pixels from its middle.
fn line_coverage(away: f32, width: f32) -> f32 {
    let covered = clamp(0.5 * width + 0.5 - away, 0.0, 1.0);
    // A line thinner than a pixel never covers a whole one.
    return min(covered, clamp(width, 0.0, 1.0));
}
