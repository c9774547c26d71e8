//! Lens volumes: convex sets in world space, and where rays cross them.

mod build;
mod form;
mod halfspaces;
mod hull;
mod layers;
mod set;
mod volume;

pub use build::{Placement, build_volume};
pub use form::{Crossing, Form, Span};
pub use halfspaces::{Plane, Polyhedron};
pub use layers::{LayerStart, RayLayers};
pub use set::{LensSet, MAX_LENSES, MAX_RULES};
pub use volume::{Interval, PixelRect, Volume};
