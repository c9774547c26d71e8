// The rays that parts of lenses are asked about, and where one crosses a plane of a part.

// A pixel's own ray, or one that lenses have moved.
struct LensRay {
    // The point of the picture.
    at: vec2f,
    is_moved: bool,
    // Of a moved ray.
    origin: vec3f,
    direction: vec3f,
}

fn lens_ray(at: vec2f) -> LensRay {
    return LensRay(at, false, vec3f(0.0), vec3f(0.0));
}

fn moved_ray(origin: vec3f, direction: vec3f) -> LensRay {
    return LensRay(vec2f(0.0), true, origin, direction);
}

struct PlaneCrossing {
    // Parameter along the ray.
    t: f32,
    // How fast the ray leaves the half-space; negative where it enters.
    rate: f32,
    // Signed distance of the ray's origin; positive outside.
    distance: f32,
}

fn plane_crossing(part: u32, face: u32, ray: LensRay) -> PlaneCrossing {
    let first = parts[part].first_plane + 2u * face;
    var distance = 0.0;
    var rate = 0.0;
    if MOVERS && ray.is_moved {
        let plane = lens_data[first + 1u];
        distance = dot(plane.xyz, ray.origin) - plane.w;
        rate = dot(plane.xyz, ray.direction);
    } else {
        // Distance and rate of the ray of the picture's middle, and what a pixel's steps add.
        let k = lens_data[first];
        let from_middle = ray.at - frame.middle;
        let across = k.z * from_middle.x + k.w * from_middle.y;
        distance = k.x + across * frame.shares.x;
        rate = k.y + across * frame.shares.y;
    }
    let t = clamp(-distance / select(rate, 1e-30, rate == 0.0), -FAR_AWAY, FAR_AWAY);
    return PlaneCrossing(t, rate, distance);
}
