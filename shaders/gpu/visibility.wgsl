// Draws the scene: the nearest opaque fragment of each pixel, and lists of all that may be translucent.

struct Varying {
    @invariant @builtin(position) position: vec4f,
    @location(0) @interpolate(flat) item: u32,
    // In the order in which the item's are drawn.
    @location(1) @interpolate(flat) triangle: u32,
    @location(2) depth: f32,
}

@vertex
fn vertex(
    @location(0) local: vec3f,
    shown: Shown,
    @builtin(vertex_index) vertex: u32,
    @builtin(instance_index) item: u32,
) -> Varying {
    let p = shown_corner(local, shown);
    let depth = dot(p, frame.forward.xyz);
    let position = clip_position(p, depth, place_between_planes(depth));
    // Of a triangle its first corner counts, and each has a first corner of its own: see `provoking.rs`.
    return Varying(position, item, vertex - shown.base_vertex, depth);
}

// Reverse-Z over what there is to be drawn: 1 to 0, linear for an orthographic camera.
fn drawn_depth(depth: f32) -> f32 {
    if WIDE {
        // Finest around the anchor: single precision of a depth that is spread evenly over a scene so wide tells nothing apart.
        return 0.5 - 0.5 * depth / (abs(depth) + frame.merge_across);
    }
    return place_between_planes(depth) * select(1.0, frame.drawn_from_eye / (frame.anchor + depth), frame.perspective != 0u);
}

// For items that no lens can remove or make translucent and that lie between near and far.
@fragment
fn plain(in: Varying) -> @location(0) vec2u {
    return vec2u(in.item + 1u, in.triangle);
}

// `fused`: the fragment finds its region and its stack itself. Small triangles are many: it reads none of their corners.
@fragment
fn fused(in: Varying) -> Kept {
    let pixel = vec2u(in.position.xy);
    var depth = in.depth;
    if has_planes(in.item) {
        depth = meeting(in.item, in.triangle, pixel_ray(pixel)).hit.depth;
    }
    if depth < frame.near || depth > frame.far {
        discard;
    }
    if !TAKEN_AWAY && !TRANSLUCENT {
        return kept(vec2u(in.item + 1u, in.triangle), z_of(in, depth));
    }
    let around = set_at(tile_at(pixel), pixel, depth);
    return keep(in, pixel, pixel_ray(pixel), depth, around);
}

// `peel`: one layer at a time, its set of lenses taken from the layer.
@fragment
fn peel(in: Varying) -> Kept {
    let pixel = vec2u(in.position.xy);
    let tile = tile_at(pixel);
    let count = layer_count(tile, pixel);
    if frame.layer >= count {
        discard;
    }
    let ray = pixel_ray(pixel);
    let hit = surface_hit(in.item, in.triangle, ray, fetch_triangle(in.item, in.triangle));
    if hit.depth < frame.near || hit.depth > frame.far {
        discard;
    }
    if tile.part_count == 0u {
        return keep(in, pixel, ray, hit.depth, Set());
    }
    let at = layers_at(tile, pixel);
    let next = frame.layer + 1u;
    if !is_begun(at, frame.layer, hit.depth) || (next < count && is_begun(at, next, hit.depth)) {
        discard;
    }
    return keep(in, pixel, ray, hit.depth, layer_set(at, frame.layer));
}

// For `explain`: the nearest fragment behind a given one, whatever the lenses make of it.
@fragment
fn next_behind(in: Varying) -> @location(0) vec2u {
    let hit = meeting(in.item, in.triangle, pixel_ray(vec2u(in.position.xy))).hit;
    if hit.depth < frame.near || hit.depth > frame.far {
        discard;
    }
    let key = triangle_number(in.item, in.triangle);
    let is_later = key > frame.after_key || (key == frame.after_key && in.item > frame.after_item);
    if hit.depth < frame.after_depth || (hit.depth == frame.after_depth && !is_later) {
        discard;
    }
    return vec2u(in.item + 1u, in.triangle);
}

// The drawn depth of a fragment.
fn z_of(in: Varying, depth: f32) -> f32 {
    if WIDE || has_planes(in.item) {
        return drawn_depth(depth);
    }
    return in.position.z;
}

// What becomes of a fragment inside the given lenses: removed, listed, or kept as opaque.
fn keep(in: Varying, pixel: vec2u, ray: PixelRay, depth: f32, inside: Set) -> Kept {
    let verdict = verdict_at(in.item, ray, tile_at(pixel), pixel, depth, inside);
    if !verdict.displayed {
        discard;
    }
    if TRANSLUCENT && may_be_translucent(in.item, verdict.stack) {
        append(head_of(pixel), meeting(in.item, in.triangle, ray).hit.depth, in.item, in.triangle);
        discard;
    }
    var z = z_of(in, depth);
    if verdict.fills {
        z = drawn_depth(depth + items[in.item].spread);
    }
    return kept(vec2u(in.item + 1u, in.triangle), z);
}
