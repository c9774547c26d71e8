// Reads what `layers.wgsl` wrote: for each pixel of a tile that lenses touch the number of layers, then for each
// layer its start depth and the set of lenses around it.

const LAYER_WORDS: u32 = 1u + WORDS;

fn layer_count(tile: TileRecord, pixel: vec2u) -> u32 {
    if tile.part_count == 0u {
        return 1u;
    }
    return layers[layers_at(tile, pixel)];
}

fn layer_start(at: u32, layer: u32) -> f32 {
    return bitcast<f32>(layers[at + 1u + layer * LAYER_WORDS]);
}

fn layer_set(at: u32, layer: u32) -> Set {
    var around = Set();
    for (var w = 0u; w < WORDS; w += 1u) {
        around.words[w] = layers[at + 2u + layer * LAYER_WORDS + w];
    }
    return around;
}

// Whether a layer has begun at a depth; a boundary as close as two that merge is reached.
fn is_begun(at: u32, layer: u32, depth: f32) -> bool {
    return !starts_boundary(depth, layer_start(at, layer));
}

// The lenses around a depth: `entry <= depth < exit`.
fn set_at(tile: TileRecord, pixel: vec2u, depth: f32) -> Set {
    if !LAYERS {
        return asked_at(tile, pixel, depth);
    }
    if tile.part_count == 0u {
        return Set();
    }
    let at = layers_at(tile, pixel);
    var layer = layers[at];
    loop {
        layer -= 1u;
        continuing {
            break if layer == 0u || is_begun(at, layer, depth);
        }
    }
    return layer_set(at, layer);
}
