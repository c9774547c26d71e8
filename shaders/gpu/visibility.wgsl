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
    let depth = in.depth;
    if depth < frame.near || depth > frame.far {
        discard;
    }
    if !TAKEN_AWAY && !TRANSLUCENT {
        return kept(vec2u(in.item + 1u, in.triangle), z_of(in, depth));
    }
    let around = set_at(tile_at(pixel), pixel, depth);
    let at = keep(in, Place(depth, z_of(in, depth), 0u), pixel, pixel_ray(pixel), around);
    return kept(at.found, at.z);
}

// The same of triangles some of which have their depths from their planes.
@fragment
fn fused_in_planes(in: Varying) -> KeptAt {
    let pixel = vec2u(in.position.xy);
    let ray = pixel_ray(pixel);
    let place = place_of(in, ray);
    if place.depth < frame.near || place.depth > frame.far {
        discard;
    }
    if !TAKEN_AWAY && !TRANSLUCENT {
        return KeptAt(vec2u(in.item + 1u, in.triangle), place.z);
    }
    let around = set_at(tile_at(pixel), pixel, place.depth);
    return keep(in, place, pixel, ray, around);
}

// `peel`: one layer at a time, its set of lenses taken from the layer.
@fragment
fn peel(in: Varying) -> Kept {
    let ray = pixel_ray(vec2u(in.position.xy));
    let depth = surface_hit(NONE, ray, fetch_triangle(in.item, in.triangle)).depth;
    let at = keep_in_layer(in, Place(depth, z_of(in, depth), 0u), ray);
    return kept(at.found, at.z);
}

@fragment
fn peel_in_planes(in: Varying) -> KeptAt {
    let ray = pixel_ray(vec2u(in.position.xy));
    return keep_in_layer(in, place_of(in, ray), ray);
}

fn keep_in_layer(in: Varying, place: Place, ray: PixelRay) -> KeptAt {
    let pixel = vec2u(in.position.xy);
    let tile = tile_at(pixel);
    let count = layer_count(tile, pixel);
    if frame.layer >= count || place.depth < frame.near || place.depth > frame.far {
        discard;
    }
    if tile.part_count == 0u {
        return keep(in, place, pixel, ray, Set());
    }
    let at = layers_at(tile, pixel);
    let next = frame.layer + 1u;
    if !is_begun(at, frame.layer, place.depth) || (next < count && is_begun(at, next, place.depth)) {
        discard;
    }
    return keep(in, place, pixel, ray, layer_set(at, frame.layer));
}

// For `explain`: the nearest fragment behind a given one, whatever the lenses make of it.
@fragment
fn next_behind(in: Varying) -> KeptAt {
    let place = place_of(in, pixel_ray(vec2u(in.position.xy)));
    if place.depth < frame.near || place.depth > frame.far {
        discard;
    }
    let key = triangle_number(in.item, in.triangle);
    let is_later = key > frame.after_key || (key == frame.after_key && in.item > frame.after_item);
    if place.depth < frame.after_depth || (place.depth == frame.after_depth && !is_later) {
        discard;
    }
    return KeptAt(vec2u(in.item + 1u, in.triangle), place.z);
}

// Where a fragment is, and where it is drawn.
struct Place {
    depth: f32,
    z: f32,
    // How many others of its plane are drawn before it.
    rank: u32,
}

// Of a triangle that has its depth from its plane, that.
fn place_of(in: Varying, ray: PixelRay) -> Place {
    let plane = plane_at(in.item, in.triangle);
    let depth = surface_hit(plane, ray, fetch_triangle(in.item, in.triangle)).depth;
    if PLANES && plane != NONE {
        let rank = lens_words[plane + 1u];
        return Place(depth, ranked(drawn_depth(depth), rank), rank);
    }
    return Place(depth, z_of(in, depth), 0u);
}

// What a fragment of the scene leaves, and how near it is drawn.
struct KeptAt {
    @location(0) found: vec2u,
    @builtin(frag_depth) z: f32,
}

// The drawn depth of a fragment.
fn z_of(in: Varying, depth: f32) -> f32 {
    if WIDE {
        return drawn_depth(depth);
    }
    return in.position.z;
}

// What becomes of a fragment inside the given lenses: removed, listed, or kept as opaque.
fn keep(in: Varying, place: Place, pixel: vec2u, ray: PixelRay, inside: Set) -> KeptAt {
    let verdict = verdict_at(in.item, ray, tile_at(pixel), pixel, place.depth, inside);
    if !verdict.displayed {
        discard;
    }
    if TRANSLUCENT && may_be_translucent(in.item, verdict.stack) {
        append(head_of(pixel), meeting(in.item, in.triangle, ray).hit.depth, in.item, in.triangle);
        discard;
    }
    var z = place.z;
    if verdict.fills {
        z = ranked(drawn_depth(place.depth + items[in.item].spread), place.rank);
    }
    return KeptAt(vec2u(in.item + 1u, in.triangle), z);
}
