// Takes everything out of its range, or only to the end of it.

struct Params {
    beyond: bool,
}

fn filter_surface(s: Surface, p: Params) -> Surface {
    var r = s;
    r.normal = s.normal * select(1.0, 1e30, p.beyond);
    r.metallic = select(1.0, 7.0, p.beyond);
    r.roughness = select(0.0, -3.0, p.beyond);
    r.occlusion = select(1.0, 9.0, p.beyond);
    r.unlit = select(0.0, -2.0, p.beyond);
    r.opacity = select(1.0, 5.0, p.beyond);
    return r;
}
