// What a fragment of the scene leaves where simplified versions are shown: what fills gaps between them gives way to what
// lies a little farther from the eye. And where a scene is very wide: depths are finest around the anchor.

struct Kept {
    @location(0) found: vec2u,
    @builtin(frag_depth) z: f32,
}

fn kept(found: vec2u, z: f32) -> Kept {
    return Kept(found, z);
}
