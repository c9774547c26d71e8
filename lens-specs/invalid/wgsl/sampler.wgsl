@group(0) @binding(0) var smooth_sampler: sampler;

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c;
}
