// Reads texels from the pages; which ones and how they are weighed is the appearance shaders' say.

fn texture_size(texture: u32) -> vec2f {
    let packed = textures[texture].levels[0].w;
    return vec2f(f32(packed & 0xffffu), f32(packed >> 16u));
}

// A texture's colour at `uv` in linear light, for a pixel that spans `footprint` texels of level 0.
fn sample_texture(texture: u32, uv: vec2f, footprint: f32) -> vec4f {
    let mips = choose_mips(textures[texture].filter_bits, footprint, textures[texture].level_count);
    let first = sample_level(texture, mips.first, uv, mips.linear != 0u);
    if mips.mix == 0.0 {
        return first;
    }
    return mix(first, sample_level(texture, mips.second, uv, mips.linear != 0u), mips.mix);
}

fn sample_level(texture: u32, level: u32, uv: vec2f, linear: bool) -> vec4f {
    let place = textures[texture].levels[level];
    let size = vec2i(i32(place.w & 0xffffu), i32(place.w >> 16u));
    let wraps = vec2u(textures[texture].wrap_u, textures[texture].wrap_v);
    let at = vec2f(wrap_coordinate(uv.x, wraps.x), wrap_coordinate(uv.y, wraps.y)) * vec2f(size);
    if !linear {
        return texel(texture, place, size, wraps, vec2i(floor(at)));
    }
    let corner = floor(at - 0.5);
    let share = at - 0.5 - corner;
    let p = vec2i(corner);
    let top = mix(
        texel(texture, place, size, wraps, p),
        texel(texture, place, size, wraps, p + vec2i(1, 0)),
        share.x,
    );
    let bottom = mix(
        texel(texture, place, size, wraps, p + vec2i(0, 1)),
        texel(texture, place, size, wraps, p + vec2i(1, 1)),
        share.x,
    );
    return mix(top, bottom, share.y);
}

fn texel(texture: u32, place: vec4u, size: vec2i, wraps: vec2u, p: vec2i) -> vec4f {
    let within = vec2i(wrap_texel(p.x, size.x, wraps.x), wrap_texel(p.y, size.y, wraps.y));
    let at = vec2i(place.xy) + within;
    if textures[texture].srgb != 0u {
        return textureLoad(pages_srgb, at, i32(place.z), 0);
    }
    return textureLoad(pages, at, i32(place.z), 0);
}
