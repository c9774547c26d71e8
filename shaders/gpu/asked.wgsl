// Lenses asked directly, part by part, whether they hold a ray at a depth: where a pixel asks once, and where a ray is
// another one than its pixel's.

// The lenses around a depth on the pixel's own ray, of those that may touch its tile.
fn asked_at(tile: TileRecord, pixel: vec2u, depth: f32) -> Set {
    var around = Set();
    if tile.part_count == 0u {
        return around;
    }
    let ray = lens_ray(sample_point(pixel));
    var entry = 0u;
    loop {
        let asked = part_at(tile, entry, pixel);
        let rank = parts[asked.part].lens;
        var holds = false;
        if !COMPOUNDS || lenses[rank].token_count == 0u {
            holds = part_holds(asked, ray, depth);
            entry += 1u;
        } else {
            // Its parts that do not touch the tile hold nothing.
            inside_parts = array<u32, PART_WORDS>();
            while entry < tile.part_count && parts[part_of_tile(tile, entry)].lens == rank {
                let own = part_at(tile, entry, pixel);
                if part_holds(own, ray, depth) {
                    cross_part(own.part - lenses[rank].first_part);
                }
                entry += 1u;
            }
            holds = program_holds(rank);
        }
        around.words[rank / 32u] |= select(0u, 1u << (rank % 32u), holds);
        continuing {
            break if entry >= tile.part_count;
        }
    }
    return around;
}

// Whether a lens holds a ray at a depth.
fn holds_depth(rank: u32, ray: LensRay, depth: f32) -> bool {
    inside_parts = array<u32, PART_WORDS>();
    for (var i = 0u; i < lenses[rank].part_count; i += 1u) {
        if part_holds(with_all_faces(lenses[rank].first_part + i), ray, depth) {
            cross_part(i);
        }
    }
    return program_holds(rank);
}

// `entry <= depth < exit`, where a boundary as close as two that merge is reached.
fn part_holds(asked: AskedPart, ray: LensRay, depth: f32) -> bool {
    if COMPOUNDS && parts[asked.part].form == FORM_MESH {
        return mesh_holds(asked, ray, depth);
    }
    let span = part_span(asked, ray);
    return span.hit && !starts_boundary(depth, span.entry) && starts_boundary(depth, span.exit);
}

fn mesh_holds(asked: AskedPart, ray: LensRay, depth: f32) -> bool {
    var around = Around(0, 0u);
    if asked.first != NONE {
        for (var i = asked.first; i < asked.end; i += 1u) {
            let crossing = projected_crossing(asked.part, ray.at, tiles[i]);
            if crossing.found && !starts_boundary(depth, crossing.t) {
                around = also_crossed(around, mesh_word(asked.part, tiles[i], crossing.left));
            }
        }
        return is_enclosed(around);
    }
    let line = mesh_line(asked.part, ray);
    var crossing = before_mesh();
    loop {
        crossing = next_in_mesh(asked, line, crossing);
        if !crossing.found {
            break;
        }
        if !starts_boundary(depth, crossing.t) {
            around = also_crossed(around, crossing.word);
        }
    }
    return is_enclosed(around);
}
