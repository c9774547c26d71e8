alias Params = f32;

fn filter_color(c: vec3f, s: Surface, p: Params) -> vec3f {
    return c * p;
}
