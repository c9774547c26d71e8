// The drawn surface of a lens.

// Twin of `plan::GlassRecord`.
struct Glass {
    // Linear light; alpha multiplies everything.
    color: vec4f,
    opacity: f32,
    rim: f32,
    // Pixels.
    outline: f32,
    // Of the line on the scene where the surface meets it, pixels.
    contact: f32,
}

// Opacity of a lens surface seen at the cosine `facing`, `silhouette` pixels inside its outline.
fn glass_opacity(glass: Glass, facing: f32, silhouette: f32) -> f32 {
    let edge_on = 1.0 - clamp(facing, 0.0, 1.0);
    let body = glass.opacity + glass.rim * edge_on * edge_on * edge_on * edge_on;
    var line = 0.0;
    if glass.outline > 0.0 {
        line = clamp(glass.outline + 0.5 - silhouette, 0.0, 1.0) * clamp(glass.outline, 0.0, 1.0);
    }
    return clamp(max(body, 0.85 * line) * glass.color.a, 0.0, 1.0);
}

// By how much nearer the plane with normal `n` that the ray meets at a depth gets from pixel to pixel.
fn depth_gradient(ray: PixelRay, n: vec3f, depth: f32) -> vec2f {
    let facing = dot(n, ray.direction);
    let slope = 1.0 / select(facing, 1e-20, abs(facing) < 1e-20);
    let along_x = dot(n, ray.direction_dx * depth + ray.origin_dx) * slope;
    let along_y = dot(n, ray.direction_dy * depth + ray.origin_dy) * slope;
    return vec2f(along_x, along_y);
}

// Beyond this depth a half-space has no end: the square of a depth must fit.
const NO_END: f32 = 1e18;

// Pixels from the silhouette of a convex volume, to first order: where the entry and the exit meet; of a half-space, the
// horizon of its plane, where inverse depths are zero.
// The inverse depths of a plane are linear over the picture; where entry and exit lie on one smooth
// surface their difference falls like a square root, which doubles the distance. `eye`: how far the eye is before the
// anchor.
fn silhouette_distance(ray: PixelRay, eye: f32, entry: f32, entry_normal: vec3f, exit: f32, exit_normal: vec3f, smooth_join: u32) -> f32 {
    // Of an orthographic camera depths themselves are. What follows are differences of inverse depths times both depths.
    let perspective = dot(ray.direction_dx, ray.direction_dx) > 0.0;
    if !perspective && (exit > NO_END || entry < -NO_END) {
        return NO_END;
    }
    let end = min(exit, NO_END);
    let ratio = select(1.0, max(end + eye, 1e-20) / max(entry + eye, 1e-20), perspective);
    var slope = depth_gradient(ray, entry_normal, entry) * ratio;
    if exit < NO_END {
        slope -= depth_gradient(ray, exit_normal, end) / ratio;
    }
    let distance = (end - entry) / max(length(slope), 1e-20);
    return select(distance, 0.5 * distance, smooth_join != 0u);
}

// The sine of the angle between two directions that count as one: at less, rounding moves a line by pixels.
const SAME_DIRECTION: f32 = 1e-3;
// By how many times a pixel's width surfaces may part in depth from one pixel to the next for a line at its full width:
// seen more edge on, they may end before they meet.
const STEEPEST: f32 = 8.0;

// Pixels from a fragment to the line where its surface and a lens's meet; very far where the two lie in each other.
// The ray meets the lens `gap` behind the fragment; `lens_normal` is the lens's normal there, and `beside` that of the
// same face beside the fragment, both of any length. Each alone is right to first order and finds lines that are none:
// `lens_normal` along the lens's outline, `beside` in the middle of the lens. Their mean finds none there, and follows
// curved surfaces (the trapezoidal rule).
fn contact_distance(ray: PixelRay, depth: f32, normal: vec3f, gap: f32, lens_normal: vec3f, beside: vec3f) -> f32 {
    if length(cross(normal, beside)) <= SAME_DIRECTION * length(beside) {
        return 1e9;
    }
    let pixel = length(ray.origin_dx + ray.direction_dx * depth);
    let least = abs(gap) * length(ray.direction) / (STEEPEST * pixel);
    let at_hit = plane_distance(ray, depth, normal, gap, lens_normal);
    let at_fragment = plane_distance(ray, depth, normal, gap, beside);
    return max(least, 0.5 * (at_hit + at_fragment));
}

// The same to a plane: how far the fragment is from it, over how much that changes from pixel to pixel along the
// fragment's surface.
fn plane_distance(ray: PixelRay, depth: f32, normal: vec3f, gap: f32, plane_normal: vec3f) -> f32 {
    let steps = plane_steps(ray, depth, normal, 1e-20);
    let change = length(vec2f(dot(plane_normal, steps.right), dot(plane_normal, steps.down)));
    return abs(gap * dot(plane_normal, ray.direction)) / max(change, 1e-30);
}

// A fragment's colour so many pixels from the line where it meets a lens's surface.
fn with_contact_line(color: vec3f, glass: Glass, distance: f32) -> vec3f {
    return mix(color, glass.color.rgb, line_coverage(distance, glass.contact) * glass.color.a);
}
