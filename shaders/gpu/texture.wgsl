// Reads texels from the pages; which ones and how they are weighed is the appearance shaders' say.

fn texture_size(texture: u32) -> vec2f {
    let packed = textures[texture].levels[0].w;
    return vec2f(f32(packed & 0xffffu), f32(packed >> 16u));
}

// A texture's colour at `uv` in linear light, for a pixel that spans `footprint` texels of level 0.
fn sample_texture(texture: u32, uv: vec2f, footprint: f32) -> vec4f {
    let mips = choose_mips(textures[texture].filter_bits, footprint, textures[texture].level_count);
    var sum = vec4f(0.0);
    for (var i = 0u; i < select(1u, 2u, mips.mix > 0.0); i += 1u) {
        let share = select(mips.mix, 1.0 - mips.mix, i == 0u);
        sum += sample_level(texture, select(mips.second, mips.first, i == 0u), uv, mips.linear != 0u) * share;
    }
    return sum;
}

fn sample_level(texture: u32, level: u32, uv: vec2f, linear: bool) -> vec4f {
    let place = textures[texture].levels[level];
    let size = vec2i(i32(place.w & 0xffffu), i32(place.w >> 16u));
    let wraps = vec2u(textures[texture].wrap_u, textures[texture].wrap_v);
    let at = vec2f(wrap_coordinate(uv.x, wraps.x), wrap_coordinate(uv.y, wraps.y)) * vec2f(size);
    let shift = select(0.0, 0.5, linear);
    let corner = floor(at - shift);
    let part = at - shift - corner;
    var sum = vec4f(0.0);
    for (var i = 0u; i < select(1u, 4u, linear); i += 1u) {
        let step = vec2u(i & 1u, i >> 1u);
        let shares = select(1.0 - part, part, step == vec2u(1u));
        sum += texel(texture, place, size, wraps, vec2i(corner) + vec2i(step)) * select(1.0, shares.x * shares.y, linear);
    }
    return sum;
}

fn texel(texture: u32, place: vec4u, size: vec2i, wraps: vec2u, p: vec2i) -> vec4f {
    let within = vec2i(wrap_texel(p.x, size.x, wraps.x), wrap_texel(p.y, size.y, wraps.y));
    let at = vec2i(place.xy) + within;
    if textures[texture].srgb != 0u {
        return textureLoad(pages_srgb, at, i32(place.z), 0);
    }
    return textureLoad(pages, at, i32(place.z), 0);
}
