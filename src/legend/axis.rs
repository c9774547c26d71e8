//! Round numbers along a range of values.

use crate::drawing::round_step;

/// What values are written as.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Unit {
    Plain,
    Degrees,
}

/// A value that is written, where it lies between the ends (0 to 1).
#[derive(Debug, Clone, PartialEq)]
pub struct Tick {
    pub at: f64,
    pub text: String,
}

/// As many round numbers between two values as there is room for beside each other: `room` letters. Where no two fit,
/// the ends themselves.
pub fn ticks([low, high]: [f64; 2], unit: Unit, room: usize) -> Vec<Tick> {
    let length = high - low;
    if !length.is_finite() || length <= 0.0 {
        return vec![Tick { at: 0.5, text: number(low, low.abs().max(1e-3) * 1e-3, unit) }];
    }
    let tick = |value: f64, step: f64| Tick { at: (value - low) / length, text: number(value, step, unit) };
    for count in (2..=5).rev() {
        let step = step(length / f64::from(count), unit);
        let slack = 1e-9 * length;
        let numbers = ((low - slack) / step).ceil() as i64..=((high + slack) / step).floor() as i64;
        let ticks: Vec<Tick> = numbers.map(|n| tick(n as f64 * step, step)).collect();
        let letters: usize = ticks.iter().map(|tick| tick.text.chars().count() + 2).sum();
        if ticks.len() > 1 && letters <= room {
            return ticks;
        }
    }
    vec![tick(low, length * 0.01), tick(high, length * 0.01)]
}

/// The least step that is not below and round for the unit.
fn step(least: f64, unit: Unit) -> f64 {
    if unit == Unit::Degrees && least > 10.0 {
        return [15.0, 30.0, 45.0, 90.0].into_iter().find(|round| *round >= least).unwrap_or(90.0);
    }
    round_step(least)
}

/// A number with the digits that it has, six at most.
pub fn exact(value: f64) -> String {
    let rounded: f64 = format!("{value:.5e}").parse().unwrap_or(value);
    if rounded == 0.0 || (1e-4..1e7).contains(&rounded.abs()) { rounded.to_string() } else { format!("{rounded:e}") }
}

/// A number with the digits that a step needs.
pub fn number(value: f64, step: f64, unit: Unit) -> String {
    let value = if value.abs() < step * 1e-6 { 0.0 } else { value };
    let exponent = |x: f64| x.abs().log10().floor() as i32;
    let decimals = -exponent(step);
    let text = if value != 0.0 && (decimals > 6 || exponent(value) > 8) {
        let digits = (exponent(value) - exponent(step)).clamp(0, 12) as usize;
        format!("{value:.digits$e}")
    } else {
        format!("{value:.*}", decimals.max(0) as usize)
    };
    if unit == Unit::Degrees { text + "°" } else { text }
}
