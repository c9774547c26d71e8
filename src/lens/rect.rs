//! Rectangles of pixels.

use glam::DVec2;

/// Whole pixels `min.. max` of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelRect {
    pub min: [u32; 2],
    pub max: [u32; 2],
}

impl PixelRect {
    pub const EMPTY: PixelRect = PixelRect { min: [0, 0], max: [0, 0] };

    pub fn whole(size: [u32; 2]) -> Self {
        Self { min: [0, 0], max: size }
    }

    /// Around points of a picture of the given size, a pixel larger on each side; empty around none.
    pub fn around(points: impl IntoIterator<Item = DVec2>, size: [u32; 2]) -> Self {
        let ends = (DVec2::INFINITY, DVec2::NEG_INFINITY);
        let (min, max) = points.into_iter().fold(ends, |(min, max), p| (min.min(p), max.max(p)));
        if min.cmpgt(max).any() {
            return Self::EMPTY;
        }
        let size = DVec2::from_array(size.map(f64::from));
        let min = (min - 1.0).floor().clamp(DVec2::ZERO, size);
        let max = (max + 1.0).ceil().clamp(DVec2::ZERO, size);
        Self { min: [min.x as u32, min.y as u32], max: [max.x as u32, max.y as u32] }
    }

    pub fn is_empty(&self) -> bool {
        self.min[0] >= self.max[0] || self.min[1] >= self.max[1]
    }

    pub fn area(&self) -> u64 {
        if self.is_empty() { 0 } else { u64::from(self.max[0] - self.min[0]) * u64::from(self.max[1] - self.min[1]) }
    }

    pub fn overlaps(&self, other: &PixelRect) -> bool {
        !self.is_empty()
            && !other.is_empty()
            && (0..2).all(|i| self.min[i] < other.max[i] && other.min[i] < self.max[i])
    }

    /// The smallest that holds both.
    pub fn union(self, other: PixelRect) -> PixelRect {
        match (self.is_empty(), other.is_empty()) {
            (true, _) => other,
            (_, true) => self,
            _ => PixelRect {
                min: std::array::from_fn(|i| self.min[i].min(other.min[i])),
                max: std::array::from_fn(|i| self.max[i].max(other.max[i])),
            },
        }
    }

    pub fn intersection(self, other: PixelRect) -> PixelRect {
        if !self.overlaps(&other) {
            return PixelRect::EMPTY;
        }
        PixelRect {
            min: std::array::from_fn(|i| self.min[i].max(other.min[i])),
            max: std::array::from_fn(|i| self.max[i].min(other.max[i])),
        }
    }
}
