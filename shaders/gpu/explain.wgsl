// The fragment that is drawn at a window's one pixel, classified and shaded. Twin of `explain.rs`.

// Found, instance, number of its triangle among all, item, depth, displayed, opacity, coverage, weights, normal, then the
// words of the set and of the stack.
@group(2) @binding(4) var<storage, read_write> report: array<u32>;

@compute @workgroup_size(1)
fn explain() {
    let pixel = vec2u(0u);
    let ray = pixel_ray(pixel);
    let pick = opaque_at(pixel, ray);
    report[0] = u32(pick.found);
    if !pick.found {
        return;
    }
    let verdict = walk(pick.item, ray, pick.depth, set_at(tile_at(pixel), pixel, pick.depth));
    let met = meeting(pick.item, pick.triangle, ray);
    var passed = Set();
    for (var w = 0u; w < WORDS; w += 1u) {
        passed.words[w] = frame.passed[w / 4u][w % 4u];
    }
    let shaded = shade(Fragment(pick.item, pick.triangle, pick.depth, verdict.around, verdict.stack), met, ray, passed);
    let weights = met.hit.weights;
    report[1] = pick.item;
    report[2] = pick.key;
    report[3] = pick.item;
    report[4] = bitcast<u32>(pick.depth);
    report[5] = u32(verdict.displayed);
    report[6] = bitcast<u32>(shaded.opacity);
    report[7] = bitcast<u32>(shaded.coverage);
    for (var i = 0u; i < 3u; i += 1u) {
        report[8u + i] = bitcast<u32>(weights[i]);
        report[11u + i] = bitcast<u32>(shaded.normal[i]);
    }
    for (var w = 0u; w < WORDS; w += 1u) {
        report[14u + w] = verdict.around.words[w];
        report[14u + WORDS + w] = verdict.stack.words[w];
    }
}
