// What the filters of `shaders/filters` share. Each of those files may have functions for three stages of the work on a
// fragment: `NAME_surface` before it is lit, `NAME_color` on its lit colour, `NAME_coverage` last. The build joins them
// into `filter_surface`, `filter_color` and `filter_coverage`, which stand at the end.

// The filter has a colour of its own, in `a`.
const HAS_COLOR: u32 = 1u;
// The filter looks its reading up in a colour map.
const MAPPED: u32 = 16u;
// The wires of nearer surfaces of the lens hide those of farther ones.
const HIDES_LINES: u32 = 32u;
// Edges within flat polygons have no wires.
const FEATURE_EDGES: u32 = 64u;

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

// Values of a triangle's corners that differ by no more than this share of the numbers they come from are one value: some
// steps of f32.
const SAME_VALUE: f32 = 1e-6;

// The largest of three numbers, whatever their signs.
fn largest(v: vec3f) -> f32 {
    return max(abs(v.x), max(abs(v.y), abs(v.z)));
}

// A value that is linear over a triangle, at a pixel, and by how much it changes over a pixel: not at all where the corners
// have one value. `size`: of the numbers that the values come from.
fn value_on_triangle(ray: PixelRay, a: vec3f, b: vec3f, c: vec3f, values: vec3f, size: f32) -> vec2f {
    let here = triangle_hit(ray.origin, ray.direction, a, b, c).weights;
    let right = triangle_hit(ray.origin + ray.origin_dx, ray.direction + ray.direction_dx, a, b, c).weights;
    let down = triangle_hit(ray.origin + ray.origin_dy, ray.direction + ray.direction_dy, a, b, c).weights;
    let value = dot(values, here);
    // The weights add up to one: only differences between the corners count, so that a large value loses no digits.
    let others = values - vec3f(values.x);
    if max(abs(others.y), max(abs(others.z), abs(others.z - others.y))) <= SAME_VALUE * size {
        return vec2f(value, 0.0);
    }
    return vec2f(value, length(vec2f(dot(others, right - here), dot(others, down - here))));
}

// Where a fragment lies on its triangle, in pixels.
struct Spot {
    // From the nearest edge where the surface turns and goes on; where it is flat; where it ends or turns away.
    edge: f32,
    flat_edge: f32,
    rim: f32,
    // From the nearest corner.
    corner: f32,
    // Not 0: a nearer surface of the filter's lens is in front of it.
    hidden: u32,
}

// What lies across an edge of a triangle: nothing, or another triangle that turns, or one that lies in the same plane.
const ACROSS_NOTHING: u32 = 0u;
const ACROSS_TURNED: u32 = 1u;
const ACROSS_FLAT: u32 = 2u;

// The same with one more edge of its triangle, from `a` to `b`. `opposite`: that corner of the triangle across which is not
// on the edge.
fn spot_by_edge(before: Spot, ray: PixelRay, a: vec3f, b: vec3f, c: vec3f, across: u32, opposite: vec3f) -> Spot {
    let away = edge_distance(ray, a, b);
    var spot = before;
    if across == ACROSS_FLAT {
        spot.flat_edge = min(spot.flat_edge, away);
    } else if across == ACROSS_TURNED && goes_on_across(ray, a, b, c, opposite) {
        spot.edge = min(spot.edge, away);
    } else {
        spot.rim = min(spot.rim, away);
    }
    return spot;
}

// The same with an edge of the triangle across, from an end of an edge to the corner opposite: of a triangle that meets a line
// with a corner alone part lies under the line, too. `p`: the surface's position.
fn spot_by_edge_beyond(
    before: Spot,
    ray: PixelRay,
    p: vec3f,
    end: vec3f,
    opposite: vec3f,
    across: u32,
    beyond: u32,
) -> Spot {
    var spot = before;
    // Where the surface turns at all edges its own lines are there already.
    let matters = beyond == ACROSS_NOTHING || (across == ACROSS_FLAT && beyond == ACROSS_TURNED);
    if across == ACROSS_NOTHING || !matters {
        return spot;
    }
    let side = opposite - end;
    let along = dot(p - end, side) / max(dot(side, side), 1e-30);
    var away = edge_distance(ray, end, opposite);
    if along < 0.0 {
        away = point_distance(ray, end);
    } else if along > 1.0 {
        away = point_distance(ray, opposite);
    }
    if beyond == ACROSS_NOTHING {
        spot.rim = min(spot.rim, away);
    } else {
        spot.edge = min(spot.edge, away);
    }
    return spot;
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
