// Lets the outline glow: the more a surface turns away from the eye, the more light it gives off.

struct Params {
    color: vec3f,   // = "#66ccff": of the glow
    strength: f32,  // = 2.0: how bright it is where the surface turns away
    falloff: f32,   // = 3.0: higher draws the glow closer to the outline
}

fn filter_surface(s: Surface, p: Params) -> Surface {
    var glowing = s;
    let away = 1.0 - saturate(dot(s.normal, s.view));
    glowing.emissive += p.strength * pow(away, p.falloff) * p.color;
    return glowing;
}
