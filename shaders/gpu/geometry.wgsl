// Triangles of items, and where a pixel's ray meets them.

// Where an item is shown.
struct Placement {
    row_x: vec4f,
    row_y: vec4f,
    row_z: vec4f,
    base_vertex: u32,
}

struct Triangle {
    a: vec3f,
    b: vec3f,
    c: vec3f,
    // Numbers of the corners within the primitive.
    corners: vec3u,
    placement: Placement,
}

fn placed(placement: Placement, corner: u32) -> vec3f {
    let at = 3u * (placement.base_vertex + corner);
    let p = vec4f(positions[at], positions[at + 1u], positions[at + 2u], 1.0);
    return vec3f(dot(placement.row_x, p), dot(placement.row_y, p), dot(placement.row_z, p));
}

fn fetch_triangle(item: u32, triangle: u32) -> Triangle {
    let at = items[item].first_index + 3u * triangle;
    let corners = vec3u(indices[at], indices[at + 1u], indices[at + 2u]);
    // Read once: where a pass writes to a buffer, compilers may not merge what it reads.
    let placement = Placement(items[item].row_x, items[item].row_y, items[item].row_z, items[item].base_vertex);
    return Triangle(
        placed(placement, corners.x),
        placed(placement, corners.y),
        placed(placement, corners.z),
        corners,
        placement,
    );
}

// The number of a drawn triangle of an item among all: at one depth the lower is in front.
fn triangle_number(item: u32, triangle: u32) -> u32 {
    return items[item].first_triangle + numbers[items[item].first_number + triangle];
}

// A direction of the item's own space, as shown.
fn as_shown(placement: Placement, v: vec3f) -> vec3f {
    return vec3f(dot(placement.row_x.xyz, v), dot(placement.row_y.xyz, v), dot(placement.row_z.xyz, v));
}

// A normal of the item's own space, as shown, of any length. The inverse transposed of the map is, but for a factor,
// the matrix of its cofactors.
fn normal_as_shown(placement: Placement, n: vec3f) -> vec3f {
    let m = unit_rows(placement);
    let turned = vec3f(dot(cross(m[1], m[2]), n), dot(cross(m[2], m[0]), n), dot(cross(m[0], m[1]), n));
    // A mirror turns them round.
    return turned * side_as_shown(placement);
}

// -1 where an item is shown mirrored, else 1.
fn side_as_shown(placement: Placement) -> f32 {
    let m = unit_rows(placement);
    return select(1.0, -1.0, dot(m[0], cross(m[1], m[2])) < 0.0);
}

// The rows of the map, so that the largest number is 1.
fn unit_rows(placement: Placement) -> mat3x3f {
    let largest = max(abs(placement.row_x.xyz), max(abs(placement.row_y.xyz), abs(placement.row_z.xyz)));
    let scale = 1.0 / max(max(largest.x, max(largest.y, largest.z)), 1e-30);
    return mat3x3f(placement.row_x.xyz * scale, placement.row_y.xyz * scale, placement.row_z.xyz * scale);
}

// Where a pixel's ray meets a triangle of an item.
struct Meeting {
    triangle: Triangle,
    hit: TriangleHit,
}

fn meeting(item: u32, triangle: u32, ray: PixelRay) -> Meeting {
    let t = fetch_triangle(item, triangle);
    return Meeting(t, surface_hit(plane_at(item, triangle), ray, t));
}

// The hit of a ray with a triangle that it is known to meet. Seen nearly edge on, the depth stays within the corners'.
// `plane`: see `plane_at`.
fn surface_hit(plane: u32, ray: PixelRay, t: Triangle) -> TriangleHit {
    var hit = triangle_hit(ray.origin, ray.direction, t.a, t.b, t.c);
    let depths = vec3f(dot(t.a, frame.forward.xyz), dot(t.b, frame.forward.xyz), dot(t.c, frame.forward.xyz));
    hit.depth = clamp(hit.depth, min(depths.x, min(depths.y, depths.z)), max(depths.x, max(depths.y, depths.z)));
    if PLANES && plane != NONE {
        hit.depth = plane_depth(plane, ray, hit.depth);
    }
    return hit;
}
