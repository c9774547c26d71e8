// What a fragment of the scene leaves: the number of its item plus one, and of its triangle.

struct Drawn {
    @location(0) found: vec2u,
}

fn drawn(found: vec2u, z: f32) -> Drawn {
    return Drawn(found);
}
