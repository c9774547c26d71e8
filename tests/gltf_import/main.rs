//! glTF import: small files written here, real and invalid models beside the project, and damaged bytes.

mod builder;
mod damage;
mod errors;
#[path = "../support/gltf.rs"]
mod gltf;
mod limits;
mod motion;
mod shared;
mod small;
mod texts;
mod tolerant;
