@group(0) @binding(0) var<uniform> time: f32;

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c * time;
}
