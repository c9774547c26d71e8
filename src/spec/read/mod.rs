//! Text to [`Spec`](super::Spec): TOML with places, then one small reader for each part of the format.

mod camera;
mod cap;
pub(crate) mod color;
mod condition;
mod document;
mod filter;
mod image;
mod item;
pub(crate) mod keys;
mod later;
mod lens;
mod light;
mod links;
mod number;
mod overlap;
mod scene;
mod set;
mod shape;
pub(crate) mod suggest;
mod table;
