// Where a pixel's ray crosses one plane of a part.

struct PlaneCrossing {
    // Parameter along the ray.
    t: f32,
    // How fast the ray leaves the half-space; negative where it enters.
    rate: f32,
    // Signed distance of the ray's origin; positive outside.
    distance: f32,
}

fn plane_crossing(part: u32, face: u32, at: vec2f) -> PlaneCrossing {
    let k = lens_data[parts[part].first_plane + 2u * face];
    let moving = k.y + k.z * at.x + k.w * at.y;
    let distance = select(moving, k.x, frame.perspective != 0u);
    let rate = select(k.x, moving, frame.perspective != 0u);
    let t = clamp(-distance / select(rate, 1e-30, rate == 0.0), -FAR_AWAY, FAR_AWAY);
    return PlaneCrossing(t, rate, distance);
}
