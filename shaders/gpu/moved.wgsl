// The lower lenses as a ray meets them behind a lens that moves content: they are asked directly, part by part.

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

// Whether a lens holds a ray at a depth: `entry <= depth < exit`, where a boundary as close as two that merge is reached.
fn holds_depth(rank: u32, ray: LensRay, depth: f32) -> bool {
    inside_parts = array<u32, PART_WORDS>();
    for (var i = 0u; i < lenses[rank].part_count; i += 1u) {
        let part = lenses[rank].first_part + i;
        if COMPOUNDS && parts[part].form == FORM_MESH {
            cross_mesh(part, i, ray, depth);
            continue;
        }
        let span = part_span(part, ray);
        if span.hit && !starts_boundary(depth, span.entry) && starts_boundary(depth, span.exit) {
            cross_part(i);
        }
    }
    return program_holds(rank);
}

fn cross_mesh(part: u32, number: u32, ray: LensRay, depth: f32) {
    let line = mesh_line(part, ray);
    var crossing = before_mesh();
    loop {
        crossing = next_in_mesh(part, line, crossing);
        if !crossing.found {
            break;
        }
        if !starts_boundary(depth, crossing.t) {
            cross_part(number);
        }
    }
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
