// The fragment that is drawn at a window's one pixel, or a cap before it, classified and shaded. Twin of `explain.rs`.

// Found, instance, number of its triangle among all, number of its cap or NONE, depth, displayed (2: it fills a gap),
// opacity, coverage, weights, normal, then the words of the set and of the stack.
@group(2) @binding(4) var<storage, read_write> report: array<u32>;

@compute @workgroup_size(1)
fn explain() {
    let pixel = vec2u(0u);
    let ray = pixel_ray(pixel);
    var pick = opaque_at(pixel, ray);
    if CAPS {
        let cap = next_listed(pixel, Pick(frame.after_depth, frame.after_key, frame.after_item, 0u, true));
        if is_before(cap, pick) {
            pick = cap;
        }
    }
    report[0] = u32(pick.found);
    if !pick.found {
        return;
    }
    let tile = tile_at(pixel);
    let met = met_at(pick, tile, pixel, ray);
    var displayed = 1u;
    if !is_cap(pick.triangle) {
        let here = set_at(tile, pixel, pick.depth);
        let verdict = verdict_at(pick.item, ray, tile, pixel, pick.depth, here);
        displayed = u32(verdict.displayed) + u32(verdict.fills);
    }
    var passed = Set();
    for (var w = 0u; w < WORDS; w += 1u) {
        passed.words[w] = frame.passed[w / 4u][w % 4u];
    }
    let shaded = shade(met.fragment, met.at, ray, passed);
    let weights = met.at.hit.weights;
    report[1] = pick.item;
    report[2] = pick.key;
    report[3] = select(NONE, pick.triangle, is_cap(pick.triangle));
    report[4] = bitcast<u32>(pick.depth);
    report[5] = displayed;
    report[6] = bitcast<u32>(shaded.opacity);
    report[7] = bitcast<u32>(shaded.coverage);
    for (var i = 0u; i < 3u; i += 1u) {
        report[8u + i] = bitcast<u32>(weights[i]);
        report[11u + i] = bitcast<u32>(shaded.normal[i]);
    }
    for (var w = 0u; w < WORDS; w += 1u) {
        report[14u + w] = met.fragment.around.words[w];
        report[14u + WORDS + w] = met.fragment.stack.words[w];
    }
}
