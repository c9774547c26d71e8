//! The built-in functions of WGSL that work on each component.

use naga::{MathFunction as Fun, ScalarKind};

use super::kernel::{Kernel, floats, signed};
use super::{packing, vectors};

/// `None` for what the interpreter does not have; such a filter is refused when it is read.
pub fn function(fun: Fun, kind: ScalarKind) -> Option<Kernel> {
    let of_kind = match kind {
        ScalarKind::Float => float(fun),
        ScalarKind::Sint => sint(fun),
        ScalarKind::Uint => uint(fun),
        _ => None,
    };
    of_kind.or_else(|| vectors::function(fun, kind)).or_else(|| packing::function(fun))
}

fn float(fun: Fun) -> Option<Kernel> {
    Some(match fun {
        Fun::Abs => floats!(|x| x.abs()),
        Fun::Min => floats!(|a, b| a.min(b)),
        Fun::Max => floats!(|a, b| a.max(b)),
        Fun::Clamp => floats!(|x, low, high| x.max(low).min(high)),
        Fun::Saturate => floats!(|x| x.clamp(0.0, 1.0)),
        Fun::Ceil => floats!(|x| x.ceil()),
        Fun::Floor => floats!(|x| x.floor()),
        Fun::Round => floats!(|x| x.round_ties_even()),
        Fun::Fract => floats!(|x| x - x.floor()),
        Fun::Trunc => floats!(|x| x.trunc()),
        Fun::Sign => floats!(|x| if x > 0.0 {
            1.0
        } else if x < 0.0 {
            -1.0
        } else {
            0.0
        }),
        Fun::Fma => floats!(|a, b, c| a * b + c),
        Fun::Mix => floats!(|a, b, t| a * (1.0 - t) + b * t),
        Fun::Step => floats!(|edge, x| if x >= edge { 1.0 } else { 0.0 }),
        Fun::SmoothStep => floats!(|low, high, x| {
            let t = ((x - low) / (high - low)).clamp(0.0, 1.0);
            t * t * (3.0 - 2.0 * t)
        }),
        Fun::Sqrt => floats!(|x| x.sqrt()),
        Fun::InverseSqrt => floats!(|x| 1.0 / x.sqrt()),
        Fun::Ldexp => Kernel::Each2(|x, e| ldexp(f32::from_bits(x), e as i32).to_bits()),
        _ => return transcendental(fun),
    })
}

fn transcendental(fun: Fun) -> Option<Kernel> {
    Some(match fun {
        Fun::Cos => floats!(|x| x.cos()),
        Fun::Cosh => floats!(|x| x.cosh()),
        Fun::Sin => floats!(|x| x.sin()),
        Fun::Sinh => floats!(|x| x.sinh()),
        Fun::Tan => floats!(|x| x.tan()),
        Fun::Tanh => floats!(|x| x.tanh()),
        Fun::Acos => floats!(|x| x.acos()),
        Fun::Asin => floats!(|x| x.asin()),
        Fun::Atan => floats!(|x| x.atan()),
        Fun::Atan2 => floats!(|y, x| y.atan2(x)),
        Fun::Asinh => floats!(|x| x.asinh()),
        Fun::Acosh => floats!(|x| x.acosh()),
        Fun::Atanh => floats!(|x| x.atanh()),
        Fun::Radians => floats!(|x| x.to_radians()),
        Fun::Degrees => floats!(|x| x.to_degrees()),
        Fun::Exp => floats!(|x| x.exp()),
        Fun::Exp2 => floats!(|x| x.exp2()),
        Fun::Log => floats!(|x| x.ln()),
        Fun::Log2 => floats!(|x| x.log2()),
        Fun::Pow => floats!(|x, y| x.powf(y)),
        _ => return None,
    })
}

/// x * 2^e, rounded once.
fn ldexp(x: f32, e: i32) -> f32 {
    // Beyond this the result is zero or infinite whatever x is, and every power within is a number of f64.
    const MOST: i32 = 400;
    (f64::from(x) * 2f64.powi(e.clamp(-MOST, MOST))) as f32
}

fn sint(fun: Fun) -> Option<Kernel> {
    Some(match fun {
        Fun::Abs => signed!(|x| x.wrapping_abs()),
        Fun::Min => signed!(|a, b| a.min(b)),
        Fun::Max => signed!(|a, b| a.max(b)),
        Fun::Clamp => signed!(|x, low, high| x.max(low).min(high)),
        Fun::Sign => signed!(|x| x.signum()),
        Fun::ExtractBits => Kernel::Whole(|args| each_bits(args, extract_signed)),
        // The highest bit that differs from the sign.
        Fun::FirstLeadingBit => {
            signed!(|x| if x == 0 || x == -1 { -1 } else { 31 - (if x < 0 { !x } else { x }).leading_zeros() as i32 })
        }
        _ => return bits(fun),
    })
}

fn uint(fun: Fun) -> Option<Kernel> {
    Some(match fun {
        Fun::Abs => Kernel::Each1(|x| x),
        Fun::Min => Kernel::Each2(u32::min),
        Fun::Max => Kernel::Each2(u32::max),
        Fun::Clamp => Kernel::Each3(|x, low, high| x.max(low).min(high)),
        Fun::ExtractBits => Kernel::Whole(|args| each_bits(args, extract)),
        Fun::FirstLeadingBit => Kernel::Each1(|x| if x == 0 { u32::MAX } else { 31 - x.leading_zeros() }),
        _ => return bits(fun),
    })
}

fn bits(fun: Fun) -> Option<Kernel> {
    Some(match fun {
        Fun::CountTrailingZeros => Kernel::Each1(u32::trailing_zeros),
        Fun::CountLeadingZeros => Kernel::Each1(u32::leading_zeros),
        Fun::CountOneBits => Kernel::Each1(u32::count_ones),
        Fun::ReverseBits => Kernel::Each1(u32::reverse_bits),
        Fun::FirstTrailingBit => Kernel::Each1(|x| if x == 0 { u32::MAX } else { x.trailing_zeros() }),
        Fun::InsertBits => Kernel::Whole(insert),
        _ => return None,
    })
}

/// The bits that an offset and a count name, both cut to what there is: the offset and the count.
fn range(offset: u32, count: u32) -> (u32, u32) {
    let offset = offset.min(32);
    (offset, count.min(32 - offset))
}

/// `count` ones.
fn ones(count: u32) -> u32 {
    if count == 0 { 0 } else { u32::MAX >> (32 - count) }
}

fn extract(x: u32, offset: u32, count: u32) -> u32 {
    let (offset, count) = range(offset, count);
    x.checked_shr(offset).unwrap_or(0) & ones(count)
}

fn extract_signed(x: u32, offset: u32, count: u32) -> u32 {
    let (_, count) = range(offset, count);
    if count == 0 {
        return 0;
    }
    let unused = 32 - count;
    (((extract(x, offset, count) << unused) as i32) >> unused) as u32
}

fn each_bits([x, offset, count, _]: [&[u32]; 4], f: fn(u32, u32, u32) -> u32) -> [u32; super::kernel::MOST_WORDS] {
    vectors::filled(x.iter().map(|x| f(*x, offset[0], count[0])))
}

fn insert([x, new, offset, count]: [&[u32]; 4]) -> [u32; super::kernel::MOST_WORDS] {
    let (offset, count) = range(offset[0], count[0]);
    let mask = ones(count).checked_shl(offset).unwrap_or(0);
    vectors::filled(x.iter().zip(new).map(|(x, new)| (x & !mask) | (new.checked_shl(offset).unwrap_or(0) & mask)))
}
