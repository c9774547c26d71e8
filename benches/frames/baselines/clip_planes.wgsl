// Viega, Conway, Williams and Pausch, "3D Magic Lenses" (1996): the scene is drawn once outside each face of a box,
// cut off by that face's plane, and once inside, cut off by all six.

// Unit normal and offset.
@group(0) @binding(1) var<uniform> planes: array<vec4f, 6>;

struct Outside {
    @invariant @builtin(position) clip: vec4f,
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @builtin(clip_distances) cut: array<f32, 1>,
}

struct Inside {
    @invariant @builtin(position) clip: vec4f,
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
    @builtin(clip_distances) cut: array<f32, 6>,
}

fn distance_to(face: u32, p: vec3f) -> f32 {
    return dot(planes[face].xyz, p) - planes[face].w;
}

// The pass of a face is the instance of its number.
@vertex
fn outside_vertex(
    @location(0) world: vec3f,
    @location(1) normal: vec3f,
    @builtin(instance_index) face: u32,
) -> Outside {
    let v = placed(world, normal);
    return Outside(v.clip, v.position, v.normal, array(distance_to(face, v.position)));
}

@vertex
fn inside_vertex(@location(0) world: vec3f, @location(1) normal: vec3f) -> Inside {
    let v = placed(world, normal);
    var cut: array<f32, 6>;
    for (var face = 0u; face < 6u; face += 1u) {
        cut[face] = -distance_to(face, v.position);
    }
    return Inside(v.clip, v.position, v.normal, cut);
}

@fragment
fn outside(in: Varying) -> @location(0) vec4f {
    return encoded(shaded(in));
}

@fragment
fn inside(in: Varying) -> @location(0) vec4f {
    return encoded(inverted(shaded(in)));
}
