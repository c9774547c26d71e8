// Paints level stripes around a model, one each `spacing` of height.

struct Params {
    color: vec3f,   // = "#ff8c1a": of the stripes
    spacing: f32,   // = 0.25: from one stripe to the next, scene units
    share: f32,     // = 0.3: how much of the spacing a stripe takes up, 0 to 1
    softness: f32,  // = 0.02: how much of the spacing an edge takes up
}

fn filter_surface(s: Surface, p: Params) -> Surface {
    var painted = s;
    let amount = stripe(s.position.y / p.spacing, p.share, p.softness);
    painted.base_color = mix(s.base_color, p.color, amount);
    return painted;
}
