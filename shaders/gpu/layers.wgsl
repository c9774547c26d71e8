// Cuts the ray of each pixel that lenses touch into layers (SEMANTICS section 2).

@group(2) @binding(0) var<storage, read_write> layers: array<u32>;

const LAYER_WORDS: u32 = 1u + WORDS;
// Boundaries closer than this share of the depth are one.
const MERGE: f32 = 1e-5;
// Workgroups in a row of the dispatch; twin of `tiles::DISPATCH_WIDTH`.
const DISPATCH_WIDTH: u32 = 1024u;

// While they are gathered, boundaries stand where the layers will: slot i holds a depth and a lens.
fn put_boundary(at: u32, count: u32, depth: f32, rank: u32) {
    var slot = count;
    // Insertion by depth, then rank, from the back.
    while slot > 0u {
        let before = at + 1u + slot * LAYER_WORDS;
        let other = bitcast<f32>(layers[before]);
        if other < depth || (other == depth && layers[before + 1u] < rank) {
            break;
        }
        layers[before + LAYER_WORDS] = layers[before];
        layers[before + LAYER_WORDS + 1u] = layers[before + 1u];
        slot -= 1u;
    }
    let here = at + 1u + (slot + 1u) * LAYER_WORDS;
    layers[here] = bitcast<u32>(depth);
    layers[here + 1u] = rank;
}

fn put_layer(at: u32, layer: u32, depth: f32, around: Set) {
    let here = at + 1u + layer * LAYER_WORDS;
    layers[here] = bitcast<u32>(depth);
    for (var w = 0u; w < WORDS; w += 1u) {
        layers[here + 1u + w] = around.words[w];
    }
}

@compute @workgroup_size(16, 16)
fn find_layers(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let index = group.y * DISPATCH_WIDTH + group.x;
    if index >= frame.active_tiles {
        return;
    }
    let columns = tile_columns();
    let rows = (frame.window_size.y + TILE - 1u) / TILE;
    let number = tiles[4u * columns * rows + index];
    let tile = tile_record(number);
    let pixel = vec2u(number % columns, number / columns) * TILE + local.xy;
    if any(pixel >= frame.window_size) {
        return;
    }
    let at = layers_at(tile, pixel);
    let point = sample_point(pixel);
    var around = Set();
    var count = 0u;
    for (var i = 0u; i < tile.part_count; i += 1u) {
        let part = tiles[tile.first_part + i];
        let rank = parts[part].lens;
        let span = part_span(part, point);
        let entry = max(span.entry, frame.near);
        let exit = min(span.exit, frame.far);
        if !span.hit || entry >= exit {
            continue;
        }
        if entry > frame.near {
            put_boundary(at, count, entry, rank);
            count += 1u;
        } else {
            around.words[rank / 32u] |= 1u << (rank % 32u);
        }
        if exit < frame.far {
            put_boundary(at, count, exit, rank);
            count += 1u;
        }
    }
    put_layer(at, 0u, frame.near, around);
    // A layer is never written before the boundaries that stand in its place have been read.
    var written = 1u;
    var next = 1u;
    while next <= count {
        let depth = bitcast<f32>(layers[at + 1u + next * LAYER_WORDS]);
        while next <= count {
            let here = at + 1u + next * LAYER_WORDS;
            if bitcast<f32>(layers[here]) - depth > MERGE * abs(depth) {
                break;
            }
            // Crosses its surface: in or out.
            let rank = layers[here + 1u];
            around.words[rank / 32u] ^= 1u << (rank % 32u);
            next += 1u;
        }
        put_layer(at, written, depth, around);
        written += 1u;
    }
    layers[at] = written;
}
