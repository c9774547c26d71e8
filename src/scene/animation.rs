//! Keyframes that move nodes, and their values between the keys.

use glam::{DQuat, DVec4};

/// One animation of a file: what it does to nodes.
#[derive(Debug, Clone, Default)]
pub struct Animation {
    /// Empty where the file gives none.
    pub name: String,
    pub channels: Vec<Channel>,
}

/// The course of one property of one node.
#[derive(Debug, Clone)]
pub struct Channel {
    /// Into [`super::Model::nodes`]; that node has no matrix.
    pub node: usize,
    pub property: Property,
    pub interpolation: Interpolation,
    /// Seconds, at least one, never falling.
    pub times: Vec<f64>,
    /// One a time, or three for a spline: in-tangent, value, out-tangent. `xyz`, or a quaternion that is not zero.
    pub values: Vec<DVec4>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Property {
    Translation,
    Rotation,
    Scale,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Interpolation {
    Step,
    /// Spherical for rotations, the shorter way round.
    Linear,
    CubicSpline,
}

impl Interpolation {
    /// How many values a key has.
    pub fn values_per_key(self) -> usize {
        if self == Interpolation::CubicSpline { 3 } else { 1 }
    }
}

impl Animation {
    /// The time of the last key in seconds; zero without channels.
    pub fn end(&self) -> f64 {
        self.channels.iter().filter_map(|c| c.times.last().copied()).fold(0.0, f64::max)
    }
}

impl Channel {
    /// The value at a time in seconds (glTF 2.0, appendix C). Before its first key and after its last it holds still.
    /// A quaternion comes out of any length.
    pub fn at(&self, time: f64) -> DVec4 {
        let next = self.times.partition_point(|key| *key <= time);
        if next == 0 || next == self.times.len() {
            return self.value(next.saturating_sub(1));
        }
        let key = next - 1;
        let (from, to) = (self.value(key), self.value(next));
        let step = self.times[next] - self.times[key];
        let t = (time - self.times[key]) / step;
        match (self.interpolation, self.property) {
            (Interpolation::Step, _) => from,
            (Interpolation::Linear, Property::Rotation) => {
                let [from, to] = [from, to].map(|q| DQuat::from_vec4(q).normalize());
                from.slerp(to, t).into()
            }
            (Interpolation::Linear, _) => from.lerp(to, t),
            (Interpolation::CubicSpline, _) => {
                let (leaving, arriving) = (self.values[3 * key + 2] * step, self.values[3 * next] * step);
                hermite(from, leaving, to, arriving, t)
            }
        }
    }

    fn value(&self, key: usize) -> DVec4 {
        let per_key = self.interpolation.values_per_key();
        self.values[per_key * key + per_key / 2]
    }
}

/// The cubic from `from` to `to` with these tangents over `t` in 0..1.
fn hermite(from: DVec4, leaving: DVec4, to: DVec4, arriving: DVec4, t: f64) -> DVec4 {
    let (t2, t3) = (t * t, t * t * t);
    from * (2.0 * t3 - 3.0 * t2 + 1.0)
        + leaving * (t3 - 2.0 * t2 + t)
        + to * (3.0 * t2 - 2.0 * t3)
        + arriving * (t3 - t2)
}
