const LEVELS = 4.0;
const LEVELS = 5.0;

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return floor(c * LEVELS) / LEVELS;
}
