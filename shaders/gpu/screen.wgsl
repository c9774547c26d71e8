// Filters of the screen: what they do to one sample of all pixels of a window. Twin of `cpu/screen.rs`.

// Of each pixel.
@group(2) @binding(0) var<storage, read_write> samples: array<ScreenSample>;
// Sums along rows, and of their weights.
@group(2) @binding(1) var<storage, read_write> rows: array<vec4f>;
// Weights of those sums; or 1 where a line lies.
@group(2) @binding(2) var<storage, read_write> marks: array<f32>;
// The filter, and the rank of its lens or rule.
@group(2) @binding(3) var<storage, read> step: vec4u;
// Colours summed over the samples.
@group(2) @binding(4) var<storage, read_write> accumulated: array<vec4f>;

fn place(pixel: vec2u) -> u32 {
    return pixel.y * frame.window_size.x + pixel.x;
}

fn acts(at: u32) -> bool {
    return samples[at].item != 0u && (samples[at].stack.words[step.y / 32u] >> (step.y % 32u) & 1u) != 0u;
}

// Colours a pixel on which the filter acts, which fades in where its lens is soft.
fn put(pixel: vec2u, filtered: vec4f) {
    let at = place(pixel);
    if !SOFT {
        samples[at].color = filtered;
        return;
    }
    let ray = pixel_ray(pixel);
    let position = ray.origin + ray.direction * samples[at].depth;
    let amount = soft_amount(step.y, (samples[at].item & ~SEEN_CAP) - 1u, position);
    samples[at].color = mix(samples[at].color, filtered, amount);
}

// Pixels from one up to so far along an axis, within the window: first and last.
fn along(at: u32, reach: u32, size: u32) -> vec2u {
    return vec2u(at - min(at, reach), min(at + reach, size - 1u));
}

@compute @workgroup_size(8, 8)
fn sum_rows(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) {
        return;
    }
    let op = ops[step.x];
    let own = f32(frame.window_min.x + id.x);
    let range = along(id.x, u32(screen_reach(op)), frame.window_size.x);
    var sum = vec4f(0.0);
    var all = 0.0;
    for (var x = range.x; x <= range.y; x += 1u) {
        let other = place(vec2u(x, id.y));
        if acts(other) {
            let weight = mean_weight(op, own, f32(frame.window_min.x + x));
            sum += samples[other].color * weight;
            all += weight;
        }
    }
    rows[place(id.xy)] = sum;
    marks[place(id.xy)] = all;
}

@compute @workgroup_size(8, 8)
fn sum_columns(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) || !acts(place(id.xy)) {
        return;
    }
    let op = ops[step.x];
    let own = f32(frame.window_min.y + id.y);
    let range = along(id.y, u32(screen_reach(op)), frame.window_size.y);
    var sum = vec4f(0.0);
    var all = 0.0;
    for (var y = range.x; y <= range.y; y += 1u) {
        let other = place(vec2u(id.x, y));
        let weight = mean_weight(op, own, f32(frame.window_min.y + y));
        sum += rows[other] * weight;
        all += marks[other] * weight;
    }
    put(id.xy, sum / all);
}

fn seen_at(pixel: vec2u) -> Seen {
    let at = place(pixel);
    let depth = samples[at].depth;
    let ray = pixel_ray(pixel);
    let span = 2.0 / frame.picture_scale * select(1.0, frame.anchor + depth, frame.perspective != 0u);
    let found = min(samples[at].item, 1u);
    return Seen(found, depth, ray.origin + ray.direction * depth, samples[at].normal, span);
}

fn is_other_region(a: u32, b: u32) -> bool {
    for (var w = 0u; w < WORDS; w += 1u) {
        if samples[a].around.words[w] != samples[b].around.words[w] {
            return true;
        }
    }
    return false;
}

// Whether two pixels see caps of different nodes: sections of parts that may lie in one plane.
fn is_other_section(a: u32, b: u32) -> bool {
    if (samples[a].item & samples[b].item & SEEN_CAP) == 0u {
        return false;
    }
    let p = (samples[a].item & ~SEEN_CAP) - 1u;
    let q = (samples[b].item & ~SEEN_CAP) - 1u;
    return items[p].node != items[q].node || ((items[p].flags ^ items[q].flags) & ITEM_ALTERNATE) != 0u;
}

fn marks_for(op: Op, own: u32, seen: Seen, pixel: vec2u, comes_after: bool) -> bool {
    let other = place(pixel);
    var border = BORDER_NONE;
    if !acts(other) {
        border = BORDER_OF_FILTER;
    } else if is_other_region(own, other) || is_other_section(own, other) {
        border = BORDER_OF_REGION;
    }
    return edges_mark(op, seen, seen_at(pixel), border, comes_after);
}

@compute @workgroup_size(8, 8)
fn mark_edges(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) {
        return;
    }
    let own = place(id.xy);
    let op = ops[step.x];
    var has_mark = false;
    if acts(own) {
        let seen = seen_at(id.xy);
        if id.x > 0u {
            has_mark = has_mark || marks_for(op, own, seen, id.xy - vec2u(1u, 0u), false);
        }
        if id.x + 1u < frame.window_size.x {
            has_mark = has_mark || marks_for(op, own, seen, id.xy + vec2u(1u, 0u), true);
        }
        if id.y > 0u {
            has_mark = has_mark || marks_for(op, own, seen, id.xy - vec2u(0u, 1u), false);
        }
        if id.y + 1u < frame.window_size.y {
            has_mark = has_mark || marks_for(op, own, seen, id.xy + vec2u(0u, 1u), true);
        }
    }
    marks[own] = select(0.0, 1.0, has_mark);
}

// No mark is within reach; a square of a distance in pixels.
const FAR: f32 = 1e12;

// The square of the distance to the nearest mark in the same row.
@compute @workgroup_size(8, 8)
fn find_in_rows(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) {
        return;
    }
    let columns = along(id.x, u32(edges_reach(ops[step.x])), frame.window_size.x);
    var nearest = FAR;
    for (var x = columns.x; x <= columns.y; x += 1u) {
        if marks[place(vec2u(x, id.y))] != 0.0 {
            let away = f32(x) - f32(id.x);
            nearest = min(nearest, away * away);
        }
    }
    rows[place(id.xy)].x = nearest;
}

@compute @workgroup_size(8, 8)
fn draw_edges(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) || !acts(place(id.xy)) {
        return;
    }
    let op = ops[step.x];
    let lines = along(id.y, u32(edges_reach(op)), frame.window_size.y);
    var nearest = FAR;
    for (var y = lines.x; y <= lines.y; y += 1u) {
        let away = f32(y) - f32(id.y);
        nearest = min(nearest, rows[place(vec2u(id.x, y))].x + away * away);
    }
    // The nearest line covers most.
    let covered = line_coverage(sqrt(nearest), op.b.x);
    put(id.xy, edges_drawn(op, samples[place(id.xy)].color, covered));
}

// One triangle over the whole window.
@vertex
fn window_vertex(@builtin(vertex_index) vertex: u32) -> @builtin(position) vec4f {
    let corner = vec2f(f32(vertex & 1u), f32(vertex >> 1u));
    return vec4f(4.0 * corner - 1.0, 0.0, 1.0);
}

// Sums the samples; of several the last one draws the picture.
@fragment
fn finish(@builtin(position) position: vec4f) -> @location(0) vec4f {
    let at = place(vec2u(position.xy));
    var sum = samples[at].color;
    if frame.samples > 1u {
        if frame.sample_index > 0u {
            sum += accumulated[at];
        }
        accumulated[at] = sum;
    }
    return finished(sum / f32(frame.samples));
}
