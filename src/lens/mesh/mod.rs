//! Closed triangle meshes as lens volumes.

mod line;
mod nearest;
mod solid;

pub use solid::{MeshNode, MeshSolid};
