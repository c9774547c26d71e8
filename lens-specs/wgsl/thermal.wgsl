// Shows how bright the lit surface is as a thermal camera shows heat: black, violet, red, yellow, white.

struct Params {
    low: f32,     // the brightness that is shown black, linear light
    high: f32,    // = 1: the brightness that is shown white, linear light
    amount: f32,  // = 1: how much of the false colour is mixed in, 0 to 1
}

// As the eye sees them, encoded in sRGB.
const STOPS = array<vec3f, 5>(
    vec3f(0.0, 0.0, 0.0),
    vec3f(0.35, 0.0, 0.55),
    vec3f(0.9, 0.1, 0.2),
    vec3f(1.0, 0.8, 0.1),
    vec3f(1.0, 1.0, 1.0),
);

// The colour at x, from 0 to 1.
fn heat(x: f32) -> vec3f {
    let at = 4.0 * saturate(x);
    let below = min(u32(at), 3u);
    return linear_from_srgb(mix(STOPS[below], STOPS[below + 1u], at - f32(below)));
}

fn filter_color(c: vec3f, s: Surface, p: Params) -> vec3f {
    let x = (luminance(c) - p.low) / max(p.high - p.low, 1e-6);
    return mix(c, heat(x), p.amount);
}
