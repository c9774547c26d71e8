// Finds the caps of each pixel: where its ray comes to a boundary inside a body that a lens cuts. Twin of
// `cpu/pixel/caps.rs`.

struct CutVarying {
    @invariant @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) item: u32,
    @location(1) depth: f32,
    // In the order in which the item's are drawn.
    @location(2) @interpolate(flat) triangle: u32,
    // NONE: that of the triangle.
    @location(3) @interpolate(flat) role: u32,
}

// Nothing is cut off behind, wherever the far plane is: what lies behind a boundary tells whether it is inside.
@vertex
fn cut_vertex(
    @location(0) local: vec3f,
    shown: Shown,
    @builtin(vertex_index) vertex: u32,
    @builtin(instance_index) item: u32,
) -> CutVarying {
    let p = shown_corner(local, shown);
    let depth = dot(p, frame.forward.xyz);
    return CutVarying(clip_position(p, depth, z_of_cut()), item, depth, vertex - shown.base_vertex, NONE);
}

// A place between the planes at which nothing is cut off behind.
fn z_of_cut() -> f32 {
    return select(0.5, 1.0, frame.perspective != 0u);
}

// Words of a lid: its corners and its role.
const LID_WORDS: u32 = 10u;

@vertex
fn lid_vertex(
    shown: Shown,
    @builtin(vertex_index) vertex: u32,
    @builtin(instance_index) item: u32,
) -> CutVarying {
    let at = items[item].lids + LID_WORDS * (vertex / 3u);
    let p = shown_corner(lens_vector(at + 3u * (vertex % 3u)), shown);
    let depth = dot(p, frame.forward.xyz);
    return CutVarying(clip_position(p, depth, z_of_cut()), item, depth, 0u, lens_words[at + LID_WORDS - 1u]);
}

@fragment
fn crossing(in: CutVarying, @builtin(front_facing) is_front: bool) {
    let pixel = vec2u(in.position.xy);
    // Without lenses there is no boundary, but for those that a mover brings with what it moves.
    if tile_at(pixel).part_count == 0u && items[in.item].step_count == 0u {
        return;
    }
    let role = select(in.role, role_of(in.item, in.triangle), in.role == NONE);
    var depth = in.depth;
    if PLANES && in.role == NONE && plane_at(in.item, in.triangle) != NONE {
        depth = meeting(in.item, in.triangle, pixel_ray(pixel)).hit.depth;
    }
    if role / 2u != SLOT_OPEN {
        append(crossings_of(pixel), depth, in.item, crossing_word(role / 2u, is_front == (role % 2u == 0u)));
    }
}

// Of a drawn triangle of an item that may be cut.
fn role_of(item: u32, triangle: u32) -> u32 {
    let first = items[item].roles;
    if first == NONE {
        return 0u;
    }
    let number = numbers[items[item].first_number + triangle];
    return (lens_words[first + number / 4u] >> (8u * (number % 4u))) & 0xffu;
}

fn crossings_of(pixel: vec2u) -> u32 {
    return frame.window_size.x * frame.window_size.y + head_of(pixel);
}

@compute @workgroup_size(16, 16)
fn find_caps(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let pixel = pixel_of(group, local, tile_columns() * tile_rows());
    if any(pixel >= frame.window_size) {
        return;
    }
    let list = atomicLoad(&heads[crossings_of(pixel)]);
    if list == 0u {
        return;
    }
    let tile = tile_at(pixel);
    let ray = pixel_ray(pixel);
    var boundary = next_boundary(list, tile, pixel, ray, -FAR_AWAY);
    while boundary < FAR_AWAY {
        let cap = cap_at(list, tile, pixel, ray, boundary);
        if cap.maker != NONE {
            append(head_of(pixel), boundary, cap.item, FIRST_CAP + cap.maker);
        }
        boundary = next_boundary(list, tile, pixel, ray, boundary);
    }
}

struct FoundCap {
    item: u32,
    maker: u32,
}

// The cap at a boundary: of all bodies that have one there, that of the first.
fn cap_at(list: u32, tile: TileRecord, pixel: vec2u, ray: PixelRay, boundary: f32) -> FoundCap {
    var found = FoundCap(NONE, NONE);
    var body = next_body(list, 0u);
    while body != NONE && found.maker == NONE {
        found = cap_of_body(list, body, tile, pixel, ray, boundary);
        body = next_body(list, body + 1u);
    }
    return found;
}

// The first of the bodies in a list from this number on; NONE: there are no more.
fn next_body(list: u32, least: u32) -> u32 {
    var next = NONE;
    var slot = list;
    while slot != 0u {
        let met = fragments[slot - 1u];
        let body = items[met.y].body;
        next = select(next, min(next, body), body >= least);
        slot = met.w;
    }
    return next;
}

// The cap of a body at a boundary: that of the first member which is closed there, of those that are the first of a group
// whose pieces enclose the boundary. In `lens_words` a body is the number of its members, then for each its item.
fn cap_of_body(list: u32, body: u32, tile: TileRecord, pixel: vec2u, ray: PixelRay, boundary: f32) -> FoundCap {
    if !encloses(list, body, NONE, boundary) {
        return FoundCap(NONE, NONE);
    }
    for (var i = 0u; i < lens_words[body]; i += 1u) {
        let item = lens_words[body + 1u + i];
        if items[item].group == item && encloses(list, body, item, boundary) {
            let maker = closing(item, ray, tile, pixel, boundary).maker;
            if maker != NONE {
                return FoundCap(item, maker);
            }
        }
    }
    return FoundCap(NONE, NONE);
}

// Whether the pieces of a body, or of one group of it, enclose the ray at a boundary, by what lies behind.
fn encloses(list: u32, body: u32, group: u32, boundary: f32) -> bool {
    var around = Around(0, 0u);
    var slot = list;
    while slot != 0u {
        let met = fragments[slot - 1u];
        let is_asked = items[met.y].body == body && (group == NONE || items[met.y].group == group);
        if is_asked && !starts_boundary(bitcast<f32>(met.x), boundary) {
            around = also_crossed(around, met.z);
        }
        slot = met.w;
    }
    return is_enclosed(around);
}

// The next boundary behind a depth: of all lenses and, where bodies are moved, of those below their movers.
fn next_boundary(list: u32, tile: TileRecord, pixel: vec2u, ray: PixelRay, after: f32) -> f32 {
    var next = FAR_AWAY;
    let at = layers_at(tile, pixel);
    for (var layer = 1u; layer < layer_count(tile, pixel); layer += 1u) {
        next = nearer(layer_start(at, layer), after, next);
    }
    var body = next_body(list, 0u);
    while MOVERS && body != NONE {
        // All of it is moved alike.
        next = next_moved(lens_words[body + 1u], ray, after, next);
        body = next_body(list, body + 1u);
    }
    return next;
}

// A boundary of the lenses below the movers of an item if it is nearer than `best`.
fn next_moved(item: u32, ray: PixelRay, after: f32, best: f32) -> f32 {
    var next = best;
    let first = items[item].first_step;
    for (var step = first; step < first + items[item].step_count; step += 1u) {
        let moved = moved_ray(step_point(step, ray.origin), step_vector(step, ray.direction));
        for (var rank = 0u; rank < steps[step].rank; rank += 1u) {
            for (var i = 0u; i < lenses[rank].part_count; i += 1u) {
                next = nearest_of_part(lenses[rank].first_part + i, moved, after, next);
            }
        }
    }
    return next;
}

// A depth behind `after` if it is nearer than `best`.
fn nearer(depth: f32, after: f32, best: f32) -> f32 {
    let counts = depth > frame.near && depth < frame.far && starts_boundary(after, depth);
    return select(best, min(best, depth), counts);
}

fn nearest_of_part(part: u32, ray: LensRay, after: f32, best: f32) -> f32 {
    var next = best;
    if COMPOUNDS && parts[part].form == FORM_MESH {
        let line = mesh_line(part, ray);
        var crossing = before_mesh();
        loop {
            crossing = next_in_mesh(with_all_faces(part), line, crossing);
            if !crossing.found {
                break;
            }
            next = nearer(crossing.t, after, next);
        }
        return next;
    }
    let span = part_span(with_all_faces(part), ray);
    if span.hit {
        next = nearer(span.exit, after, nearer(span.entry, after, next));
    }
    return next;
}
