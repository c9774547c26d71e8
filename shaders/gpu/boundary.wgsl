// Where a lens begins or ends on a ray: which part's surface that is, and its normal.

struct GlassHit {
    depth: f32,
    // Twice the rank, plus one where the ray leaves the lens: the order of surfaces at one depth.
    key: u32,
    found: bool,
    // The part whose surface it is and its whole crossing, which ends here or starts here.
    part: u32,
    span: Span,
    is_exit: bool,
}

fn no_glass(depth: f32, key: u32) -> GlassHit {
    return GlassHit(depth, key, false, 0u, no_span(), false);
}

// One end of the crossing of a lens of one convex part; `side`: 0 where the ray enters it, 1 where it leaves.
fn span_end(part: u32, span: Span, side: u32) -> GlassHit {
    return GlassHit(select(span.exit, span.entry, side == 0u), 2u * parts[part].lens + side, true, part, span, side == 1u);
}

fn glass_face(hit: GlassHit) -> u32 {
    return select(hit.span.entry_face, hit.span.exit_face, hit.is_exit);
}

fn span_around(part: u32, ray: LensRay, depth: f32) -> Span {
    if parts[part].form == FORM_MESH {
        return mesh_span(part, ray, depth);
    }
    return part_span(with_all_faces(part), ray);
}

// The surface of a lens where it begins or ends at `depth`: of the first part whose crossing there makes a difference.
// Goes from crossing to crossing, at one depth in the order of the parts, until the lens has changed.
fn compound_glass(rank: u32, key: u32, ray: LensRay, depth: f32) -> GlassHit {
    let merge = merge_at(depth);
    // Rounding differs between passes, and between a mesh's triangles in space and in the picture; another lens may have
    // drawn the boundary nearer by one merge, and another part of this one by one more.
    var reached = depth - 0.5 * merge;
    let last = depth + 2.0 * merge;
    var hit = no_glass(depth, key);
    var number = NONE;
    loop {
        // Which parts hold the ray there, and the next crossing.
        inside_parts = array<u32, PART_WORDS>();
        var next = no_glass(last, key);
        var next_number = NONE;
        for (var i = 0u; i < lenses[rank].part_count; i += 1u) {
            let part = lenses[rank].first_part + i;
            let span = span_around(part, ray, depth);
            for (var side = 0u; side < select(0u, 2u, span.hit); side += 1u) {
                let t = select(span.entry, span.exit, side == 1u);
                if t < reached || (t == reached && i <= number) {
                    cross_part(i);
                } else if t < next.depth {
                    next = GlassHit(t, key, true, part, span, side == 1u);
                    next_number = i;
                }
            }
        }
        if program_holds(rank) == (key % 2u == 0u) || !next.found {
            break;
        }
        reached = next.depth;
        number = next_number;
        hit = next;
    }
    hit.depth = depth;
    return hit;
}

// Outward unit normal where the pixel's ray crosses the surface.
fn surface_normal(part: u32, at: LensRay, depth: f32, face: u32) -> vec3f {
    if parts[part].form == FORM_HALF_SPACES {
        return lens_data[parts[part].first_plane + 2u * face + 1u].xyz;
    }
    let ray = local_ray(part, at);
    let p = ray.origin + ray.direction * depth;
    var n = p;
    if parts[part].form == FORM_MESH {
        n = triangle_normal(part, face);
    } else if parts[part].form == FORM_CONE {
        let slope = parts[part].r1 - parts[part].r0;
        n = vec3f(p.xy, -slope * (parts[part].r0 + slope * p.z));
        if face != CONE_SIDE {
            n = vec3f(0.0, 0.0, select(1.0, -1.0, face == 0u));
        }
    } else if parts[part].form == FORM_CAPSULE {
        n = p - vec3f(0.0, 0.0, clamp(p.z, 0.0, parts[part].length));
    }
    return normalize_or(turned_normal(part, n), vec3f(0.0));
}
