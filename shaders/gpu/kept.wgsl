// What a fragment of the scene leaves: the number of its item plus one, and of its triangle.

struct Kept {
    @location(0) found: vec2u,
}

fn kept(found: vec2u, z: f32) -> Kept {
    return Kept(found);
}
