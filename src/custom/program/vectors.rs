//! The built-in functions of WGSL that work on whole vectors and matrices.

use naga::{MathFunction as Fun, RelationalFunction, ScalarKind};

use super::kernel::{Kernel, MOST_WORDS, Whole};

pub fn function(fun: Fun, kind: ScalarKind) -> Option<Kernel> {
    let whole: Whole = match (fun, kind) {
        (Fun::Dot, ScalarKind::Float) => |[a, b, ..]| number(dot(a, b)),
        (Fun::Dot, _) => |[a, b, ..]| filled([a.iter().zip(b).fold(0, |sum, (a, b)| wrapping(sum, *a, *b))]),
        (Fun::Cross, _) => |[a, b, ..]| {
            let [ax, ay, az] = [0, 1, 2].map(|i| f32::from_bits(a[i]));
            let [bx, by, bz] = [0, 1, 2].map(|i| f32::from_bits(b[i]));
            numbers([ay * bz - az * by, az * bx - ax * bz, ax * by - ay * bx])
        },
        (Fun::Length, _) => |[a, ..]| number(length(a)),
        (Fun::Distance, _) => |[a, b, ..]| number(each(a, b).map(|(a, b)| (a - b) * (a - b)).sum::<f32>().sqrt()),
        (Fun::Normalize, _) => |[a, ..]| {
            let length = length(a);
            numbers(floats(a).map(|x| x / length))
        },
        (Fun::FaceForward, _) => |[n, incident, reference, _]| {
            let sign = if dot(reference, incident) < 0.0 { 1.0 } else { -1.0 };
            numbers(floats(n).map(|x| sign * x))
        },
        (Fun::Reflect, _) => |[incident, n, ..]| {
            let twice = 2.0 * dot(n, incident);
            numbers(each(incident, n).map(|(i, n)| i - twice * n))
        },
        (Fun::Refract, _) => |[incident, n, ratio, _]| refract(incident, n, f32::from_bits(ratio[0])),
        (Fun::Determinant, _) => |[m, ..]| number(determinant(m)),
        (Fun::Modf, _) => |[a, ..]| {
            let fractions = floats(a).map(|x| x - x.trunc());
            numbers(fractions.chain(floats(a).map(f32::trunc)))
        },
        (Fun::Frexp, _) => |[a, ..]| {
            let fractions = floats(a).map(|x| frexp(x).0.to_bits());
            filled(fractions.chain(floats(a).map(|x| frexp(x).1 as u32)))
        },
        _ => return None,
    };
    Some(Kernel::Whole(whole))
}

pub fn relational(fun: RelationalFunction) -> Option<Kernel> {
    match fun {
        RelationalFunction::All => Some(Kernel::Whole(|[a, ..]| filled([u32::from(a.iter().all(|x| *x != 0))]))),
        RelationalFunction::Any => Some(Kernel::Whole(|[a, ..]| filled([u32::from(a.iter().any(|x| *x != 0))]))),
        RelationalFunction::IsNan | RelationalFunction::IsInf => None,
    }
}

/// The transpose of a matrix with that many columns, given column by column.
pub fn transpose(columns: usize) -> Option<Kernel> {
    fn turned(m: &[u32], columns: usize) -> [u32; MOST_WORDS] {
        let rows = m.len() / columns;
        filled((0..rows).flat_map(|row| (0..columns).map(move |column| m[column * rows + row])))
    }
    match columns {
        2 => Some(Kernel::Whole(|[m, ..]| turned(m, 2))),
        3 => Some(Kernel::Whole(|[m, ..]| turned(m, 3))),
        4 => Some(Kernel::Whole(|[m, ..]| turned(m, 4))),
        _ => None,
    }
}

/// The words given, then zeros.
pub fn filled(words: impl IntoIterator<Item = u32>) -> [u32; MOST_WORDS] {
    let mut all = [0; MOST_WORDS];
    all.iter_mut().zip(words).for_each(|(to, word)| *to = word);
    all
}

pub fn numbers(numbers: impl IntoIterator<Item = f32>) -> [u32; MOST_WORDS] {
    filled(numbers.into_iter().map(f32::to_bits))
}

fn number(x: f32) -> [u32; MOST_WORDS] {
    numbers([x])
}

pub fn floats(words: &[u32]) -> impl Iterator<Item = f32> {
    words.iter().map(|word| f32::from_bits(*word))
}

fn each(a: &[u32], b: &[u32]) -> impl Iterator<Item = (f32, f32)> {
    floats(a).zip(floats(b))
}

fn dot(a: &[u32], b: &[u32]) -> f32 {
    each(a, b).map(|(a, b)| a * b).sum()
}

fn wrapping(sum: u32, a: u32, b: u32) -> u32 {
    sum.wrapping_add(a.wrapping_mul(b))
}

/// Also of a scalar.
fn length(a: &[u32]) -> f32 {
    match a {
        [x] => f32::from_bits(*x).abs(),
        _ => dot(a, a).sqrt(),
    }
}

fn refract(incident: &[u32], n: &[u32], ratio: f32) -> [u32; MOST_WORDS] {
    let cos = dot(n, incident);
    let k = 1.0 - ratio * ratio * (1.0 - cos * cos);
    if k < 0.0 {
        return [0; MOST_WORDS];
    }
    let along = ratio * cos + k.sqrt();
    numbers(each(incident, n).map(|(i, n)| ratio * i - along * n))
}

fn determinant(m: &[u32]) -> f32 {
    let at = |column: usize, row: usize, size: usize| f32::from_bits(m[column * size + row]);
    let two = |size, [a, b]: [usize; 2], [r, s]: [usize; 2]| {
        at(a, r, size) * at(b, s, size) - at(b, r, size) * at(a, s, size)
    };
    match m.len() {
        4 => two(2, [0, 1], [0, 1]),
        9 => {
            at(0, 0, 3) * two(3, [1, 2], [1, 2]) - at(1, 0, 3) * two(3, [0, 2], [1, 2])
                + at(2, 0, 3) * two(3, [0, 1], [1, 2])
        }
        // By Laplace's rule over pairs of rows.
        _ => {
            two(4, [0, 1], [0, 1]) * two(4, [2, 3], [2, 3]) - two(4, [0, 2], [0, 1]) * two(4, [1, 3], [2, 3])
                + two(4, [0, 3], [0, 1]) * two(4, [1, 2], [2, 3])
                + two(4, [1, 2], [0, 1]) * two(4, [0, 3], [2, 3])
                - two(4, [1, 3], [0, 1]) * two(4, [0, 2], [2, 3])
                + two(4, [2, 3], [0, 1]) * two(4, [0, 1], [2, 3])
        }
    }
}

/// A fraction of which the magnitude is in [0.5, 1), or zero, and the power of two to multiply it by.
fn frexp(x: f32) -> (f32, i32) {
    const SUBNORMAL_SCALE: f32 = 16_777_216.0;
    const SUBNORMAL_SHIFT: i32 = 24;
    if x == 0.0 || !x.is_finite() {
        return (x, 0);
    }
    let (scaled, shift) = if x.is_normal() { (x, 0) } else { (x * SUBNORMAL_SCALE, SUBNORMAL_SHIFT) };
    let exponent = ((scaled.to_bits() >> 23) & 0xff) as i32 - 126;
    let fraction = f32::from_bits((scaled.to_bits() & 0x807f_ffff) | (126 << 23));
    (fraction, exponent - shift)
}
