// What a cap looks like. Twin of `cpu/shade/cap.rs`, and of `cap_normal` in `cpu/pixel/caps.rs`.

// The place of a cap where a pixel's ray meets it: a triangle in its plane, and its normal in place of weights.
fn cap_meeting(item: u32, closing: Closing, ray: PixelRay, pixel: vec2u, depth: f32) -> Meeting {
    let normal = cap_normal(item, closing, ray, pixel, depth);
    let position = ray.origin + ray.direction * depth;
    let size = cap_piece(ray, depth);
    var t: Triangle;
    t.a = position;
    t.b = cap_corner(1u, position, normal, size);
    t.c = cap_corner(2u, position, normal, size);
    return Meeting(t, TriangleHit(normal, depth));
}

// The normal of the boundary that is closed, on the viewer's side, as shown.
fn cap_normal(item: u32, closing: Closing, ray: PixelRay, pixel: vec2u, depth: f32) -> vec3f {
    let rank = closing.boundary;
    let step = step_before(item, rank, false);
    let is_moved = MOVERS && step != 0u;
    var at = lens_ray(sample_point(pixel));
    if is_moved {
        at = moved_ray(step_point(step - 1u, ray.origin), step_vector(step - 1u, ray.direction));
    }
    let side = select(1u, 0u, closing.enters);
    let part = lenses[rank].first_part;
    var hit = no_glass(depth, 2u * rank + side);
    if is_compound(rank) {
        hit = compound_glass(rank, hit.key, at, depth);
    } else {
        hit = span_end(part, part_span(with_all_faces(part), at), side);
    }
    var normal = vec3f(0.0);
    if hit.found {
        normal = surface_normal(hit.part, at, depth, glass_face(hit));
    }
    if is_moved {
        let n = normal;
        normal = steps[step - 1u].row_x.xyz * n.x + steps[step - 1u].row_y.xyz * n.y + steps[step - 1u].row_z.xyz * n.z;
    }
    normal = normalize_or(normal, -normalize(ray.direction));
    return select(normal, -normal, dot(normal, ray.direction) > 0.0);
}

fn surface_of_cap(f: Fragment, at: Meeting, ray: PixelRay) -> Surface {
    let maker = f.triangle - FIRST_CAP;
    let normal = at.hit.weights;
    let words = cap_words(f.item, maker);
    var cap = Cap(CAP_OWN, items[f.item].node, vec4f(0.0));
    if words != NONE {
        cap.kind = lens_words[words + 1u];
        cap.color = vec4f(lens_vector(words + 2u), bitcast<f32>(lens_words[words + 5u]));
    }
    var own: Surface;
    if cap.kind == CAP_OWN {
        own = own_surface(f.item, at.triangle.a, normal, ray);
    } else {
        own = untextured(f.item, at.triangle.a, normal, ray);
    }
    // Its lines lie where it is cut.
    var position = own.position;
    let step = step_before(f.item, maker, false);
    if MOVERS && step != 0u {
        position = step_point(step - 1u, position);
    }
    let direction = cap_direction(normal, cap.variant);
    let along = dot(direction, (position - frame.texture_space.xyz) * frame.texture_space.w);
    let span = steps_at_source(step, steps_at(ray, own.position, normal));
    return cap_surface(cap, own, along, cap_span(span, direction) * frame.texture_space.w);
}

// Words before the nodes of a body's surface, and those of each of its triangles: see `cut_data::push_own`.
const OWN_WORDS: u32 = 13u;
const OWN_FACE_WORDS: u32 = 11u;

// The surface that a solid has where it is cut: that of its nearest point, with the cap's normal.
fn own_surface(item: u32, position: vec3f, normal: vec3f, ray: PixelRay) -> Surface {
    let body = items[item].body;
    let own = lens_words[body + 1u + lens_words[body]];
    if own == NONE {
        return untextured(item, position, normal, ray);
    }
    let step = items[item].first_step + items[item].step_count;
    var place = position;
    if MOVERS && items[item].step_count != 0u {
        place = step_point(step - 1u, position);
    }
    let p = vec3f(own_row(own, place), own_row(own + 4u, place), own_row(own + 8u, place));
    let node_count = lens_words[own + 12u];
    let first_node = own + OWN_WORDS;
    let first_face = first_node + node_count * NODE_WORDS;
    var nearest = first_face;
    var nearest_point = p;
    var least = FAR_AWAY;
    var node = 0u;
    while node < node_count {
        let at = first_node + node * NODE_WORDS;
        let first = lens_words[at + 3u];
        let count = lens_words[at + 7u];
        let away = p - clamp(p, lens_vector(at), lens_vector(at + 4u));
        if dot(away, away) >= least {
            node = select(node + 1u, first, count == 0u);
            continue;
        }
        for (var i = first; i < first + count; i += 1u) {
            let face = first_face + i * OWN_FACE_WORDS;
            let q = nearest_on_triangle(p, own_corners(face));
            if dot(q - p, q - p) < least {
                least = dot(q - p, q - p);
                nearest = face;
                nearest_point = q;
            }
        }
        node += 1u;
    }
    let found = lens_words[nearest + 9u];
    let corners = own_corners(nearest);
    let across = cross(corners[1] - corners[0], corners[2] - corners[0]);
    let a = corners[0] - nearest_point;
    let b = corners[1] - nearest_point;
    let c = corners[2] - nearest_point;
    var weights = vec3f(dot(across, cross(b, c)), dot(across, cross(c, a)), dot(across, cross(a, b)));
    weights = max(weights / max(dot(across, across), 1e-30), vec3f(0.0));
    let sum = weights.x + weights.y + weights.z;
    weights = select(vec3f(1.0, 0.0, 0.0), weights / max(sum, 1e-30), sum > 0.0);
    var s = untextured(found, position, normal, ray);
    let t = fetch_triangle(found, lens_words[nearest + 10u]);
    if VERTEX_COLORS && items[found].colors != NONE {
        s.factor *= interpolated4(items[found].colors, t.corners, weights);
    }
    if TEXTURES && (items[found].slots & (1u << SLOT_BASE_COLOR)) != 0u {
        let slot = materials[items[found].material].slots[SLOT_BASE_COLOR];
        let uv = slot_uv(found, t.corners, slot);
        let size = texture_size(slot.texture);
        // As many texels as there are on the surface over the length that a pixel spans on the cap.
        let along = (uv.b - uv.a) * size;
        let beside = (uv.c - uv.a) * size;
        let texels = abs(along.x * beside.y - along.y * beside.x);
        let area = max(length(cross(t.b - t.a, t.c - t.a)), 1e-30);
        let span = position_footprint(ray, position, normal);
        let at = uv.a * weights.x + uv.b * weights.y + uv.c * weights.z;
        s.texel = sample_texture(slot.texture, at, max(span.x, span.y) * sqrt(texels / area));
    }
    return s;
}

fn own_row(at: u32, p: vec3f) -> f32 {
    return dot(lens_vector(at), p) + bitcast<f32>(lens_words[at + 3u]);
}

fn own_corners(face: u32) -> array<vec3f, 3> {
    return array<vec3f, 3>(lens_vector(face), lens_vector(face + 3u), lens_vector(face + 6u));
}

// A cap's fragment as its surface takes it: without the lens that makes it.
fn without_maker(f: Fragment) -> Fragment {
    var others = f;
    let maker = f.triangle - FIRST_CAP;
    others.stack.words[maker / 32u] &= ~(1u << (maker % 32u));
    return others;
}
