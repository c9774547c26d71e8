// How much a soft lens counts: it fades in from its boundary inwards. Twin of `lens/inside.rs`.

// The share (0..1) of its filters' work that a lens of the stack does on a fragment shown at `position`.
fn soft_amount(rank: u32, item: u32, position: vec3f) -> f32 {
    if !SOFT || lenses[rank].soft <= 0.0 {
        return 1.0;
    }
    var asked = position;
    let step = step_before(item, rank, false);
    if (lenses[rank].flags & LENS_BY_OBJECT) != 0u {
        asked = items[item].center;
    } else if MOVERS && step != 0u {
        asked = step_point(step - 1u, position);
    }
    return clamp(depth_inside(rank, asked) / lenses[rank].soft, 0.0, 1.0);
}

// The distance from a point to the boundary of a lens, positive inside; of a compound to the boundaries of its parts.
// Runs the program over distances: a part that is taken away counts from outside, both is the lesser, either the greater.
fn depth_inside(rank: u32, p: vec3f) -> f32 {
    // Programs never hold more values than a word has bits.
    var stack: array<f32, 32>;
    var top = 0u;
    let first = lenses[rank].first_token;
    let count = lenses[rank].token_count;
    // A lens without a program is its only part.
    for (var i = 0u; i < max(count, 1u); i += 1u) {
        var token = TOKEN_INSIDE;
        if count != 0u {
            token = lens_words[first + i];
        }
        let kind = token & 3u;
        if kind == TOKEN_BOTH || kind == TOKEN_EITHER {
            top -= 1u;
            stack[top - 1u] = select(
                max(stack[top - 1u], stack[top]),
                min(stack[top - 1u], stack[top]),
                kind == TOKEN_BOTH,
            );
        } else {
            let depth = depth_inside_part(lenses[rank].first_part + (token >> 2u), p);
            stack[top] = select(-depth, depth, kind == TOKEN_INSIDE);
            top += 1u;
        }
    }
    return stack[0];
}

fn depth_inside_part(part: u32, p: vec3f) -> f32 {
    let q = local_point(part, p);
    switch parts[part].form {
        case FORM_SPHERE: {
            return below(part, 1.0 - length(q), normalize_or(q, vec3f(1.0, 0.0, 0.0)));
        }
        case FORM_CONE: {
            let slope = parts[part].r1 - parts[part].r0;
            let outward = normalize_or(vec3f(q.xy, 0.0), vec3f(1.0, 0.0, 0.0));
            let up = vec3f(0.0, 0.0, 1.0);
            let side = below(part, parts[part].r0 + slope * q.z - length(q.xy), slope * up - outward);
            return min(side, min(below(part, q.z, up), below(part, 1.0 - q.z, up)));
        }
        case FORM_CAPSULE: {
            let outward = q - vec3f(0.0, 0.0, clamp(q.z, 0.0, parts[part].length));
            return below(part, 1.0 - length(outward), normalize_or(outward, vec3f(1.0, 0.0, 0.0)));
        }
        case FORM_HALF_SPACES: {
            var least = FAR_AWAY;
            for (var face = 0u; face < parts[part].plane_count; face += 1u) {
                let plane = lens_data[parts[part].first_plane + 2u * face + 1u];
                least = min(least, plane.w - dot(plane.xyz, p));
            }
            return least;
        }
        case FORM_MESH: {
            return depth_inside_mesh(part, q);
        }
        default: {
            return -FAR_AWAY;
        }
    }
}

// A height inside a surface over the length of its gradient in the world.
fn below(part: u32, height: f32, gradient: vec3f) -> f32 {
    return height / length(turned_normal(part, gradient));
}

fn depth_inside_mesh(part: u32, q: vec3f) -> f32 {
    if !COMPOUNDS {
        return -FAR_AWAY;
    }
    let outward = nearest_in_mesh(part, q) - q;
    let height = select(-length(outward), length(outward), is_in_mesh(part, q));
    return below(part, height, normalize_or(outward, vec3f(1.0, 0.0, 0.0)));
}
