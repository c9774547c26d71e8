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

// Where a point is drawn. In perspective what lies before the near plane is cut off, and nothing behind; `z`: the place
// between the planes, 1 to 0, for an orthographic camera.
fn clip_position(p: vec3f, depth: f32, z: f32) -> vec4f {
    let across = vec2f(dot(p, frame.right.xyz), dot(p, frame.up.xyz));
    let zw = select(vec2f(z, 1.0), vec2f(frame.near, depth), frame.perspective != 0u);
    return vec4f(across * frame.clip_scale + frame.clip_shift * zw.y, zw);
}
