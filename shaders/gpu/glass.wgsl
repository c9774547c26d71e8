// Lens surfaces along a ray: twin of `cpu/glass.rs`.

struct GlassHit {
    depth: f32,
    // Twice the rank, plus one for the exit: the order of surfaces at one depth.
    key: u32,
    found: bool,
    // The whole crossing of its lens.
    span: Span,
}

// The next lens surface behind `after` that the eye can see.
fn next_glass(tile: TileRecord, at: vec2f, after: GlassHit) -> GlassHit {
    var best = GlassHit(FAR_AWAY, NONE, false, no_span());
    for (var i = 0u; i < tile.lens_count; i += 1u) {
        let rank = tiles[tile.first_lens + i];
        if (lenses[rank].flags & LENS_GLASS) == 0u {
            continue;
        }
        let span = lens_span(rank, at);
        if !span.hit {
            continue;
        }
        for (var side = 0u; side < 2u; side += 1u) {
            let depth = select(span.exit, span.entry, side == 0u);
            let face = select(span.exit_face, span.entry_face, side == 0u);
            let key = 2u * rank + side;
            let seen = lenses[rank].form != FORM_HALF_SPACES || face >= lenses[rank].hidden;
            let behind = depth > after.depth || (depth == after.depth && key > after.key);
            let nearer = depth < best.depth || (depth == best.depth && key < best.key);
            if seen && behind && nearer && depth > frame.near && depth < frame.far {
                best = GlassHit(depth, key, true, span);
            }
        }
    }
    return best;
}

// Its colour, with its opacity in alpha.
fn glass_color(hit: GlassHit, at: vec2f, ray: PixelRay) -> vec4f {
    let rank = hit.key / 2u;
    let span = hit.span;
    let face = select(span.exit_face, span.entry_face, hit.key % 2u == 0u);
    let normal = surface_normal(rank, at, hit.depth, face);
    let facing = abs(dot(normal, normalize(ray.direction)));
    let glass = lenses[rank].glass;
    return vec4f(glass.color.rgb, glass_opacity(glass, facing, glass_silhouette(rank, at, span, ray)));
}

// Outward unit normal where the pixel's ray crosses the surface.
fn surface_normal(rank: u32, at: vec2f, depth: f32, face: u32) -> vec3f {
    if lenses[rank].form == FORM_HALF_SPACES {
        return lens_data[lenses[rank].first_plane + 2u * face + 1u].xyz;
    }
    let ray = local_ray(rank, at);
    let p = ray.origin + ray.direction * depth;
    var n = p;
    if lenses[rank].form == FORM_CONE {
        let slope = lenses[rank].r1 - lenses[rank].r0;
        n = vec3f(p.xy, -slope * (lenses[rank].r0 + slope * p.z));
        if face != CONE_SIDE {
            n = vec3f(0.0, 0.0, select(1.0, -1.0, face == 0u));
        }
    } else if lenses[rank].form == FORM_CAPSULE {
        n = p - vec3f(0.0, 0.0, clamp(p.z, 0.0, lenses[rank].length));
    }
    let turned = lenses[rank].normal_x.xyz * n.x + lenses[rank].normal_y.xyz * n.y + lenses[rank].normal_z.xyz * n.z;
    return normalize_or(turned, vec3f(0.0));
}

fn is_smooth_join(rank: u32, a: u32, b: u32) -> bool {
    switch lenses[rank].form {
        case FORM_SPHERE, FORM_CAPSULE: {
            return true;
        }
        case FORM_CONE: {
            return a == CONE_SIDE && b == CONE_SIDE;
        }
        default: {
            return false;
        }
    }
}

// Pixels from the lens's outline in the picture.
fn glass_silhouette(rank: u32, at: vec2f, span: Span, ray: PixelRay) -> f32 {
    if (lenses[rank].flags & LENS_FLAT) != 0u {
        let first = lenses[rank].first_corner;
        let count = lenses[rank].corner_count;
        var nearest = FAR_AWAY;
        for (var i = 0u; i < count; i += 1u) {
            let a = lens_data[first + i].xyz;
            let b = lens_data[first + (i + 1u) % count].xyz;
            nearest = min(nearest, edge_distance(ray, a, b));
        }
        return nearest;
    }
    // Around the eye a volume has no outline.
    if frame.perspective != 0u && span.entry <= 0.0 {
        return FAR_AWAY;
    }
    let entry_normal = surface_normal(rank, at, span.entry, span.entry_face);
    let exit_normal = surface_normal(rank, at, span.exit, span.exit_face);
    let join = select(0u, 1u, is_smooth_join(rank, span.entry_face, span.exit_face));
    return silhouette_distance(ray, span.entry, entry_normal, span.exit, exit_normal, join);
}
