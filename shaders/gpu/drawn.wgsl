// Corners of triangles as passes draw them.

// Some fields of the record of an `Item`.
struct Shown {
    @location(1) row_x: vec4f,
    @location(2) row_y: vec4f,
    @location(3) row_z: vec4f,
    @location(4) base_vertex: u32,
}

fn shown_corner(local: vec3f, shown: Shown) -> vec3f {
    let at = vec4f(local, 1.0);
    return vec3f(dot(shown.row_x, at), dot(shown.row_y, at), dot(shown.row_z, at));
}

// Where a point is drawn; `z`: its place between the planes of what is drawn, 1 to 0, linear in the depth.
fn clip_position(p: vec3f, depth: f32, z: f32) -> vec4f {
    let across = vec2f(dot(p, frame.right.xyz), dot(p, frame.up.xyz));
    let perspective = vec2f(z * frame.drawn_from_eye, frame.anchor + depth);
    let zw = select(vec2f(z, 1.0), perspective, frame.perspective != 0u);
    return vec4f(across * frame.clip_scale + frame.clip_shift * zw.y, zw);
}

// The place of a depth between those planes.
fn place_between_planes(depth: f32) -> f32 {
    return (frame.drawn_far - depth) / (frame.drawn_far - frame.drawn_near);
}
