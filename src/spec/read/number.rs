//! Numbers, vectors and rotations, all finite and in range.

use toml::de::DeValue;

use super::item::Item;
use crate::InputError;
use crate::spec::Rotation;
use crate::spec::range::{LARGEST, NumberRange, SMALLEST_SIZE};

impl Item<'_> {
    pub fn number(&self, range: NumberRange) -> Result<f64, InputError> {
        let value = self.any_number()?;
        if !value.is_finite() {
            return Err(self.error(format!("{} must be a finite number, not {value}", self.called())));
        }
        if !range.contains(value) {
            return Err(self.error(format!("{} must be {range}, not {value}", self.called())));
        }
        if value.abs() > LARGEST {
            return Err(self
                .error(format!("{} is too large: {value:e}", self.called()))
                .help(format!("numbers reach up to {LARGEST:e}; use larger units")));
        }
        if range.open && range.min == Some(0.0) && value < SMALLEST_SIZE {
            return Err(self
                .error(format!("{} is too small: {value:e}", self.called()))
                .help(format!("the smallest size is {SMALLEST_SIZE:e}; use smaller units")));
        }
        Ok(value)
    }

    pub fn number32(&self, range: NumberRange) -> Result<f32, InputError> {
        self.number(range).map(|value| value as f32)
    }

    fn any_number(&self) -> Result<f64, InputError> {
        match self.value {
            DeValue::Float(float) => float.as_str().parse().map_err(|_| self.wrong_type("a number")),
            DeValue::Integer(_) => self.whole_number().map(|value| value as f64),
            _ => Err(self.wrong_type("a number")),
        }
    }

    fn whole_number(&self) -> Result<i64, InputError> {
        let DeValue::Integer(integer) = self.value else {
            return Err(self.wrong_type("a whole number"));
        };
        i64::from_str_radix(integer.as_str(), integer.radix())
            .map_err(|_| self.error(format!("{} is too large: {integer}", self.called())))
    }

    /// A whole number within both ends.
    pub fn integer(&self, min: i64, max: i64) -> Result<i64, InputError> {
        let value = self.whole_number()?;
        if (min..=max).contains(&value) {
            return Ok(value);
        }
        Err(self.error(format!("{} must be a whole number from {min} to {max}, not {value}", self.called())))
    }

    /// A list of exactly `N` numbers.
    pub fn numbers<const N: usize>(&self, range: NumberRange) -> Result<[f64; N], InputError> {
        let wanted = format!("a list of {N} numbers");
        let items = self.list(&wanted)?;
        if items.len() != N {
            return Err(self.error(format!("{} must be {wanted}, but has {}", self.called(), items.len())));
        }
        let mut values = [0.0; N];
        for (value, item) in values.iter_mut().zip(&items) {
            *value = item.number(range)?;
        }
        Ok(values)
    }

    pub fn vector(&self) -> Result<[f64; 3], InputError> {
        self.numbers(NumberRange::ANY)
    }

    /// A vector that points somewhere.
    pub fn direction(&self) -> Result<[f64; 3], InputError> {
        let vector = self.vector()?;
        if length(vector) < SMALLEST_SIZE {
            return Err(self.error(format!("{} must not have length zero", self.called())).help("it is a direction"));
        }
        Ok(vector)
    }

    /// A list of points, at least `least` of them.
    pub fn points(&self, least: usize) -> Result<Vec<[f64; 3]>, InputError> {
        let points = self.list("a list of points [x, y, z]")?;
        if points.len() < least {
            return Err(self.error(format!(
                "{} needs at least {least} points, but has {}",
                self.called(),
                points.len()
            )));
        }
        points.iter().map(Item::vector).collect()
    }

    /// Three degrees or a quaternion.
    pub fn rotation(&self) -> Result<Rotation, InputError> {
        const WANTED: &str = "three degrees [x, y, z] or a quaternion [x, y, z, w]";
        match self.list(WANTED)?.len() {
            3 => Ok(Rotation::Euler(self.vector()?)),
            4 => self.quaternion(),
            n => Err(self.error(format!("{} must be {WANTED}, but has {n} numbers", self.called()))),
        }
    }

    fn quaternion(&self) -> Result<Rotation, InputError> {
        let [x, y, z, w] = self.numbers(NumberRange::ANY)?;
        if x.hypot(y).hypot(z.hypot(w)) < SMALLEST_SIZE {
            return Err(self
                .error(format!("{} is a quaternion of length zero", self.called()))
                .help("no rotation is [0, 0, 0, 1]"));
        }
        Ok(Rotation::Quaternion([x, y, z, w]))
    }
}

pub fn length([x, y, z]: [f64; 3]) -> f64 {
    x.hypot(y).hypot(z)
}

pub fn difference(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

pub fn cross(a: [f64; 3], b: [f64; 3]) -> [f64; 3] {
    [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
}
