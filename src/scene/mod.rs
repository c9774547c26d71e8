//! A model as both backends see it: glTF data, checked and made plain.
//!
//! Bytes in, validated scene out: every index is in range, every number finite, every tree a tree.

mod load;
mod model;

pub use model::*;
