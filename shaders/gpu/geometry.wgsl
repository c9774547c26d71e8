// Triangles of items, and where a pixel's ray meets them.

struct Triangle {
    a: vec3f,
    b: vec3f,
    c: vec3f,
    // Numbers of the corners within the primitive.
    corners: vec3u,
}

fn to_eye(item: u32, local: vec3f) -> vec3f {
    let p = vec4f(local, 1.0);
    return vec3f(dot(items[item].row_x, p), dot(items[item].row_y, p), dot(items[item].row_z, p));
}

fn vertex_position(item: u32, corner: u32) -> vec3f {
    let at = 3u * (items[item].base_vertex + corner);
    return to_eye(item, vec3f(positions[at], positions[at + 1u], positions[at + 2u]));
}

fn fetch_triangle(item: u32, triangle: u32) -> Triangle {
    let at = items[item].first_index + 3u * triangle;
    let corners = vec3u(indices[at], indices[at + 1u], indices[at + 2u]);
    return Triangle(
        vertex_position(item, corners.x),
        vertex_position(item, corners.y),
        vertex_position(item, corners.z),
        corners,
    );
}

// Where a pixel's ray meets a triangle of an item.
struct Meeting {
    triangle: Triangle,
    hit: TriangleHit,
}

fn meeting(item: u32, triangle: u32, ray: PixelRay) -> Meeting {
    let t = fetch_triangle(item, triangle);
    return Meeting(t, surface_hit(ray, t));
}

// The hit of a ray with a triangle that it is known to meet. Seen nearly edge on, the depth stays within the corners'.
fn surface_hit(ray: PixelRay, t: Triangle) -> TriangleHit {
    var hit = triangle_hit(ray.origin, ray.direction, t.a, t.b, t.c);
    let depths = vec3f(dot(t.a, frame.forward.xyz), dot(t.b, frame.forward.xyz), dot(t.c, frame.forward.xyz));
    hit.depth = clamp(hit.depth, min(depths.x, min(depths.y, depths.z)), max(depths.x, max(depths.y, depths.z)));
    return hit;
}
