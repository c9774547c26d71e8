// What all baselines share: the mesh's place in the picture, and its material in the picture's light. It follows
// `shaders/gpu/shade.wgsl` for a mesh with normals and without textures; the functions that it calls are lenspeel's.
// Positions are relative to the eye, along the world's axes.

struct Scene {
    clip_from_eye: mat4x4f,
    eye: vec4f,
    // The up direction of ambient light; its strength.
    ambient: vec4f,
    base_color: vec4f,
    metallic: f32,
    roughness: f32,
    light_count: u32,
    pad: u32,
    lights: array<Light, 8>,
}

@group(0) @binding(0) var<uniform> scene: Scene;

struct Varying {
    @invariant @builtin(position) clip: vec4f,
    @location(0) position: vec3f,
    @location(1) normal: vec3f,
}

@vertex
fn vertex(@location(0) world: vec3f, @location(1) normal: vec3f) -> Varying {
    return placed(world, normal);
}

fn placed(world: vec3f, normal: vec3f) -> Varying {
    let position = world - scene.eye.xyz;
    return Varying(scene.clip_from_eye * vec4f(position, 1.0), position, normal);
}

// Linear light that the mesh sends to the eye.
fn shaded(in: Varying) -> vec3f {
    var s: Surface;
    s.position = in.position;
    s.view = -normalize(in.position);
    // The triangle's own normal, whichever way it points.
    let geometric = cross(dpdx(in.position), dpdy(in.position));
    s.normal = facing_normal(normalize(in.normal), geometric, s.view);
    s.factor = scene.base_color;
    s.texel = vec4f(1.0);
    s.metallic = scene.metallic;
    s.roughness = scene.roughness;
    s.occlusion = 1.0;
    var sum = ambient_light(s, scene.ambient.w, scene.ambient.xyz);
    for (var i = 0u; i < scene.light_count; i += 1u) {
        sum += lit_by(scene.lights[i], s);
    }
    return emitted(s, sum);
}

// For a target that does not encode by itself.
fn encoded(color: vec3f) -> vec4f {
    return vec4f(srgb_from_linear(color.x), srgb_from_linear(color.y), srgb_from_linear(color.z), 1.0);
}

fn inverted(color: vec3f) -> vec3f {
    return filter_color(Op(OP_INVERT, 0u, 0u, 0u, vec4f(0.0), vec4f(1.0), vec4f(0.0)), color);
}
