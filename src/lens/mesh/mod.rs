//! Closed triangle meshes as lens volumes.

mod check;
mod form;
mod line;
mod nearest;
mod solid;
mod surface;
mod tree;

use std::collections::BTreeMap;
use std::path::PathBuf;

pub use form::MeshForm;
pub use solid::MeshSolid;
use surface::Surface;
pub(crate) use surface::count_triangles;
pub use tree::{MeshNode, TriangleTree};

use crate::spec::{Convex, MeshShape};

/// What the lens shapes of a spec make of the meshes that they name.
#[derive(Debug, Clone, Default)]
pub struct LensMeshes(BTreeMap<(PathBuf, Option<String>, Convex), MeshForm>);

impl LensMeshes {
    pub fn get(&self, shape: &MeshShape) -> Option<&MeshForm> {
        self.0.get(&key(shape))
    }

    pub fn insert(&mut self, shape: &MeshShape, form: MeshForm) {
        self.0.insert(key(shape), form);
    }
}

fn key(shape: &MeshShape) -> (PathBuf, Option<String>, Convex) {
    (shape.file.value.clone(), shape.node.as_ref().map(|node| node.value.clone()), shape.convex)
}
