//! What a step computes: functions of 32-bit words, applied to each component or to whole values.

/// Words of the largest value that a built-in takes or gives: a 4x4 matrix.
pub const MOST_WORDS: usize = 16;

/// A function of whole values; what it does not use of the result stays zero.
pub type Whole = fn([&[u32]; 4]) -> [u32; MOST_WORDS];

/// A function of words. Those of components are applied to each; a scalar beside vectors counts for every one.
#[derive(Debug, Clone, Copy)]
pub enum Kernel {
    Each1(fn(u32) -> u32),
    Each2(fn(u32, u32) -> u32),
    Each3(fn(u32, u32, u32) -> u32),
    Whole(Whole),
}

/// [`Kernel::Each1`] to [`Kernel::Each3`] of floating-point numbers.
macro_rules! floats {
    (|$a:ident| $body:expr) => {
        Kernel::Each1(|a| {
            let $a = f32::from_bits(a);
            f32::to_bits($body)
        })
    };
    (|$a:ident, $b:ident| $body:expr) => {
        Kernel::Each2(|a, b| {
            let ($a, $b) = (f32::from_bits(a), f32::from_bits(b));
            f32::to_bits($body)
        })
    };
    (|$a:ident, $b:ident, $c:ident| $body:expr) => {
        Kernel::Each3(|a, b, c| {
            let ($a, $b, $c) = (f32::from_bits(a), f32::from_bits(b), f32::from_bits(c));
            f32::to_bits($body)
        })
    };
}

/// The same of signed whole numbers.
macro_rules! signed {
    (|$a:ident| $body:expr) => {
        Kernel::Each1(|a| {
            let $a = a as i32;
            ($body) as u32
        })
    };
    (|$a:ident, $b:ident| $body:expr) => {
        Kernel::Each2(|a, b| {
            let ($a, $b) = (a as i32, b as i32);
            ($body) as u32
        })
    };
    (|$a:ident, $b:ident, $c:ident| $body:expr) => {
        Kernel::Each3(|a, b, c| {
            let ($a, $b, $c) = (a as i32, b as i32, c as i32);
            ($body) as u32
        })
    };
}

/// A comparison of two numbers of a kind.
macro_rules! compare {
    ($kind:ty, $read:expr, $op:tt) => {
        Kernel::Each2(|a, b| {
            let read: fn(u32) -> $kind = $read;
            u32::from(read(a) $op read(b))
        })
    };
}

pub(super) use {compare, floats, signed};
