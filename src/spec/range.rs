//! Which numbers a key accepts, and how a message says so.

use std::fmt;

/// A number farther from zero than this is refused: its square must still fit in 32-bit floats.
pub const LARGEST: f64 = 1e18;
/// A size below this is refused: its square must not vanish in 32-bit floats.
pub const SMALLEST_SIZE: f64 = 1e-18;

/// An interval of numbers; a missing end is open: any number that is not too large to compute with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NumberRange {
    pub min: Option<f64>,
    pub max: Option<f64>,
    /// The ends themselves do not belong to it.
    pub open: bool,
}

impl NumberRange {
    pub const ANY: Self = Self { min: None, max: None, open: false };
    pub const POSITIVE: Self = Self { min: Some(0.0), max: None, open: true };
    pub const NOT_NEGATIVE: Self = Self { min: Some(0.0), max: None, open: false };
    pub const UNIT: Self = Self::closed(0.0, 1.0);

    pub const fn closed(min: f64, max: f64) -> Self {
        Self { min: Some(min), max: Some(max), open: false }
    }

    pub const fn open(min: f64, max: f64) -> Self {
        Self { min: Some(min), max: Some(max), open: true }
    }

    /// False for NaN.
    pub fn contains(&self, x: f64) -> bool {
        let above = self.min.is_none_or(|min| if self.open { x > min } else { x >= min });
        let below = self.max.is_none_or(|max| if self.open { x < max } else { x <= max });
        x.is_finite() && above && below
    }
}

/// Reads after "must be ": "above 0", "from 0 to 1", "any number".
impl fmt::Display for NumberRange {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match (self.min, self.max, self.open) {
            (None, None, _) => write!(f, "any number"),
            (Some(min), None, true) => write!(f, "above {min}"),
            (Some(min), None, false) => write!(f, "{min} or more"),
            (None, Some(max), true) => write!(f, "below {max}"),
            (None, Some(max), false) => write!(f, "{max} or less"),
            (Some(min), Some(max), true) => write!(f, "above {min} and below {max}"),
            (Some(min), Some(max), false) => write!(f, "from {min} to {max}"),
        }
    }
}
