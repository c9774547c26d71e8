//! Composed 3D magic lenses: ordered depth-interval layers, a priority graph, and an explanation for every pixel.
#![forbid(unsafe_code)]

pub mod appearance;
pub mod bench;
pub mod cli;
pub mod color_map;
pub mod cpu;
pub mod custom;
pub mod debug_view;
mod drawing;
mod error;
pub mod explain;
mod file_kind;
pub mod frame;
#[cfg(feature = "gpu")]
pub mod gpu;
pub mod legend;
pub mod lens;
pub mod limits;
pub mod output;
pub mod pick;
pub mod pieces;
pub mod pixel;
pub mod plan;
mod printable;
pub mod scene;
pub mod spec;
pub mod view;
mod words;

pub use error::InputError;

/// The README's example compiles.
#[cfg(doctest)]
#[doc = include_str!("../README.md")]
struct Readme;
