// Gives a surface bumps: its normal leans away from where a noise grows.

struct Params {
    size: f32,    // = 0.1: how wide a bump is, scene units
    height: f32,  // = 0.4: how high it is; 0 leaves the surface smooth
}

const STEP = 0.05;

fn filter_surface(s: Surface, p: Params) -> Surface {
    var bumpy = s;
    let at = s.position / p.size;
    let x = noise3(at + vec3f(STEP, 0.0, 0.0)) - noise3(at - vec3f(STEP, 0.0, 0.0));
    let y = noise3(at + vec3f(0.0, STEP, 0.0)) - noise3(at - vec3f(0.0, STEP, 0.0));
    let z = noise3(at + vec3f(0.0, 0.0, STEP)) - noise3(at - vec3f(0.0, 0.0, STEP));
    let slope = vec3f(x, y, z) / (2.0 * STEP);
    // Of the slope, what lies in the surface.
    let along = slope - dot(slope, s.normal) * s.normal;
    bumpy.normal = normalize(s.normal - p.height * along);
    return bumpy;
}
