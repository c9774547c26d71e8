// Every fragment on the ray of one pixel, nearest first, classified and shaded. Twin of `explain.rs`.

// For each fragment: instance, number of its triangle among all, depth, displayed, opacity, coverage, weights, normal,
// then the words of the set and of the stack.
@group(2) @binding(4) var<storage, read_write> report: array<u32>;

const REPORT_WORDS: u32 = 12u + 2u * WORDS;

@compute @workgroup_size(1)
fn explain() {
    let number = frame.listed_pixel - 1u;
    let pixel = vec2u(number % frame.window_size.x, number / frame.window_size.x);
    let ray = pixel_ray(pixel);
    let tile = tile_at(pixel);
    var last = Pick(-FAR_AWAY, 0u, 0u, 0u, false);
    var at = 0u;
    loop {
        let pick = next_listed(pixel, last);
        if !pick.found || at + REPORT_WORDS > arrayLength(&report) {
            break;
        }
        last = pick;
        let verdict = walk(pick.item, ray, pick.depth, set_at(tile, pixel, pick.depth));
        let shaded = shade(Fragment(pick.item, pick.triangle, pick.depth, verdict.around, verdict.stack), ray);
        let weights = surface_hit(ray, fetch_triangle(pick.item, pick.triangle)).weights;
        report[at] = items[pick.item].instance;
        report[at + 1u] = pick.key;
        report[at + 2u] = bitcast<u32>(pick.depth);
        report[at + 3u] = u32(verdict.displayed);
        report[at + 4u] = bitcast<u32>(shaded.opacity);
        report[at + 5u] = bitcast<u32>(shaded.coverage);
        for (var i = 0u; i < 3u; i += 1u) {
            report[at + 6u + i] = bitcast<u32>(weights[i]);
            report[at + 9u + i] = bitcast<u32>(shaded.normal[i]);
        }
        for (var w = 0u; w < WORDS; w += 1u) {
            report[at + 12u + w] = verdict.around.words[w];
            report[at + 12u + WORDS + w] = verdict.stack.words[w];
        }
        at += REPORT_WORDS;
    }
}
