//! What is seen: the models of a spec, checked and made plain, with their materials and textures ready to use.
//!
//! Bytes in, validated scene out: every index is in range, every number finite, every tree a tree.

mod across;
mod animation;
mod bounds;
mod budget;
mod closed;
mod coincident;
mod files;
mod lens_meshes;
mod load;
mod materials;
mod model;
mod names;
mod open;
mod pose;
mod simplified;
mod textures;
mod vertex_values;

pub use across::{Across, EdgeKind, Edges};
pub use animation::{Animation, Channel, Interpolation, Property};
pub use bounds::BoundsCache;
pub(crate) use bounds::FARTHEST;
pub(crate) use budget::TO_TAKE_LESS;
pub use budget::{Budget, OpenOptions};
pub use closed::{Closure, ClosureCache, Enclosing};
pub use coincident::{Coincident, CoincidentCache, Part, Plane, Shared};
pub(crate) use files::files;
use load::object;
pub use materials::{MaterialRecord, NO_TEXTURE, TextureSlot};
pub use model::*;
pub(crate) use names::{Selections, Subject};
pub use open::{Scene, SceneId};
pub use pose::Transform;
pub use simplified::Simplified;
pub use textures::{MipImage, MipLevel, TextureRecord, TextureSet, decode_table};
pub use vertex_values::CURVATURE;
pub(crate) use vertex_values::scene_factor;
