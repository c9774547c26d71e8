// What lies at the centre of each pixel: the visible fragment of SEMANTICS 6.4.

// For each pixel: layers, found, instance, number of its triangle among all or of its cap, depth, normal, then the words of the set and of the stack. Twin of `aov.rs`.
@group(2) @binding(4) var<storage, read_write> maps: array<u32>;

const MAP_WORDS: u32 = 8u + 2u * WORDS;

@compute @workgroup_size(8, 8)
fn aovs(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) {
        return;
    }
    let pixel = id.xy;
    let ray = pixel_ray(pixel);
    let tile = tile_at(pixel);
    let opaque = opaque_at(pixel, ray);
    var last = Pick(-FAR_AWAY, 0u, 0u, 0u, false);
    var seen: Visible;
    var passed = Set();
    loop {
        let pick = next_fragment(pixel, opaque, last);
        if !pick.found {
            break;
        }
        last = pick;
        let met = met_at(pick, tile, pixel, ray);
        let fragment = met.fragment;
        let shaded = shade(fragment, met.at, ray, passed);
        passed = also_passed(passed, fragment, shaded);
        seen = and_seen(seen, fragment, shaded);
        if seen.ends {
            break;
        }
    }
    let visible = seen.fragment;
    let normal = seen.normal;
    let at = (pixel.y * frame.window_size.x + pixel.x) * MAP_WORDS;
    maps[at] = layer_count(tile, pixel);
    maps[at + 1u] = u32(seen.found);
    maps[at + 2u] = visible.item;
    maps[at + 3u] = visible.triangle;
    if !is_cap(visible.triangle) {
        maps[at + 3u] = triangle_number(visible.item, visible.triangle);
    }
    maps[at + 4u] = bitcast<u32>(visible.depth);
    maps[at + 5u] = bitcast<u32>(normal.x);
    maps[at + 6u] = bitcast<u32>(normal.y);
    maps[at + 7u] = bitcast<u32>(normal.z);
    for (var w = 0u; w < WORDS; w += 1u) {
        maps[at + 8u + w] = visible.around.words[w];
        maps[at + 8u + WORDS + w] = visible.stack.words[w];
    }
}
