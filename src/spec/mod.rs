//! The lens-spec file: its typed mirror, exactly as written, before any model is opened.

pub mod catalogue;
mod color;
mod pattern;
mod range;
pub(crate) mod read;
mod shape;
mod types;

pub use color::Color;
pub use pattern::{Names, NamesSize, Pattern, PatternSet};
pub use range::NumberRange;
pub(crate) use read::{keys, suggest};
pub use shape::{Convex, MeshShape, Rotation, Shape};
pub use types::*;
