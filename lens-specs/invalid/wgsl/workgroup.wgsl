var<workgroup> shared_sum: array<f32, 64>;

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c * shared_sum[0];
}
