// Lens surfaces along a ray: twin of `cpu/glass.rs`.

struct GlassHit {
    depth: f32,
    // Twice the rank, plus one for the exit: the order of surfaces at one depth.
    key: u32,
    found: bool,
    // The part of the lens, and its whole crossing.
    part: u32,
    span: Span,
}

// The next lens surface behind `after` that the eye can see.
fn next_glass(tile: TileRecord, at: vec2f, after: GlassHit) -> GlassHit {
    var best = GlassHit(FAR_AWAY, NONE, false, 0u, no_span());
    for (var i = 0u; i < tile.part_count; i += 1u) {
        let part = tiles[tile.first_part + i];
        let rank = parts[part].lens;
        if (lenses[rank].flags & LENS_GLASS) == 0u {
            continue;
        }
        let span = part_span(part, at);
        if !span.hit {
            continue;
        }
        for (var side = 0u; side < 2u; side += 1u) {
            let depth = select(span.exit, span.entry, side == 0u);
            let face = select(span.exit_face, span.entry_face, side == 0u);
            let key = 2u * rank + side;
            let seen = parts[part].form != FORM_HALF_SPACES || face >= parts[part].hidden;
            let behind = depth > after.depth || (depth == after.depth && key > after.key);
            let nearer = depth < best.depth || (depth == best.depth && key < best.key);
            if seen && behind && nearer && depth > frame.near && depth < frame.far {
                best = GlassHit(depth, key, true, part, span);
            }
        }
    }
    return best;
}

// Its colour, with its opacity in alpha.
fn glass_color(hit: GlassHit, at: vec2f, ray: PixelRay) -> vec4f {
    let span = hit.span;
    let face = select(span.exit_face, span.entry_face, hit.key % 2u == 0u);
    let normal = surface_normal(hit.part, at, hit.depth, face);
    let facing = abs(dot(normal, normalize(ray.direction)));
    let glass = lenses[hit.key / 2u].glass;
    return vec4f(glass.color.rgb, glass_opacity(glass, facing, glass_silhouette(hit.part, at, span, ray)));
}

// Outward unit normal where the pixel's ray crosses the surface.
fn surface_normal(part: u32, at: vec2f, depth: f32, face: u32) -> vec3f {
    if parts[part].form == FORM_HALF_SPACES {
        return lens_data[parts[part].first_plane + 2u * face + 1u].xyz;
    }
    let ray = local_ray(part, at);
    let p = ray.origin + ray.direction * depth;
    var n = p;
    if parts[part].form == FORM_CONE {
        let slope = parts[part].r1 - parts[part].r0;
        n = vec3f(p.xy, -slope * (parts[part].r0 + slope * p.z));
        if face != CONE_SIDE {
            n = vec3f(0.0, 0.0, select(1.0, -1.0, face == 0u));
        }
    } else if parts[part].form == FORM_CAPSULE {
        n = p - vec3f(0.0, 0.0, clamp(p.z, 0.0, parts[part].length));
    }
    let turned = parts[part].normal_x.xyz * n.x + parts[part].normal_y.xyz * n.y + parts[part].normal_z.xyz * n.z;
    return normalize_or(turned, vec3f(0.0));
}

fn is_smooth_join(part: u32, a: u32, b: u32) -> bool {
    switch parts[part].form {
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
fn glass_silhouette(part: u32, at: vec2f, span: Span, ray: PixelRay) -> f32 {
    if (parts[part].flags & PART_FLAT) != 0u {
        let first = parts[part].first_corner;
        let count = parts[part].corner_count;
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
    let entry_normal = surface_normal(part, at, span.entry, span.entry_face);
    let exit_normal = surface_normal(part, at, span.exit, span.exit_face);
    let join = select(0u, 1u, is_smooth_join(part, span.entry_face, span.exit_face));
    return silhouette_distance(ray, span.entry, entry_normal, span.exit, exit_normal, join);
}
