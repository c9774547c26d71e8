//! The built-in functions of WGSL that pack several small numbers into one word.

use naga::MathFunction as Fun;

use super::kernel::{Kernel, MOST_WORDS, Whole};
use super::vectors::{filled, floats, numbers};

pub fn function(fun: Fun) -> Option<Kernel> {
    let whole: Whole = match fun {
        Fun::Pack4x8snorm => |[v, ..]| bytes(floats(v).map(|x| snorm(x, 127.0) as u8)),
        Fun::Pack4x8unorm => |[v, ..]| bytes(floats(v).map(|x| unorm(x, 255.0) as u8)),
        Fun::Pack2x16snorm => |[v, ..]| halves(floats(v).map(|x| snorm(x, 32767.0) as u16)),
        Fun::Pack2x16unorm => |[v, ..]| halves(floats(v).map(|x| unorm(x, 65535.0) as u16)),
        Fun::Pack4xI8 | Fun::Pack4xU8 => |[v, ..]| bytes(v.iter().map(|x| *x as u8)),
        Fun::Pack4xI8Clamp => |[v, ..]| bytes(v.iter().map(|x| (*x as i32).clamp(-128, 127) as u8)),
        Fun::Pack4xU8Clamp => |[v, ..]| bytes(v.iter().map(|x| (*x).min(255) as u8)),
        Fun::Unpack4x8snorm => |[v, ..]| numbers(v[0].to_le_bytes().map(|b| (f32::from(b as i8) / 127.0).max(-1.0))),
        Fun::Unpack4x8unorm => |[v, ..]| numbers(v[0].to_le_bytes().map(|b| f32::from(b) / 255.0)),
        Fun::Unpack2x16snorm => |[v, ..]| numbers(split(v[0]).map(|h| (f32::from(h as i16) / 32767.0).max(-1.0))),
        Fun::Unpack2x16unorm => |[v, ..]| numbers(split(v[0]).map(|h| f32::from(h) / 65535.0)),
        Fun::Unpack4xI8 => |[v, ..]| filled(v[0].to_le_bytes().map(|b| i32::from(b as i8) as u32)),
        Fun::Unpack4xU8 => |[v, ..]| filled(v[0].to_le_bytes().map(u32::from)),
        Fun::Dot4I8Packed => |[a, b, ..]| {
            let products = a[0].to_le_bytes().into_iter().zip(b[0].to_le_bytes());
            filled([products.map(|(a, b)| i32::from(a as i8) * i32::from(b as i8)).sum::<i32>() as u32])
        },
        Fun::Dot4U8Packed => |[a, b, ..]| {
            let products = a[0].to_le_bytes().into_iter().zip(b[0].to_le_bytes());
            filled([products.map(|(a, b)| u32::from(a) * u32::from(b)).sum()])
        },
        _ => return None,
    };
    Some(Kernel::Whole(whole))
}

/// -1..1 to a whole number of -scale..scale, halves upwards as WGSL says.
fn snorm(x: f32, scale: f32) -> i32 {
    (0.5 + scale * x.clamp(-1.0, 1.0)).floor() as i32
}

fn unorm(x: f32, scale: f32) -> u32 {
    (0.5 + scale * x.clamp(0.0, 1.0)).floor() as u32
}

/// The first is the lowest.
fn bytes(parts: impl Iterator<Item = u8>) -> [u32; MOST_WORDS] {
    filled([parts.enumerate().fold(0, |word, (i, part)| word | u32::from(part) << (8 * i))])
}

fn halves(parts: impl Iterator<Item = u16>) -> [u32; MOST_WORDS] {
    filled([parts.enumerate().fold(0, |word, (i, part)| word | u32::from(part) << (16 * i))])
}

fn split(word: u32) -> [u16; 2] {
    [word as u16, (word >> 16) as u16]
}
