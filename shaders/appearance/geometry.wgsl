// Rays, triangles and what a pixel spans on them.

// A view ray and how it changes by one pixel to the right (x) and down (y). It starts on the anchor (see `view.rs`) and is
// relative to the view's origin there. The direction has length one along the camera's forward axis, so a parameter along
// it is a depth.
struct PixelRay {
    origin: vec3f,
    direction: vec3f,
    origin_dx: vec3f,
    origin_dy: vec3f,
    direction_dx: vec3f,
    direction_dy: vec3f,
    // The point of the picture, in pixels from its top left corner.
    pixel: vec2f,
}

struct TriangleHit {
    // Barycentric coordinates of the ray's hit with the triangle's plane.
    weights: vec3f,
    depth: f32,
}

// One over the largest of a vector's numbers. Vectors are brought to that size before they are multiplied, so that products
// of very small ones and very large ones are numbers.
fn to_unit(v: vec3f) -> f32 {
    let size = abs(v);
    return 1.0 / max(max(size.x, max(size.y, size.z)), 1e-36);
}

// Where a ray meets the plane of a triangle. The caller knows that it does.
fn triangle_hit(origin: vec3f, direction: vec3f, a: vec3f, b: vec3f, c: vec3f) -> TriangleHit {
    let scale = min(to_unit(b - a), to_unit(c - a));
    let ab = (b - a) * scale;
    let ac = (c - a) * scale;
    let p = cross(direction, ac);
    let det = dot(ab, p);
    let inverse = 1.0 / select(det, 1e-30, abs(det) < 1e-30);
    let from_a = (origin - a) * scale;
    let q = cross(from_a, ab);
    let u = dot(from_a, p) * inverse;
    let v = dot(direction, q) * inverse;
    return TriangleHit(vec3f(1.0 - u - v, u, v), dot(ac, q) * inverse / scale);
}

// The unit normal of a triangle of any size; zero for one without area.
fn flat_normal(a: vec3f, b: vec3f, c: vec3f) -> vec3f {
    let across = cross((b - a) * to_unit(b - a), (c - a) * to_unit(c - a));
    let size = length(across);
    if size < 1e-18 {
        return vec3f(0.0);
    }
    return across / size;
}

// Distance in pixels from a pixel's ray to the line through `a` and `b` as the picture shows it.
// The line and the eye span a plane; its distance function is linear over the pixels, so this holds for
// edges that pass behind the eye, too.
fn edge_distance(ray: PixelRay, a: vec3f, b: vec3f) -> f32 {
    let along = (b - a) * to_unit(b - a);
    let scale = to_unit(a - ray.origin);
    let value = edge_function((a - ray.origin) * scale, ray.direction, along);
    let dx = edge_function((a - ray.origin - ray.origin_dx) * scale, ray.direction + ray.direction_dx, along) - value;
    let dy = edge_function((a - ray.origin - ray.origin_dy) * scale, ray.direction + ray.direction_dy, along) - value;
    return abs(value) / max(length(vec2f(dx, dy)), 1e-30);
}

fn edge_function(offset: vec3f, direction: vec3f, along: vec3f) -> f32 {
    return dot(cross(offset, along), direction);
}

// Seen so much edge on, by its sine, a triangle is not seen.
const EDGE_ON: f32 = 1e-4;

// Whether the picture shows the triangle across the edge from `a` to `b`, whose other corner is `d`, beyond the edge, and not
// behind or in front of the triangle with the corner `c`.
fn goes_on_across(ray: PixelRay, a: vec3f, b: vec3f, c: vec3f, d: vec3f) -> bool {
    // The plane of the edge and the eye, which is where all rays of a perspective camera meet.
    var toward = ray.direction;
    let spread = dot(ray.direction_dx, ray.direction_dx);
    if spread > 0.0 {
        toward = a - (ray.origin - ray.direction * (dot(ray.origin_dx, ray.direction_dx) / spread));
    }
    let normal = cross(toward, b - a);
    let own = dot(normal, c - a);
    let other = dot(normal, d - a) * select(1.0, -1.0, own > 0.0);
    return other > EDGE_ON * length(normal) * length(d - a);
}

// Distance in pixels to the nearest corner of a triangle.
fn corner_distance(ray: PixelRay, a: vec3f, b: vec3f, c: vec3f) -> f32 {
    return min(point_distance(ray, a), min(point_distance(ray, b), point_distance(ray, c)));
}

// Distance in pixels from a pixel to a point as the picture shows it; very far for one behind the eye.
fn point_distance(ray: PixelRay, p: vec3f) -> f32 {
    let offset = p - ray.origin;
    // A pixel's steps are at right angles to each other and to the forward axis.
    let forward = normalize(cross(ray.origin_dx + ray.direction_dx, ray.origin_dy + ray.direction_dy));
    let depth = dot(offset, forward);
    let right = ray.origin_dx + ray.direction_dx * depth;
    let down = ray.origin_dy + ray.direction_dy * depth;
    if dot(right, ray.origin_dx + ray.direction_dx) <= 0.0 {
        return 1e9;
    }
    let across = offset - ray.direction * depth;
    return length(vec2f(dot(across, right) / dot(right, right), dot(across, down) / dot(down, down)));
}

// How many units of `uv` a pixel spans: the larger of its two sides, on the plane of the triangle.
fn uv_footprint(ray: PixelRay, a: vec3f, b: vec3f, c: vec3f, uv_a: vec2f, uv_b: vec2f, uv_c: vec2f, size: vec2f) -> f32 {
    let here = triangle_hit(ray.origin, ray.direction, a, b, c).weights;
    let right = triangle_hit(ray.origin + ray.origin_dx, ray.direction + ray.direction_dx, a, b, c).weights - here;
    let down = triangle_hit(ray.origin + ray.origin_dy, ray.direction + ray.direction_dy, a, b, c).weights - here;
    let dx = (uv_a * right.x + uv_b * right.y + uv_c * right.z) * size;
    let dy = (uv_a * down.x + uv_b * down.y + uv_c * down.z) * size;
    return max(length(dx), length(dy));
}

const UV_MESH: u32 = 0u;
const UV_PLANAR_X: u32 = 1u;
const UV_PLANAR_Y: u32 = 2u;
const UV_PLANAR_Z: u32 = 3u;
const UV_BOX: u32 = 4u;
const UV_SPHERE: u32 = 5u;

// Texture coordinates of a projection, for a position mapped to 0..1 over the scene's bounds by its longest
// side. `v` runs down the image, as in glTF.
fn projected_uv(mapping: u32, p: vec3f, normal: vec3f) -> vec2f {
    var axis = mapping;
    if mapping == UV_BOX {
        let n = abs(normal);
        axis = select(select(UV_PLANAR_Z, UV_PLANAR_Y, n.y >= n.z), UV_PLANAR_X, n.x >= n.y && n.x >= n.z);
    }
    switch axis {
        case UV_PLANAR_X: {
            return vec2f(1.0 - p.z, 1.0 - p.y);
        }
        case UV_PLANAR_Y: {
            return vec2f(p.x, p.z);
        }
        case UV_PLANAR_Z: {
            return vec2f(p.x, 1.0 - p.y);
        }
        default: {
            let d = normalize(p - vec3f(0.5) + vec3f(0.0, 1e-9, 0.0));
            return vec2f(0.5 + atan2(d.x, d.z) * 0.15915494, acos(clamp(d.y, -1.0, 1.0)) * 0.31830987);
        }
    }
}

// The direction in which `u` grows over a triangle, with the sign of the bitangent; for primitives without tangents.
fn triangle_tangent(a: vec3f, b: vec3f, c: vec3f, uv_a: vec2f, uv_b: vec2f, uv_c: vec2f, normal: vec3f) -> vec4f {
    let d1 = uv_b - uv_a;
    let d2 = uv_c - uv_a;
    let det = d1.x * d2.y - d2.x * d1.y;
    let along = ((b - a) * d2.y - (c - a) * d1.y) * select(1.0, -1.0, det < 0.0);
    let flat_along = along - normal * dot(normal, along);
    if dot(flat_along, flat_along) < 1e-30 {
        return vec4f(0.0);
    }
    // In glTF v runs down the image, so the bitangent points towards smaller v.
    let across = ((c - a) * d1.x - (b - a) * d2.x) * select(1.0, -1.0, det < 0.0);
    let side = dot(cross(normal, flat_along), across);
    return vec4f(normalize(flat_along), select(-1.0, 1.0, side < 0.0));
}

// A unit normal bent by a normal map's texel (0..1 each). A zero tangent leaves it as it is.
fn bent_normal(normal: vec3f, tangent: vec4f, texel: vec3f, scale: f32) -> vec3f {
    if dot(tangent.xyz, tangent.xyz) < 0.5 {
        return normal;
    }
    let t = normalize(tangent.xyz - normal * dot(normal, tangent.xyz) + vec3f(0.0, 1e-12, 0.0));
    let b = cross(normal, t) * tangent.w;
    let m = texel * 2.0 - vec3f(1.0);
    return normalize(t * (m.x * scale) + b * (m.y * scale) + normal * max(m.z, 1e-3));
}

// A shading normal on the viewer's side: first with the triangle's own, then with the eye.
fn facing_normal(normal: vec3f, geometric: vec3f, view: vec3f) -> vec3f {
    let side = dot(normal, geometric) * dot(geometric, view);
    if side < 0.0 {
        return -normal;
    }
    return normal;
}

// Where a pixel's step to the right and one down lead along a plane.
struct PlaneSteps {
    right: vec3f,
    down: vec3f,
}

// On the plane with `normal` that the ray meets at `depth`. `least`: stands for all that is less of how much the plane
// faces the ray.
fn plane_steps(ray: PixelRay, depth: f32, normal: vec3f, least: f32) -> PlaneSteps {
    let facing = dot(normal, ray.direction);
    let slope = 1.0 / select(facing, least, abs(facing) < least);
    let across_x = ray.origin_dx + ray.direction_dx * depth;
    let across_y = ray.origin_dy + ray.direction_dy * depth;
    let right = across_x - ray.direction * (dot(normal, across_x) * slope);
    let down = across_y - ray.direction * (dot(normal, across_y) * slope);
    return PlaneSteps(right, down);
}

// World lengths that a pixel's step to the right and down span on the plane through `position` with `normal`.
fn position_footprint(ray: PixelRay, position: vec3f, normal: vec3f) -> vec2f {
    let steps = steps_at(ray, position, normal);
    return vec2f(length(steps.right), length(steps.down));
}

// On the plane through `position`, which the ray meets there.
fn steps_at(ray: PixelRay, position: vec3f, normal: vec3f) -> PlaneSteps {
    let depth = dot(position - ray.origin, ray.direction) / dot(ray.direction, ray.direction);
    return plane_steps(ray, depth, normal, 1e-4);
}
