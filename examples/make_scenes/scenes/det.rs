//! Transcendental functions from additions, products, quotients and square roots only, which IEEE 754 fixes to the
//! last bit; the platform's own `sin` may differ between machines, and the generated files must not.

use std::f64::consts::{FRAC_PI_2, PI};

use glam::{DMat3, DVec3};

/// Sine, for |x| up to some thousands.
pub fn sin(x: f64) -> f64 {
    let quarter = (x / FRAC_PI_2).round();
    let r = x - quarter * FRAC_PI_2;
    match (quarter as i64).rem_euclid(4) {
        0 => sin_core(r),
        1 => cos_core(r),
        2 => -sin_core(r),
        _ => -cos_core(r),
    }
}

/// Cosine, for |x| up to some thousands.
pub fn cos(x: f64) -> f64 {
    sin(x + FRAC_PI_2)
}

fn sin_core(r: f64) -> f64 {
    let q = r * r;
    let terms = [156.0, 110.0, 72.0, 42.0, 20.0, 6.0];
    r * terms.iter().fold(1.0, |sum, d| 1.0 - q / d * sum)
}

fn cos_core(r: f64) -> f64 {
    let q = r * r;
    let terms = [182.0, 132.0, 90.0, 56.0, 30.0, 12.0, 2.0];
    terms.iter().fold(1.0, |sum, d| 1.0 - q / d * sum)
}

/// Arc tangent.
pub fn atan(x: f64) -> f64 {
    // Three halvings of the angle bring any x into |x| < 0.2, where the series is short.
    let halved = (0..3).fold(x, |t, _| t / (1.0 + (1.0 + t * t).sqrt()));
    let q = halved * halved;
    let series = (0..12).rev().fold(0.0, |sum, k| 1.0 / f64::from(2 * k + 1) - q * sum);
    8.0 * halved * series
}

/// `x` to the power 2.4 for x >= 0, as sRGB needs it.
fn pow_2_4(x: f64) -> f64 {
    if x <= 0.0 {
        return 0.0;
    }
    let square = x * x;
    // Newton's method for the fifth root of x².
    let root = (0..60).fold(1.0_f64, |r, _| r - (r - square / (r * r * r * r)) / 5.0);
    square * root
}

/// Linear light of an sRGB component in 0..1, rounded to 1e-4.
fn linear(c: f64) -> f32 {
    let light = if c <= 0.04045 { c / 12.92 } else { pow_2_4((c + 0.055) / 1.055) };
    ((light * 1e4).round() / 1e4) as f32
}

/// Linear light of an sRGB colour `0xrrggbb`.
pub fn rgb(hex: u32) -> [f32; 3] {
    srgb_bytes(hex).map(|b| linear(f64::from(b) / 255.0))
}

/// The three bytes of `0xrrggbb`.
pub fn srgb_bytes(hex: u32) -> [u8; 3] {
    [(hex >> 16) as u8, (hex >> 8) as u8, hex as u8]
}

/// Smooth 0..1 ramp from `a` to `b`.
pub fn smoothstep(a: f64, b: f64, x: f64) -> f64 {
    let t = ((x - a) / (b - a)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

pub fn lerp(a: f64, b: f64, t: f64) -> f64 {
    a + (b - a) * t
}

pub fn radians(degrees: f64) -> f64 {
    degrees * PI / 180.0
}

/// Rotation by `angle` radians about a unit axis.
pub fn rotation(axis: DVec3, angle: f64) -> DMat3 {
    let (s, c) = (sin(angle), cos(angle));
    let column = |v: DVec3| v * c + axis.cross(v) * s + axis * axis.dot(v) * (1.0 - c);
    DMat3::from_cols(column(DVec3::X), column(DVec3::Y), column(DVec3::Z))
}

/// The rotation that carries +z onto a unit direction and keeps x as near to `x_hint` as it can.
pub fn frame(direction: DVec3, x_hint: DVec3) -> DMat3 {
    let x = (x_hint - direction * x_hint.dot(direction)).normalize();
    DMat3::from_cols(x, direction.cross(x), direction)
}

/// The quaternion `[x, y, z, w]` of a rotation matrix.
pub fn quaternion(m: DMat3) -> [f64; 4] {
    let (x, y, z) = (m.x_axis, m.y_axis, m.z_axis);
    let w2 = 1.0 + x.x + y.y + z.z;
    let q = if w2 > 1.0 {
        [y.z - z.y, z.x - x.z, x.y - y.x, w2]
    } else if x.x > y.y && x.x > z.z {
        [1.0 + x.x - y.y - z.z, x.y + y.x, z.x + x.z, y.z - z.y]
    } else if y.y > z.z {
        [x.y + y.x, 1.0 + y.y - x.x - z.z, y.z + z.y, z.x - x.z]
    } else {
        [z.x + x.z, y.z + z.y, 1.0 + z.z - x.x - y.y, x.y - y.x]
    };
    let length = q.iter().map(|v| v * v).sum::<f64>().sqrt();
    q.map(|v| v / length)
}
