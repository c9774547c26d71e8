// Ropinski and Hinrichs, "Real-Time Rendering of 3D Magic Lenses Having Arbitrary Convex Shapes" (2004): the lens's
// front and back faces are drawn into two depth maps, then the scene in three passes, each of which keeps what lies
// behind the lens, inside it, or before and beside it. Depths are reverse-Z: nearer is larger, and 0 where no lens is.

@group(0) @binding(1) var front_faces: texture_depth_2d;
@group(0) @binding(2) var back_faces: texture_depth_2d;

@vertex
fn face(@location(0) world: vec3f) -> @invariant @builtin(position) vec4f {
    return scene.clip_from_eye * vec4f(world - scene.eye.xyz, 1.0);
}

fn front_depth(in: Varying) -> f32 {
    return textureLoad(front_faces, vec2u(in.clip.xy), 0);
}

fn back_depth(in: Varying) -> f32 {
    return textureLoad(back_faces, vec2u(in.clip.xy), 0);
}

@fragment
fn behind(in: Varying) -> @location(0) vec4f {
    if in.clip.z > back_depth(in) {
        discard;
    }
    return encoded(shaded(in));
}

@fragment
fn inside(in: Varying) -> @location(0) vec4f {
    if in.clip.z > front_depth(in) || in.clip.z <= back_depth(in) {
        discard;
    }
    return encoded(inverted(shaded(in)));
}

@fragment
fn before(in: Varying) -> @location(0) vec4f {
    if in.clip.z <= front_depth(in) {
        discard;
    }
    return encoded(shaded(in));
}
