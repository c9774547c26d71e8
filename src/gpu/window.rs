//! The part of a picture that one frame draws.

use crate::lens::PixelRect;
use crate::view::View;

/// Pixels of the whole picture: large pictures are drawn in several windows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Window {
    pub min: [u32; 2],
    pub size: [u32; 2],
}

impl Window {
    /// The whole picture of a view.
    pub fn whole(view: &View) -> Self {
        Self { min: [0, 0], size: view.size }
    }

    pub fn pixels(&self) -> u64 {
        u64::from(self.size[0]) * u64::from(self.size[1])
    }

    /// Where a pixel of the whole picture stands among the window's, row by row.
    pub fn place(&self, pixel: [u32; 2]) -> usize {
        let [x, y] = [0, 1].map(|axis| (pixel[axis] - self.min[axis]) as usize);
        y * self.size[0] as usize + x
    }

    /// Whether a pixel of the whole picture is in it.
    pub fn holds(&self, pixel: [u32; 2]) -> bool {
        (0..2).all(|axis| pixel[axis] >= self.min[axis] && pixel[axis] - self.min[axis] < self.size[axis])
    }

    /// With so many pixels more on each side, as far as they lie in another window that holds it.
    pub fn grown(&self, pixels: u32, within: &Window) -> Self {
        let min = [0, 1].map(|axis| self.min[axis].saturating_sub(pixels).max(within.min[axis]));
        let end = |axis: usize| {
            let most = within.min[axis] + within.size[axis];
            (self.min[axis] + self.size[axis]).saturating_add(pixels).min(most)
        };
        Self { min, size: [0, 1].map(|axis| end(axis) - min[axis]) }
    }

    /// Two halves across the longer side, or `None` for a single pixel.
    pub fn halves(&self) -> Option<[Window; 2]> {
        let axis = usize::from(self.size[1] > self.size[0]);
        if self.size[axis] < 2 {
            return None;
        }
        let (mut first, mut second) = (*self, *self);
        first.size[axis] = self.size[axis] / 2;
        second.min[axis] += first.size[axis];
        second.size[axis] -= first.size[axis];
        Some([first, second])
    }

    /// A rectangle of the whole picture, in pixels of the window.
    pub fn local(&self, rect: &PixelRect) -> PixelRect {
        let clamp = |value: u32, axis: usize| value.saturating_sub(self.min[axis]).min(self.size[axis]);
        PixelRect {
            min: [clamp(rect.min[0], 0), clamp(rect.min[1], 1)],
            max: [clamp(rect.max[0], 0), clamp(rect.max[1], 1)],
        }
    }
}
