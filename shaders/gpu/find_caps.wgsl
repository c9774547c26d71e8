// Finds the caps of each pixel: where its ray comes to a boundary inside a body that a lens cuts. Twin of
// `cpu/pixel/caps.rs`.

struct CutVarying {
    @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) item: u32,
    @location(1) depth: f32,
}

// Some fields of the record of an `Item`.
struct CutShown {
    @location(1) row_x: vec4f,
    @location(2) row_y: vec4f,
    @location(3) row_z: vec4f,
    @location(4) base_vertex: u32,
}

// Nothing is cut off behind, wherever the far plane is: what lies behind a boundary tells whether it is inside.
@vertex
fn cut_vertex(@location(0) local: vec3f, shown: CutShown, @builtin(instance_index) item: u32) -> CutVarying {
    let at = vec4f(local, 1.0);
    let p = vec3f(dot(shown.row_x, at), dot(shown.row_y, at), dot(shown.row_z, at));
    let depth = dot(p, frame.forward.xyz);
    var clip = vec4f(dot(p, frame.right.xyz), dot(p, frame.up.xyz), frame.near, depth);
    if frame.perspective == 0u {
        clip = vec4f(clip.xy, 0.5, 1.0);
    }
    let moved = clip.xy * frame.clip_scale + frame.clip_shift * clip.w;
    return CutVarying(vec4f(moved, clip.zw), item, depth);
}

@fragment
fn crossing(in: CutVarying, @builtin(front_facing) is_front: bool) {
    let pixel = vec2u(in.position.xy);
    // Without lenses there is no boundary.
    if tile_at(pixel).part_count == 0u {
        return;
    }
    append(crossings_of(pixel), in.depth, in.item, select(0xffffffffu, 1u, is_front));
}

fn crossings_of(pixel: vec2u) -> u32 {
    return frame.window_size.x * frame.window_size.y + head_of(pixel);
}

@compute @workgroup_size(16, 16)
fn find_caps(@builtin(workgroup_id) group: vec3u, @builtin(local_invocation_id) local: vec3u) {
    let index = group.y * DISPATCH_WIDTH + group.x;
    if index >= frame.active_tiles {
        return;
    }
    let number = tile_in_order(index);
    let tile = tile_record(number);
    let pixel = tile_corner(number) + local.xy;
    if any(pixel >= frame.window_size) {
        return;
    }
    let list = atomicLoad(&heads[crossings_of(pixel)]);
    if list == 0u {
        return;
    }
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
    var first = NONE;
    var slot = list;
    while slot != 0u {
        let met = fragments[slot - 1u];
        let body = items[met.y].body;
        if body < first && is_first_of_body(list, slot, body) {
            let member = member_around(list, body, boundary);
            if member != NONE {
                let maker = closing(member, ray, tile, pixel, boundary).maker;
                if maker != NONE {
                    first = body;
                    found = FoundCap(member, maker);
                }
            }
        }
        slot = met.w;
    }
    return found;
}

// Whether a crossing is the first with its body in the list.
fn is_first_of_body(list: u32, crossing: u32, body: u32) -> bool {
    var slot = list;
    while slot != crossing {
        let met = fragments[slot - 1u];
        if items[met.y].body == body {
            return false;
        }
        slot = met.w;
    }
    return true;
}

// The member of a body that a boundary lies in: the first that encloses it by itself, else the first of those that do so
// together; NONE where the boundary lies outside. In `lens_words` a body is the number of its members, then for each its
// item and whether it is closed by itself.
fn member_around(list: u32, body: u32, boundary: f32) -> u32 {
    if winding(list, body, NONE, boundary) == 0 {
        return NONE;
    }
    for (var i = 0u; i < lens_words[body]; i += 1u) {
        let at = body + 1u + 2u * i;
        if lens_words[at + 1u] != 0u && winding(list, body, lens_words[at], boundary) != 0 {
            return lens_words[at];
        }
    }
    return lens_words[body + 1u];
}

// How often a body, or one item of it, winds around the ray at a boundary, by what lies behind.
fn winding(list: u32, body: u32, item: u32, boundary: f32) -> i32 {
    var sum = 0;
    var slot = list;
    while slot != 0u {
        let met = fragments[slot - 1u];
        let counts = items[met.y].body == body && (item == NONE || met.y == item);
        if counts && !starts_boundary(bitcast<f32>(met.x), boundary) {
            sum += bitcast<i32>(met.z);
        }
        slot = met.w;
    }
    return sum;
}

// The next boundary behind a depth: of all lenses and, where bodies are moved, of those below their movers.
fn next_boundary(list: u32, tile: TileRecord, pixel: vec2u, ray: PixelRay, after: f32) -> f32 {
    var next = FAR_AWAY;
    let at = layers_at(tile, pixel);
    for (var layer = 1u; layer < layer_count(tile, pixel); layer += 1u) {
        next = nearer(layer_start(at, layer), after, next);
    }
    var slot = list;
    while MOVERS && slot != 0u {
        let met = fragments[slot - 1u];
        if items[met.y].step_count != 0u && is_first_of_body(list, slot, items[met.y].body) {
            next = next_moved(met.y, ray, after, next);
        }
        slot = met.w;
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
