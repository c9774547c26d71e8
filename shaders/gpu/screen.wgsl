// Filters of the screen: what they do to one sample of all pixels of a window. Twin of `cpu/screen.rs`.

// Of each pixel.
@group(2) @binding(0) var<storage, read_write> samples: array<ScreenSample>;
// Sums along rows, and of their weights.
@group(2) @binding(1) var<storage, read_write> rows: array<vec4f>;
// Weights of those sums; or a MARK_...
@group(2) @binding(2) var<storage, read_write> marks: array<f32>;
// The filter, and the rank of its lens or rule.
@group(2) @binding(3) var<storage, read> step: vec4u;
// Colours summed over the samples.
@group(2) @binding(4) var<storage, read_write> accumulated: array<vec4f>;

fn place(pixel: vec2u) -> u32 {
    return pixel.y * frame.window_size.x + pixel.x;
}

fn acts(at: u32) -> bool {
    if ops[step.x].kind == OP_ERASE {
        return samples[at].outline == step.x + 1u;
    }
    return samples[at].item != 0u && (samples[at].stack.words[step.y / 32u] >> (step.y % 32u) & 1u) != 0u;
}

// Colours a pixel on which the filter acts, which fades in where its lens is soft; caps are there or not.
fn put(pixel: vec2u, filtered: vec4f) {
    let at = place(pixel);
    if !SOFT || ops[step.x].kind == OP_ERASE {
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

// A colour, or a sum of colours, and the sum of their weights.
struct Weighed {
    color: vec4f,
    weight: f32,
}

fn added(a: Weighed, b: Weighed, weight: f32) -> Weighed {
    return Weighed(a.color + b.color * weight, a.weight + b.weight * weight);
}

// Means are taken along rows, then of these along columns, a stretch of a line at a time: each pixel of it is read a few
// times, however far a filter looks.
@compute @workgroup_size(1, 64)
fn sum_rows(@builtin(global_invocation_id) id: vec3u) {
    if id.y < frame.window_size.y {
        sum_stretch(id.x, id.y, false);
    }
}

@compute @workgroup_size(64, 1)
fn sum_columns(@builtin(global_invocation_id) id: vec3u) {
    if id.x < frame.window_size.x {
        sum_stretch(id.y, id.x, true);
    }
}

fn sum_stretch(number: u32, line: u32, is_column: bool) {
    let op = ops[step.x];
    let side = u32(mean_side(op));
    let size = select(frame.window_size.x, frame.window_size.y, is_column);
    // Squares of pixels stand where they do in the whole picture.
    let before = select(frame.window_min.x, frame.window_min.y, is_column) % side;
    let offset = select(0u, before, op.kind == OP_PIXELATE);
    let first = number * side - min(number * side, offset);
    let end = min((number + 1u) * side - offset, size);
    if op.kind == OP_PIXELATE {
        var sum = Weighed(vec4f(0.0), 0.0);
        for (var at = first; at < end; at += 1u) {
            sum = added(sum, weighed(at, line, is_column), 1.0);
        }
        for (var at = first; at < end; at += 1u) {
            put_sum(at, line, is_column, sum);
        }
        return;
    }
    // The weights are those of `blur_weight`: half a constant and half a cosine, whose sums move on with the window: to the
    // next pixel the cosine's turns, by the same angle everywhere.
    let turn = blur_turn(op);
    let reach = i32(screen_reach(op));
    let one = vec2f(cos(turn), sin(turn));
    let last = vec2f(cos(turn * f32(reach)), sin(turn * f32(reach)));
    let next = vec2f(cos(turn * f32(reach + 1)), sin(turn * f32(reach + 1)));
    var plain = Weighed(vec4f(0.0), 0.0);
    var re = plain;
    var im = plain;
    for (var away = -reach; away <= reach && first < end; away += 1) {
        let other = weighed_or_none(i32(first) + away, size, line, is_column);
        plain = added(plain, other, 1.0);
        re = added(re, other, cos(turn * f32(away)));
        im = added(im, other, sin(turn * f32(away)));
    }
    for (var at = first; at < end; at += 1u) {
        put_sum(at, line, is_column, added(Weighed(0.5 * plain.color, 0.5 * plain.weight), re, 0.5));
        let left = weighed_or_none(i32(at) - reach, size, line, is_column);
        let entered = weighed_or_none(i32(at) + reach + 1, size, line, is_column);
        plain = added(added(plain, left, -1.0), entered, 1.0);
        let new_re = added(added(re, left, -last.x), entered, next.x);
        let new_im = added(added(im, left, last.y), entered, next.y);
        re = added(Weighed(new_re.color * one.x, new_re.weight * one.x), new_im, one.y);
        im = added(Weighed(new_im.color * one.x, new_im.weight * one.x), new_re, -one.y);
    }
}

fn pixel_on(at: u32, line: u32, is_column: bool) -> vec2u {
    return select(vec2u(at, line), vec2u(line, at), is_column);
}

// What takes no part weighs nothing.
fn weighed(at: u32, line: u32, is_column: bool) -> Weighed {
    let other = place(pixel_on(at, line, is_column));
    if is_column {
        return Weighed(rows[other], marks[other]);
    }
    if acts(other) {
        return Weighed(samples[other].color, 1.0);
    }
    return Weighed(vec4f(0.0), 0.0);
}

fn weighed_or_none(at: i32, size: u32, line: u32, is_column: bool) -> Weighed {
    if at < 0 || at >= i32(size) {
        return Weighed(vec4f(0.0), 0.0);
    }
    return weighed(u32(at), line, is_column);
}

fn put_sum(at: u32, line: u32, is_column: bool, sum: Weighed) {
    let pixel = pixel_on(at, line, is_column);
    if !is_column {
        rows[place(pixel)] = sum.color;
        marks[place(pixel)] = sum.weight;
    } else if acts(place(pixel)) {
        put(pixel, sum.color / sum.weight);
    }
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

// How the line lies that a pixel has because of a neighbour.
fn mark_for(op: Op, own: u32, seen: Seen, pixel: vec2u, comes_after: bool) -> u32 {
    let other = place(pixel);
    let regions_count = op.kind == OP_EDGES;
    var border = BORDER_NONE;
    if !acts(other) {
        border = BORDER_OF_FILTER;
    } else if (regions_count && is_other_region(own, other)) || is_other_section(own, other) {
        border = BORDER_OF_REGION;
    }
    return line_mark(op, seen, seen_at(pixel), border, comes_after);
}

@compute @workgroup_size(8, 8)
fn mark_lines(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) {
        return;
    }
    let own = place(id.xy);
    let op = ops[step.x];
    var mark = MARK_NONE;
    if acts(own) {
        let seen = seen_at(id.xy);
        if id.x > 0u {
            mark = max(mark, mark_for(op, own, seen, id.xy - vec2u(1u, 0u), false));
        }
        if id.x + 1u < frame.window_size.x {
            mark = max(mark, mark_for(op, own, seen, id.xy + vec2u(1u, 0u), true));
        }
        if id.y > 0u {
            mark = max(mark, mark_for(op, own, seen, id.xy - vec2u(0u, 1u), false));
        }
        if id.y + 1u < frame.window_size.y {
            mark = max(mark, mark_for(op, own, seen, id.xy + vec2u(0u, 1u), true));
        }
    }
    marks[own] = f32(mark);
}

// No mark is within reach; a square of a distance in pixels.
const FAR: f32 = 1e12;

// The squares of the distances to the nearest marks of both kinds in the same row.
@compute @workgroup_size(8, 8)
fn find_in_rows(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) {
        return;
    }
    let columns = along(id.x, u32(line_reach(ops[step.x])), frame.window_size.x);
    var nearest = vec2f(FAR);
    for (var x = columns.x; x <= columns.y; x += 1u) {
        let mark = u32(marks[place(vec2u(x, id.y))]);
        let away = f32(x) - f32(id.x);
        if mark == MARK_SHARED {
            nearest.x = min(nearest.x, away * away);
        } else if mark == MARK_ALONE {
            nearest.y = min(nearest.y, away * away);
        }
    }
    rows[place(id.xy)] = vec4f(nearest, 0.0, 0.0);
}

@compute @workgroup_size(8, 8)
fn draw_lines(@builtin(global_invocation_id) id: vec3u) {
    if any(id.xy >= frame.window_size) || !acts(place(id.xy)) {
        return;
    }
    let op = ops[step.x];
    let lines = along(id.y, u32(line_reach(op)), frame.window_size.y);
    var nearest = vec2f(FAR);
    for (var y = lines.x; y <= lines.y; y += 1u) {
        let away = f32(y) - f32(id.y);
        nearest = min(nearest, rows[place(vec2u(id.x, y))].xy + away * away);
    }
    put(id.xy, under_lines(op, samples[place(id.xy)].color, sqrt(nearest.x), sqrt(nearest.y)));
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
