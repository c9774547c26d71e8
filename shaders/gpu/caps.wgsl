// What a cap looks like. Twin of `cpu/shade/cap.rs`, and of `cap_normal` in `cpu/pixel/caps.rs`.

// The place of a cap where a pixel's ray meets it: a triangle in its plane, and its normal in place of weights.
fn cap_meeting(item: u32, closing: Closing, ray: PixelRay, pixel: vec2u, depth: f32) -> Meeting {
    let normal = cap_normal(item, closing, ray, pixel, depth);
    let position = ray.origin + ray.direction * depth;
    let size = CAP_PIECE * length(position);
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
    let own = untextured(f.item, at.triangle.a, normal, ray);
    let words = cap_words(f.item, maker);
    var cap = Cap(CAP_OWN, items[f.item].node, vec4f(0.0));
    if words != NONE {
        cap.kind = lens_words[words + 1u];
        cap.color = vec4f(lens_vector(words + 2u), bitcast<f32>(lens_words[words + 5u]));
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

// A cap's fragment as its surface takes it: without the lens that makes it.
fn without_maker(f: Fragment) -> Fragment {
    var others = f;
    let maker = f.triangle - FIRST_CAP;
    others.stack.words[maker / 32u] &= ~(1u << (maker % 32u));
    return others;
}
