fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c;
}

@fragment
fn main() -> @location(0) vec4f {
    return vec4f(1.0);
}
