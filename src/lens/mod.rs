//! Lens volumes: sets in world space put together from parts, and where rays cross them.

mod boxes;
mod build;
mod form;
mod halfspaces;
mod holding;
mod hull;
mod inside;
mod layers;
mod mesh;
mod rect;
mod set;
mod solid;
mod tree;
mod volume;

pub use build::{Placement, build_volume};
pub use form::{Crossing, Form, Span};
pub use halfspaces::{Plane, Polyhedron};
pub use layers::{LayerStart, RayLayers};
pub(crate) use mesh::count_triangles;
pub use mesh::{LensMeshes, MeshForm, MeshNode, MeshSolid, TriangleTree};
pub use rect::PixelRect;
pub use set::{LensSet, MAX_LENSES, MAX_RULES};
pub use solid::Solid;
pub use tree::{MAX_PARTS, Tree};
pub use volume::{Boundary, Interval, Volume};
