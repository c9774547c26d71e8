// The lower lenses as a ray meets them behind a lens that moves content.

// The lenses below a step that hold the moved point and may mean something to the item.
fn set_below(item: u32, step: u32, ray: PixelRay, depth: f32) -> Set {
    let moved = moved_ray(step_point(step, ray.origin), step_vector(step, ray.direction));
    let rank = steps[step].rank;
    var around = Set();
    for (var w = 0u; w <= rank / 32u; w += 1u) {
        let named = item_mask(item, MASK_SCOPE, w) | item_mask(item, MASK_SHOWN_BY, w);
        var rest = named & by_pixel_word(w);
        if w == rank / 32u {
            rest = rest & ((1u << (rank % 32u)) - 1u);
        }
        while rest != 0u {
            let bit = firstTrailingBit(rest);
            rest = rest & (rest - 1u);
            if holds_depth(32u * w + bit, moved, depth) {
                around.words[w] |= 1u << bit;
            }
        }
    }
    return around;
}
