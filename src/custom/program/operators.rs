//! The operators of WGSL on scalars and vectors.

use naga::{BinaryOperator as Op, ScalarKind, UnaryOperator};

use super::kernel::{Kernel, compare, floats, signed};

pub fn unary(op: UnaryOperator, kind: ScalarKind) -> Option<Kernel> {
    Some(match (op, kind) {
        (UnaryOperator::Negate, ScalarKind::Float) => floats!(|x| -x),
        (UnaryOperator::Negate, ScalarKind::Sint) => signed!(|x| x.wrapping_neg()),
        (UnaryOperator::LogicalNot, ScalarKind::Bool) => Kernel::Each1(|x| x ^ 1),
        (UnaryOperator::BitwiseNot, ScalarKind::Sint | ScalarKind::Uint) => Kernel::Each1(|x| !x),
        _ => return None,
    })
}

pub fn binary(op: Op, kind: ScalarKind) -> Option<Kernel> {
    match kind {
        ScalarKind::Float => float(op),
        ScalarKind::Sint => sint(op),
        ScalarKind::Uint => uint(op),
        ScalarKind::Bool => boolean(op),
        ScalarKind::AbstractInt | ScalarKind::AbstractFloat => None,
    }
}

fn float(op: Op) -> Option<Kernel> {
    Some(match op {
        Op::Add => floats!(|a, b| a + b),
        Op::Subtract => floats!(|a, b| a - b),
        Op::Multiply => floats!(|a, b| a * b),
        Op::Divide => floats!(|a, b| a / b),
        // By WGSL's own formula, which differs from the exact remainder that Rust gives.
        Op::Modulo => floats!(|a, b| a - b * (a / b).trunc()),
        Op::Equal => compare!(f32, f32::from_bits, ==),
        Op::NotEqual => compare!(f32, f32::from_bits, !=),
        Op::Less => compare!(f32, f32::from_bits, <),
        Op::LessEqual => compare!(f32, f32::from_bits, <=),
        Op::Greater => compare!(f32, f32::from_bits, >),
        Op::GreaterEqual => compare!(f32, f32::from_bits, >=),
        _ => return None,
    })
}

/// Sums and products wrap around; x / 0 is x and x % 0 is 0, as WGSL says, and so for the quotient that overflows.
fn sint(op: Op) -> Option<Kernel> {
    Some(match op {
        Op::Divide => signed!(|a, b| if b == 0 { a } else { a.wrapping_div(b) }),
        Op::Modulo => signed!(|a, b| if b == 0 { 0 } else { a.wrapping_rem(b) }),
        Op::Less => compare!(i32, |word| word as i32, <),
        Op::LessEqual => compare!(i32, |word| word as i32, <=),
        Op::Greater => compare!(i32, |word| word as i32, >),
        Op::GreaterEqual => compare!(i32, |word| word as i32, >=),
        Op::ShiftRight => Kernel::Each2(|a, b| (a as i32).wrapping_shr(b) as u32),
        _ => return bits(op),
    })
}

fn uint(op: Op) -> Option<Kernel> {
    Some(match op {
        Op::Divide => Kernel::Each2(|a, b| a.checked_div(b).unwrap_or(a)),
        Op::Modulo => Kernel::Each2(|a, b| a.checked_rem(b).unwrap_or(0)),
        Op::Less => compare!(u32, |word| word, <),
        Op::LessEqual => compare!(u32, |word| word, <=),
        Op::Greater => compare!(u32, |word| word, >),
        Op::GreaterEqual => compare!(u32, |word| word, >=),
        Op::ShiftRight => Kernel::Each2(u32::wrapping_shr),
        _ => return bits(op),
    })
}

/// What is the same for signed and unsigned numbers. Shifts count modulo 32.
fn bits(op: Op) -> Option<Kernel> {
    Some(match op {
        Op::Add => Kernel::Each2(u32::wrapping_add),
        Op::Subtract => Kernel::Each2(u32::wrapping_sub),
        Op::Multiply => Kernel::Each2(u32::wrapping_mul),
        Op::Equal => compare!(u32, |word| word, ==),
        Op::NotEqual => compare!(u32, |word| word, !=),
        Op::And => Kernel::Each2(|a, b| a & b),
        Op::ExclusiveOr => Kernel::Each2(|a, b| a ^ b),
        Op::InclusiveOr => Kernel::Each2(|a, b| a | b),
        Op::ShiftLeft => Kernel::Each2(u32::wrapping_shl),
        _ => return None,
    })
}

fn boolean(op: Op) -> Option<Kernel> {
    Some(match op {
        Op::Equal => compare!(u32, |word| word, ==),
        Op::NotEqual => compare!(u32, |word| word, !=),
        Op::And | Op::LogicalAnd => Kernel::Each2(|a, b| a & b),
        Op::InclusiveOr | Op::LogicalOr => Kernel::Each2(|a, b| a | b),
        _ => return None,
    })
}

/// Conversion of a number's value. Fractions are cut off, and what does not fit is clamped to the largest number that
/// both types have.
pub fn convert(from: ScalarKind, to: ScalarKind) -> Option<Kernel> {
    use ScalarKind::{Bool, Float, Sint, Uint};
    Some(match (from, to) {
        (Float, Sint) => Kernel::Each1(|x| f32::from_bits(x).clamp(-2_147_483_648.0, 2_147_483_520.0) as i32 as u32),
        (Float, Uint) => Kernel::Each1(|x| f32::from_bits(x).clamp(0.0, 4_294_967_040.0) as u32),
        (Sint, Float) => Kernel::Each1(|x| (x as i32 as f32).to_bits()),
        (Uint, Float) => Kernel::Each1(|x| (x as f32).to_bits()),
        (Bool, Float) => Kernel::Each1(|x| (x as f32).to_bits()),
        (Float, Bool) => Kernel::Each1(|x| u32::from(f32::from_bits(x) != 0.0)),
        (Sint | Uint, Bool) => Kernel::Each1(|x| u32::from(x != 0)),
        (Float, Float) | (Bool, Bool) | (Sint | Uint | Bool, Sint | Uint) => Kernel::Each1(|x| x),
        _ => return None,
    })
}
