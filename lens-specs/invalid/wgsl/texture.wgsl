@group(0) @binding(0) var image: texture_2d<f32>;

fn filter_color(c: vec3f, s: Surface) -> vec3f {
    return c * textureLoad(image, vec2i(s.pixel), 0).rgb;
}
