// Texture addressing: which texels a sample reads and how they are weighed. Reading them is each backend's own.

const WRAP_REPEAT: u32 = 0u;
const WRAP_MIRROR: u32 = 1u;
const WRAP_CLAMP: u32 = 2u;

const FILTER_MAG_LINEAR: u32 = 1u;
const FILTER_MIN_LINEAR: u32 = 2u;
const FILTER_MIPS: u32 = 4u;
const FILTER_MIPS_LINEAR: u32 = 8u;

// The texel that stands for index `i` outside or inside of 0..size.
fn wrap_texel(i: i32, size: i32, mode: u32) -> i32 {
    if mode == WRAP_CLAMP {
        return clamp(i, 0, size - 1);
    }
    let period = select(size, 2 * size, mode == WRAP_MIRROR);
    let turns = i32(floor(f32(i) / f32(period)));
    let within = i - turns * period;
    return clamp(select(within, period - 1 - within, within >= size), 0, size - 1);
}

// Brings a coordinate near zero first, where texel indices are exact.
fn wrap_coordinate(u: f32, mode: u32) -> f32 {
    if mode == WRAP_CLAMP {
        return clamp(u, -1.0, 2.0);
    }
    return u - 2.0 * floor(0.5 * u);
}

// Mip levels to read and how to mix them, for a pixel that spans `footprint` texels of level 0.
struct MipChoice {
    first: u32,
    second: u32,
    // Share of the second.
    mix: f32,
    // Not 0: bilinear within a level.
    linear: u32,
}

fn choose_mips(filter_bits: u32, footprint: f32, levels: u32) -> MipChoice {
    let lod = log2(max(footprint, 1e-8));
    if lod <= 0.0 {
        return MipChoice(0u, 0u, 0.0, filter_bits & FILTER_MAG_LINEAR);
    }
    let linear = filter_bits & FILTER_MIN_LINEAR;
    if (filter_bits & FILTER_MIPS) == 0u {
        return MipChoice(0u, 0u, 0.0, linear);
    }
    let top = f32(levels - 1u);
    if (filter_bits & FILTER_MIPS_LINEAR) == 0u {
        let nearest = u32(clamp(floor(lod + 0.5), 0.0, top));
        return MipChoice(nearest, nearest, 0.0, linear);
    }
    let clamped = clamp(lod, 0.0, top);
    let first = floor(clamped);
    return MipChoice(u32(first), u32(min(first + 1.0, top)), clamped - first, linear);
}

// Coordinates after a material's texture transform.
fn transform_uv(uv: vec2f, offset: vec2f, matrix: vec4f) -> vec2f {
    return offset + matrix.xy * uv.x + vec2f(matrix.z, matrix.w) * uv.y;
}
