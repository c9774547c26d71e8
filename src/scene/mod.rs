//! What is seen: the models of a spec, checked and made plain, with their materials and textures ready to use.
//!
//! Bytes in, validated scene out: every index is in range, every number finite, every tree a tree.

mod lens_meshes;
mod load;
mod materials;
mod model;
mod names;
mod open;
mod textures;

pub use materials::{MaterialRecord, NO_TEXTURE, TextureSlot};
pub use model::*;
pub use open::Scene;
pub use textures::{MipImage, MipLevel, TextureRecord, TextureSet, decode_table};
