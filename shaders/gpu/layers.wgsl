// Cuts the ray of each pixel that lenses touch into layers (SEMANTICS section 2).

@group(2) @binding(0) var<storage, read_write> layers: array<u32>;
// Two counters a sample; the second: for how many crossings with one mesh there must be room.
@group(2) @binding(1) var<storage, read_write> needed: array<atomic<u32>>;

const LAYER_WORDS: u32 = 1u + WORDS;

// Where the boundaries of a pixel are gathered: behind slot `first` stand `count` of them, sorted.
struct Gathering {
    at: u32,
    first: u32,
    count: u32,
}

// While they are gathered, boundaries stand where the layers will: slot i holds a depth and a lens (or, while a lens
// is worked on, the number of its part).
fn slot_at(at: u32, slot: u32) -> u32 {
    return at + 1u + slot * LAYER_WORDS;
}

fn put_boundary(g: ptr<function, Gathering>, depth: f32, number: u32) {
    var slot = (*g).first + (*g).count;
    // Insertion by depth, then number, from the back.
    while slot > (*g).first {
        let before = slot_at((*g).at, slot);
        let other = bitcast<f32>(layers[before]);
        if other < depth || (other == depth && layers[before + 1u] < number) {
            break;
        }
        layers[before + LAYER_WORDS] = layers[before];
        layers[before + LAYER_WORDS + 1u] = layers[before + 1u];
        slot -= 1u;
    }
    let here = slot_at((*g).at, slot + 1u);
    layers[here] = bitcast<u32>(depth);
    layers[here + 1u] = number;
    (*g).count += 1u;
}

// The same without its order, for `sort_boundaries`.
fn append_boundary(g: ptr<function, Gathering>, depth: f32, number: u32) {
    (*g).count += 1u;
    write_slot((*g).at, (*g).first + (*g).count, vec2u(bitcast<u32>(depth), number));
}

fn read_slot(at: u32, slot: u32) -> vec2u {
    let here = slot_at(at, slot);
    return vec2u(layers[here], layers[here + 1u]);
}

fn write_slot(at: u32, slot: u32, boundary: vec2u) {
    let here = slot_at(at, slot);
    layers[here] = boundary.x;
    layers[here + 1u] = boundary.y;
}

fn is_sooner(a: vec2u, b: vec2u) -> bool {
    let p = bitcast<f32>(a.x);
    let q = bitcast<f32>(b.x);
    return p < q || (p == q && a.y < b.y);
}

// Heapsort: a lens of a thousand parts may have as many boundaries on a ray.
fn sort_boundaries(g: Gathering) {
    var unsorted = g.count;
    var root = g.count / 2u;
    while unsorted > 1u {
        var moved: vec2u;
        if root > 0u {
            moved = read_slot(g.at, g.first + root);
            root -= 1u;
        } else {
            // The latest of the heap goes behind it.
            moved = read_slot(g.at, g.first + unsorted);
            write_slot(g.at, g.first + unsorted, read_slot(g.at, g.first + 1u));
            unsorted -= 1u;
        }
        var hole = root + 1u;
        while 2u * hole <= unsorted {
            var child = 2u * hole;
            var later = read_slot(g.at, g.first + child);
            if child < unsorted {
                let other = read_slot(g.at, g.first + child + 1u);
                if is_sooner(later, other) {
                    child += 1u;
                    later = other;
                }
            }
            if !is_sooner(moved, later) {
                break;
            }
            write_slot(g.at, g.first + hole, later);
            hole = child;
        }
        write_slot(g.at, g.first + hole, moved);
    }
}

fn put_layer(at: u32, layer: u32, depth: f32, around: Set) {
    let here = slot_at(at, layer);
    layers[here] = bitcast<u32>(depth);
    for (var w = 0u; w < WORDS; w += 1u) {
        layers[here + 1u + w] = around.words[w];
    }
}

fn flip(around: ptr<function, Set>, rank: u32) {
    (*around).words[rank / 32u] ^= 1u << (rank % 32u);
}

// The boundaries of a lens that is one convex part.
fn put_simple(g: ptr<function, Gathering>, around: ptr<function, Set>, asked: AskedPart, ray: LensRay) {
    let rank = parts[asked.part].lens;
    let span = part_span(asked, ray);
    let entry = max(span.entry, frame.near);
    let exit = min(span.exit, frame.far);
    if !span.hit || entry >= exit {
        return;
    }
    if entry > frame.near {
        put_boundary(g, entry, rank);
    } else {
        flip(around, rank);
    }
    if exit < frame.far {
        put_boundary(g, exit, rank);
    }
}

// A ray enters or leaves a part.
fn put_crossing(g: ptr<function, Gathering>, number: u32, depth: f32) {
    if depth <= frame.near {
        cross_part(number);
    } else if depth < frame.far {
        append_boundary(g, depth, number);
    }
}

fn put_part(g: ptr<function, Gathering>, asked: AskedPart, number: u32, ray: LensRay) {
    let part = asked.part;
    if parts[part].form != FORM_MESH {
        let span = part_span(asked, ray);
        if span.hit {
            put_crossing(g, number, span.entry);
            put_crossing(g, number, span.exit);
        }
        return;
    }
    // All crossings stand behind those of the parts before; then only those are kept at which the ray enters or leaves. None
    // is overwritten before it has been read.
    let line = mesh_line(part, ray);
    var own = Gathering((*g).at, (*g).first + (*g).count, 0u);
    var around = Around(0, 0u);
    var crossing = before_mesh();
    var count = 0u;
    loop {
        crossing = next_in_mesh(asked, line, crossing);
        if !crossing.found {
            break;
        }
        if count < parts[part].crossing_room {
            if crossing.t <= frame.near {
                around = also_crossed(around, crossing.word);
            } else if crossing.t < frame.far {
                put_boundary(&own, crossing.t, crossing.word);
            }
        }
        count += 1u;
    }
    if is_enclosed(around) {
        cross_part(number);
    }
    for (var i = 1u; i <= own.count; i += 1u) {
        let at = slot_at(own.at, own.first + i);
        let was_enclosed = is_enclosed(around);
        around = also_crossed(around, layers[at + 1u]);
        if was_enclosed != is_enclosed(around) {
            append_boundary(g, bitcast<f32>(layers[at]), number);
        }
    }
    if count > parts[part].crossing_room {
        // The frame is drawn again with more room.
        atomicMax(&needed[2u * frame.sample_index + 1u], count);
    }
}

// The boundaries of a lens of several parts or a mesh, whose parts on the tile are those from `entry` on; returns how
// many those are. Only where the lens as a whole begins or ends is its boundary.
fn put_compound(
    g: ptr<function, Gathering>,
    around: ptr<function, Set>,
    tile: TileRecord,
    entry: u32,
    pixel: vec2u,
    ray: LensRay,
) -> u32 {
    let rank = parts[part_of_tile(tile, entry)].lens;
    inside_parts = array<u32, PART_WORDS>();
    // Crossings of parts stand behind the boundaries gathered so far.
    var own = Gathering((*g).at, (*g).first + (*g).count, 0u);
    var end = entry;
    while end < tile.part_count {
        let asked = part_at(tile, end, pixel);
        if parts[asked.part].lens != rank {
            break;
        }
        put_part(&own, asked, asked.part - lenses[rank].first_part, ray);
        end += 1u;
    }
    sort_boundaries(own);
    let is_flat = (lenses[rank].flags & LENS_FLAT) != 0u;
    var met = 0u;
    if is_flat {
        met = met_parts(rank);
    }
    var held = holds_now(rank, is_flat, met);
    if held {
        flip(around, rank);
    }
    // Boundaries never outnumber the crossings read, so none is overwritten before it has been read.
    let last = own.first + own.count;
    var next = own.first + 1u;
    while next <= last {
        let depth = bitcast<f32>(layers[slot_at(own.at, next)]);
        while next <= last && !starts_boundary(depth, bitcast<f32>(layers[slot_at(own.at, next)])) {
            let part = layers[slot_at(own.at, next) + 1u];
            cross_part(part);
            if is_flat {
                met = select(met - 1u, met + 1u, is_met(rank, part));
            }
            next += 1u;
        }
        let holds = holds_now(rank, is_flat, met);
        if holds != held {
            put_boundary(g, depth, rank);
            held = holds;
        }
    }
    return end - entry;
}

fn holds_now(rank: u32, is_flat: bool, met: u32) -> bool {
    if is_flat {
        return flat_holds(rank, met);
    }
    return program_holds(rank);
}

@compute @workgroup_size(16, 16)
fn find_layers(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let pixel = pixel_of(group, local, frame.active_tiles);
    if any(pixel >= frame.window_size) {
        return;
    }
    let tile = tile_at(pixel);
    let ray = lens_ray(sample_point(pixel));
    var around = Set();
    var found = Gathering(layers_at(tile, pixel), 0u, 0u);
    var entry = 0u;
    while entry < tile.part_count {
        let asked = part_at(tile, entry, pixel);
        if !is_compound(parts[asked.part].lens) {
            put_simple(&found, &around, asked, ray);
            entry += 1u;
        } else {
            entry += put_compound(&found, &around, tile, entry, pixel, ray);
        }
    }
    layers[found.at] = put_layers(found, &around);
}

// Writes the layers between the boundaries in place and returns their number.
fn put_layers(found: Gathering, around: ptr<function, Set>) -> u32 {
    put_layer(found.at, 0u, frame.near, *around);
    // A layer is never written before the boundaries that stand in its place have been read.
    var written = 1u;
    var next = 1u;
    while next <= found.count {
        let depth = bitcast<f32>(layers[slot_at(found.at, next)]);
        while next <= found.count && !starts_boundary(depth, bitcast<f32>(layers[slot_at(found.at, next)])) {
            // In or out.
            flip(around, layers[slot_at(found.at, next) + 1u]);
            next += 1u;
        }
        put_layer(found.at, written, depth, *around);
        written += 1u;
    }
    return written;
}
