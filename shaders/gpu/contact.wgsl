// The lines where lens surfaces meet a fragment: twin of `cpu/pixel/contact.rs`.

// A fragment's colour under the lines of the lenses that are there for it, the higher lens's on top. Each lens's surface
// counts where the ray crosses it last in front of the fragment, and first behind it.
fn with_contact_lines(color: vec3f, on: Fragment, met: Meeting, tile: TileRecord, pixel: vec2u, ray: PixelRay) -> vec3f {
    let t = met.triangle;
    // All of a cap lies in a lens's surface, and finds no line there but that of other surfaces.
    let normal = select(flat_normal(t.a, t.b, t.c), met.hit.weights, is_cap(on.triangle));
    let at = lens_ray(sample_point(pixel));
    var lined = color;
    var compound = NONE;
    // Parts stand in the order of their lenses.
    for (var i = 0u; i < tile.part_count; i += 1u) {
        let asked = part_at(tile, i, pixel);
        let rank = parts[asked.part].lens;
        if rank == compound || !has_contact_line(rank, on.item) {
            continue;
        }
        var distance = FAR_AWAY;
        if is_compound(rank) {
            compound = rank;
            distance = compound_contact(rank, on, normal, tile, pixel, at, ray);
        } else {
            let span = part_span(asked, at);
            if span.hit && span.exit > on.depth {
                distance = contact(span_end(asked.part, span, 0u), on, normal, at, ray);
            }
            if span.hit && span.entry <= on.depth {
                distance = min(distance, contact(span_end(asked.part, span, 1u), on, normal, at, ray));
            }
        }
        lined = with_contact_line(lined, lenses[rank].glass, distance);
    }
    return lined;
}

fn has_contact_line(rank: u32, item: u32) -> bool {
    let word = rank / 32u;
    let there = item_mask(item, MASK_SCOPE, word) | item_mask(item, MASK_SHOWN_BY, word);
    let drawn = (lenses[rank].flags & LENS_GLASS) != 0u && lenses[rank].glass.contact > 0.0;
    return drawn && (there >> (rank % 32u) & 1u) != 0u;
}

// Pixels from a fragment to the line where it meets a lens of several parts or a mesh.
fn compound_contact(
    rank: u32,
    on: Fragment,
    normal: vec3f,
    tile: TileRecord,
    pixel: vec2u,
    at: LensRay,
    ray: PixelRay,
) -> f32 {
    let first = layers_at(tile, pixel);
    let count = layer_count(tile, pixel);
    // Where the lens begins or ends last in front of the fragment, and first behind it.
    var front = no_glass(0.0, NONE);
    var behind = no_glass(0.0, NONE);
    for (var layer = 1u; layer < count && behind.key == NONE; layer += 1u) {
        let within = holds_lens(layer_set(first, layer), rank);
        if within == holds_lens(layer_set(first, layer - 1u), rank) {
            continue;
        }
        let hit = no_glass(layer_start(first, layer), 2u * rank + select(1u, 0u, within));
        if hit.depth > on.depth {
            behind = hit;
        } else {
            front = hit;
        }
    }
    var distance = FAR_AWAY;
    if front.key != NONE {
        distance = contact(compound_glass(rank, front.key, at, front.depth), on, normal, at, ray);
    }
    if behind.key != NONE {
        distance = min(distance, contact(compound_glass(rank, behind.key, at, behind.depth), on, normal, at, ray));
    }
    return distance;
}

fn holds_lens(around: Set, rank: u32) -> bool {
    return (around.words[rank / 32u] >> (rank % 32u) & 1u) != 0u;
}

// Pixels from a fragment to the line where it meets the surface that the ray crosses in a hit.
fn contact(hit: GlassHit, on: Fragment, normal: vec3f, at: LensRay, ray: PixelRay) -> f32 {
    if !hit.found || !is_drawn(hit) {
        return FAR_AWAY;
    }
    let depth = select(hit.span.entry, hit.span.exit, hit.is_exit);
    let lens_normal = surface_normal(hit.part, at, depth, glass_face(hit));
    let beside = surface_normal(hit.part, at, on.depth, glass_face(hit));
    return contact_distance(ray, on.depth, normal, depth - on.depth, lens_normal, beside);
}
