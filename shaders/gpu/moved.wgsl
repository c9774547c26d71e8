// The lower lenses as a ray meets them behind a lens that moves content.

fn step_point(step: u32, p: vec3f) -> vec3f {
    let q = vec4f(p, 1.0);
    return vec3f(dot(steps[step].row_x, q), dot(steps[step].row_y, q), dot(steps[step].row_z, q));
}

fn step_vector(step: u32, v: vec3f) -> vec3f {
    return vec3f(dot(steps[step].row_x.xyz, v), dot(steps[step].row_y.xyz, v), dot(steps[step].row_z.xyz, v));
}

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

// How an item's ray is moved before the lens of a rank is asked: the number of the step plus one, or 0. `inner`: for a
// filter that stands before those of its own lens that move.
fn step_before(item: u32, rank: u32, inner: bool) -> u32 {
    var found = 0u;
    let first = items[item].first_step;
    for (var step = first; step < first + items[item].step_count; step += 1u) {
        if steps[step].rank > rank || (inner && steps[step].rank == rank) {
            found = step + 1u;
        }
    }
    return found;
}
