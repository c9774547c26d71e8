fn filter_color(c: vec3f, s: Surface) -> vec3f {
    let fine = f64(c.x);
    return vec3f(f32(fine));
}
