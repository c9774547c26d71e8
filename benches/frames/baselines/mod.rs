//! Programs that draw the benchmarks' pictures in other ways, each as its authors or an expert would write it today:
//! the surface of the benchmarks with the same camera, light and material, and lenses that invert.

mod analytic;
mod clip_planes;
mod frame;
mod host;
mod lenses;
mod mask;
mod minimal;
mod three_pass;

pub use analytic::analytic;
pub use clip_planes::clip_planes;
pub use frame::Baseline;
pub use host::{Host, Surface};
pub use mask::mask;
pub use minimal::minimal;
pub use three_pass::three_pass;

use lenspeel::frame::Frame;

/// Pixels of our picture that a baseline's may differ from by more than [`STEPS`], of a million: a ray and a raster
/// may put a pixel on the edge of a lens or of a triangle on either side of it.
pub const MOST_DIFFERENT: f64 = 200.0;
/// Steps of 255 that rounding may make.
const STEPS: u8 = 2;

/// How many pixels of two pictures differ.
pub fn different(a: &Frame, b: &[[u8; 4]]) -> usize {
    assert_eq!(a.pixels.len(), b.len(), "pictures of one size");
    a.pixels.iter().zip(b).filter(|(a, b)| a.iter().zip(*b).any(|(a, b)| a.abs_diff(*b) > STEPS)).count()
}
