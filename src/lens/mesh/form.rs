//! From the mesh of a file to a solid.

use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::check::{is_closed, is_convex, is_convex_by_planes};
use super::{MeshSolid, Surface};
use crate::InputError;
use crate::lens::Form;
use crate::lens::hull::hull_form;
use crate::pieces::Pieces;
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
        let pieces = match convex {
            Convex::Hull => Pieces::default(),
            _ => Pieces::new(&surface.vertices, &surface.triangles),
        };
        is_closed(&surface, &pieces)?;
        let (form, inner) = match convex {
            Convex::Decompose => {
                let solid = MeshSolid::with_roles(surface.vertices.clone(), &surface.triangles, &pieces.roles);
                (Form::Mesh(Arc::new(solid)), DAffine3::IDENTITY)
            }
            Convex::Hull => hull_of(&surface)?,
            Convex::AsItStands => convex_of(&surface, &pieces)?,
        };
        let bounds = Aabb::from_points(surface.vertices.iter().copied());
        let corners = bounds.corners().map(|p| inner.inverse().transform_point3(p));
        Ok(Self { form, pose: surface.pose * inner, corners })
    }
}

/// From so many triangles on a surface is first asked whether it is convex by its own planes, which takes a time in
/// proportion to them, where the convex hull and distances to it take much longer.
const MANY: usize = 4096;

fn convex_of(surface: &Surface, pieces: &Pieces) -> Result<(Form, DAffine3), InputError> {
    if surface.triangles.len() >= MANY && pieces.closed == 1 {
        let solid = MeshSolid::with_roles(surface.vertices.clone(), &surface.triangles, &pieces.roles);
        if is_convex_by_planes(&solid) {
            return Ok((Form::Mesh(Arc::new(MeshSolid { is_convex: true, ..solid })), DAffine3::IDENTITY));
        }
    }
    let (form, inner) = hull_of(surface)?;
    let into_form = inner.inverse();
    let depth = |p| form.depth_inside(into_form.transform_point3(p), &into_form.matrix3);
    is_convex(surface, depth)?;
    Ok((form, inner))
}

fn hull_of(surface: &Surface) -> Result<(Form, DAffine3), InputError> {
    hull_form(&surface.vertices).map_err(|_| {
        InputError::new(format!("{} lies in one plane or on one line, so it bounds no volume", surface.name))
            .help("a lens takes a closed mesh")
    })
}
