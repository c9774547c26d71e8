//! The reference backend: a ray a sample, all hits along it in order, closed-form lens intervals.

mod block;
mod convert;
mod custom;
mod geometry;
mod glass;
mod intersect;
mod memory;
mod pixel;
mod render;
mod screen;
mod shade;
mod texture;

pub use memory::check_memory;
pub use render::{Error, Renderer};
