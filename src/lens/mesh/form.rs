//! From the mesh of a file to a solid.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::check::{is_closed, is_convex};
use super::{MeshSolid, Surface};
use crate::InputError;
use crate::lens::Form;
use crate::lens::hull::hull_form;
use crate::scene::{Aabb, Model};
use crate::spec::Convex;

/// A mesh of a file as a lens shape takes it.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshForm {
    pub form: Form,
    /// The file's space from the form's.
    pub pose: DAffine3,
    /// Of its bounds, in the form's space.
    pub corners: [DVec3; 8],
}

impl MeshForm {
    /// Makes a solid of a node's mesh with its descendants', or of all that the file shows. A mesh that is not what
    /// `convex` says is refused with the place, the numbers and what to do.
    pub fn new(model: &Model, node: Option<usize>, convex: Convex) -> Result<Self, InputError> {
        let surface = Surface::new(model, node)?;
        let (form, inner) = match convex {
            Convex::Decompose => {
                // Parts may touch, so an edge may have four triangles or six.
                is_closed(&surface, |triangles| triangles % 2 == 0)?;
                let solid = MeshSolid::new(surface.vertices.clone(), &surface.triangles);
                (Form::Mesh(Arc::new(solid)), DAffine3::IDENTITY)
            }
            Convex::Hull => hull_of(&surface)?,
            Convex::AsItStands => {
                is_closed(&surface, |triangles| triangles == 2)?;
                let (form, inner) = hull_of(&surface)?;
                let into_form = inner.inverse();
                let depth = |p| form.depth_inside(into_form.transform_point3(p), &into_form.matrix3);
                is_convex(&surface, depth)?;
                (form, inner)
            }
        };
        let bounds = Aabb::from_points(surface.vertices.iter().copied());
        let corners = bounds.corners().map(|p| inner.inverse().transform_point3(p));
        Ok(Self { form, pose: surface.pose * inner, corners })
    }
}

fn hull_of(surface: &Surface) -> Result<(Form, DAffine3), InputError> {
    hull_form(&surface.vertices).map_err(|_| {
        InputError::new(format!("{} lies in one plane or on one line, so it bounds no volume", surface.name))
            .help("a lens takes a closed mesh")
    })
}
