//! Where a reference picture has an edge: masks over its pixels, row 0 at the top.

use std::ops::Range;

use lenspeel::frame::Aovs;
use lenspeel::plan::Region;

/// The region of every pixel.
pub fn regions(aovs: &Aovs) -> Vec<Option<Region>> {
    (0..aovs.regions.len()).map(|at| aovs.region(at)).collect()
}

/// One flag a pixel.
pub type Mask = Vec<bool>;

/// A depth that bends by more than this share of itself over one pixel is a jump, an edge of the picture.
pub const JUMP: f64 = 0.02;
/// Smaller steps are edges of the depth map itself: ten times what depths may differ by.
pub const STEP: f64 = 1e-3;
/// Stands for "nothing there" among depths.
const NOWHERE: f64 = 1e9;

/// The union of two masks.
pub fn either(a: &Mask, b: &Mask) -> Mask {
    a.iter().zip(b).map(|(a, b)| *a || *b).collect()
}

/// Pixels of which one of the eight neighbours has another value.
pub fn changes<T: PartialEq>(size: [u32; 2], values: &[T]) -> Mask {
    around(size, |at, other| values[at] != values[other])
}

/// Pixels within one pixel of a place where depth bends by more than a share of itself. On a plane depth (orthographic) or its inverse (perspective) is linear
/// over the image, so one of the two second differences vanishes.
pub fn depth_jumps(size: [u32; 2], depth: &[f64], least: f64) -> Mask {
    let [width, height] = size.map(|side| side as usize);
    let depth: Vec<f64> = depth.iter().map(|d| if d.is_finite() { *d } else { NOWHERE }).collect();
    let bends = |before: f64, here: f64, after: f64| {
        let share = |a: f64, b: f64, c: f64| (a - 2.0 * b + c).abs() / b.abs();
        share(before, here, after).min(share(1.0 / before, 1.0 / here, 1.0 / after)) > least
    };
    let jumps: Mask = (0..width * height)
        .map(|at| {
            let (x, y) = (at % width, at / width);
            let along_x = x > 0 && x + 1 < width && bends(depth[at - 1], depth[at], depth[at + 1]);
            let along_y = y > 0 && y + 1 < height && bends(depth[at - width], depth[at], depth[at + width]);
            along_x || along_y
        })
        .collect();
    around(size, |at, other| jumps[at] || jumps[other])
}

/// Whether a relation holds between a pixel and one of its neighbours.
pub fn around(size: [u32; 2], holds: impl Fn(usize, usize) -> bool) -> Mask {
    let [width, height] = size.map(|side| side as usize);
    let near = |at: usize, length: usize| -> Range<usize> { at.saturating_sub(1)..(at + 2).min(length) };
    (0..width * height)
        .map(|at| {
            let (x, y) = (at % width, at / width);
            near(y, height).any(|v| near(x, width).any(|u| holds(at, v * width + u)))
        })
        .collect()
}
