// Colour spaces and compositing. Colours are linear light with straight alpha unless a name says otherwise.

// The sRGB transfer function of IEC 61966-2-1, one channel each way.
fn linear_from_srgb(c: f32) -> f32 {
    return select(pow((c + 0.055) / 1.055, 2.4), c / 12.92, c <= 0.04045);
}

fn srgb_from_linear(c: f32) -> f32 {
    let x = clamp(c, 0.0, 1.0);
    return select(1.055 * pow(x, 1.0 / 2.4) - 0.055, x * 12.92, x <= 0.0031308);
}

fn linear_from_srgb3(c: vec3f) -> vec3f {
    return vec3f(linear_from_srgb(c.x), linear_from_srgb(c.y), linear_from_srgb(c.z));
}

const TONE_NONE: u32 = 0u;
const TONE_NEUTRAL: u32 = 1u;

// Brings colours of any brightness into 0..1. Neutral: the PBR Neutral operator of the Khronos Group (2024), which keeps the
// hue and saturation of what is lit well and bends highlights towards white.
fn tone_mapped(mapping: u32, c: vec3f) -> vec3f {
    if mapping != TONE_NEUTRAL {
        return c;
    }
    let least = min(c.x, min(c.y, c.z));
    let offset = select(0.04, least - 6.25 * least * least, least < 0.08);
    let color = c - vec3f(offset);
    let peak = max(color.x, max(color.y, color.z));
    let start = 0.8 - 0.04;
    if peak < start {
        return color;
    }
    let room = 1.0 - start;
    let bent = 1.0 - room * room / (peak + room - start);
    let white = 1.0 - 1.0 / (0.15 * (peak - bent) + 1.0);
    return mix(color * (bent / peak), vec3f(bent), white);
}

// Relative luminance of BT.709 primaries.
fn luminance(c: vec3f) -> f32 {
    return dot(c, vec3f(0.2126, 0.7152, 0.0722));
}

// Porter and Duff's `over`, front to back: `front` is premultiplied, `back` straight with its own alpha.
fn over(front: vec4f, back: vec3f, alpha: f32) -> vec4f {
    let rest = (1.0 - front.a) * alpha;
    return vec4f(front.rgb + back * rest, front.a + rest);
}
