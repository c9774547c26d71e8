// The user's own filters: between a surface on its way through a stack and what their files see (`custom::wgsl` declares
// `CustomSurface` and chooses among the files). Twin of `cpu/custom.rs`.

// Where a filter acts: the point that the lenses above its own take its content from.
fn source_position(op: Op, rank: u32, item: u32, position: vec3f) -> vec3f {
    let step = step_before(item, rank, op.inner != 0u);
    if MOVERS && step != 0u {
        return step_point(step - 1u, position);
    }
    return position;
}

fn seen_by_custom(s: Surface, position: vec3f) -> CustomSurface {
    return CustomSurface(
        position + frame.origin,
        s.normal,
        s.view,
        base_color(s),
        s.metallic,
        s.roughness,
        s.emissive,
        s.occlusion,
        surface_opacity(s),
        s.unlit,
        s.pixel,
        frame.anchor + dot(position, frame.forward.xyz),
    );
}

fn custom_filtered(op: Op, before: Surface, position: vec3f) -> Surface {
    let seen = seen_by_custom(before, position);
    let made = custom_surface(op.texture, seen, op_channel(op));
    var s = before;
    s.normal = normalize_or(made.normal, before.normal);
    if any(made.base_color != seen.base_color) {
        s = with_base_color(s, vec4f(made.base_color, 1.0));
    }
    s.metallic = saturate(made.metallic);
    s.roughness = saturate(made.roughness);
    s.emissive = made.emissive;
    s.occlusion = saturate(made.occlusion);
    // What the filter makes of the whole opacity, the stack makes of its share.
    s.opacity = before.opacity * (saturate(made.opacity) / max(seen.opacity, 1e-6));
    s.unlit = saturate(made.unlit);
    return s;
}

fn custom_colored(op: Op, c: vec3f, s: Surface, position: vec3f) -> vec3f {
    return custom_color(op.texture, c, seen_by_custom(s, position), op_channel(op));
}
