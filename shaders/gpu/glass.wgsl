// Lens surfaces along a ray: twin of `cpu/glass.rs`.

fn is_glass_before(a: GlassHit, b: GlassHit) -> bool {
    return a.depth < b.depth || (a.depth == b.depth && a.key < b.key);
}

// Whether the eye can see it.
fn is_drawn(hit: GlassHit) -> bool {
    return hit.depth > frame.near && hit.depth < frame.far && is_seen(hit);
}

// The next lens surface behind `after` that the eye can see.
fn next_glass(tile: TileRecord, pixel: vec2u, after: GlassHit) -> GlassHit {
    let ray = lens_ray(sample_point(pixel));
    var best = no_glass(FAR_AWAY, NONE);
    var compounds = false;
    for (var i = 0u; i < tile.part_count; i += 1u) {
        let asked = part_at(tile, i, pixel);
        let part = asked.part;
        let rank = parts[part].lens;
        if (lenses[rank].flags & LENS_GLASS) == 0u {
            continue;
        }
        if is_compound(rank) {
            compounds = true;
            continue;
        }
        let span = part_span(asked, ray);
        for (var side = 0u; side < select(0u, 2u, span.hit); side += 1u) {
            let hit = span_end(part, span, side);
            if is_drawn(hit) && is_glass_before(after, hit) && is_glass_before(hit, best) {
                best = hit;
            }
        }
    }
    if COMPOUNDS && compounds {
        best = next_compound_glass(tile, pixel, after, best);
    }
    return best;
}

// The same for lenses of several parts or a mesh, which begin and end where their bit changes from layer to layer;
// `best` where that is nearer.
fn next_compound_glass(tile: TileRecord, pixel: vec2u, after: GlassHit, best: GlassHit) -> GlassHit {
    let count = layer_count(tile, pixel);
    let at = layers_at(tile, pixel);
    for (var layer = 1u; layer < count; layer += 1u) {
        let depth = layer_start(at, layer);
        if depth < after.depth {
            continue;
        }
        if depth > best.depth {
            break;
        }
        let before = layer_set(at, layer - 1u);
        let behind = layer_set(at, layer);
        for (var w = 0u; w < WORDS; w += 1u) {
            var changed = before.words[w] ^ behind.words[w];
            while changed != 0u {
                let bit = firstTrailingBit(changed);
                changed = changed & (changed - 1u);
                let rank = 32u * w + bit;
                let key = 2u * rank + 1u - ((behind.words[w] >> bit) & 1u);
                let is_next = is_glass_before(after, no_glass(depth, key)) && is_glass_before(no_glass(depth, key), best);
                if (lenses[rank].flags & LENS_GLASS) == 0u || !is_compound(rank) || !is_next {
                    continue;
                }
                let hit = compound_glass(rank, key, lens_ray(sample_point(pixel)), depth);
                if hit.found && is_seen(hit) {
                    return hit;
                }
            }
        }
    }
    return best;
}

// Sides of flat parts go through the eye and are not seen.
fn is_seen(hit: GlassHit) -> bool {
    return parts[hit.part].form != FORM_HALF_SPACES || glass_face(hit) >= parts[hit.part].hidden;
}

// Its colour, with its opacity in alpha.
fn glass_color(hit: GlassHit, at: LensRay, ray: PixelRay) -> vec4f {
    let normal = surface_normal(hit.part, at, hit.depth, glass_face(hit));
    let facing = abs(dot(normal, normalize(ray.direction)));
    let glass = lenses[hit.key / 2u].glass;
    return vec4f(glass.color.rgb, glass_opacity(glass, facing, glass_silhouette(hit.part, at, hit.span, ray)));
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
fn glass_silhouette(part: u32, at: LensRay, span: Span, ray: PixelRay) -> f32 {
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
    if frame.perspective != 0u && frame.anchor + span.entry <= 0.0 {
        return FAR_AWAY;
    }
    let entry_normal = surface_normal(part, at, span.entry, span.entry_face);
    let exit_normal = surface_normal(part, at, span.exit, span.exit_face);
    let join = select(0u, 1u, is_smooth_join(part, span.entry_face, span.exit_face));
    return silhouette_distance(ray, frame.anchor, span.entry, entry_normal, span.exit, exit_normal, join);
}
