//! Parts of lenses with many planes: their faces are drawn, one map of entry and exit faces for each, as large as the
//! pixels that the part covers.

use glam::DVec3;

use super::Window;
use crate::lens::{Form, PixelRect, Polyhedron, Solid};
use crate::plan::Plan;

/// From so many planes on, faces are drawn; below, each ray asks every plane.
pub const FROM_PLANES: usize = 13;

/// A corner of a face; the vertex that `shaders/gpu/depth_map.wgsl` takes.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct FaceVertex {
    /// Relative to the eye, along the world's axes.
    pub corner: [f32; 3],
    /// Number of the part.
    pub part: u32,
    /// Which of its planes.
    pub face: u32,
}

/// One part's map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DepthMap {
    pub part: usize,
    /// First word, behind the layers.
    pub first: u64,
    /// Pixels of the window.
    pub rect: PixelRect,
}

/// The maps of a window.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct DepthMaps {
    pub maps: Vec<DepthMap>,
    /// Triangles.
    pub vertices: Vec<FaceVertex>,
    /// Where the maps start and end among the words of the layers.
    pub first_word: u64,
    pub end_word: u64,
}

impl DepthMaps {
    /// `layer_words`: how many words stand before the maps.
    pub fn new(plan: &Plan, window: &Window, layer_words: u64) -> Self {
        let mut maps = Self { first_word: layer_words, end_word: layer_words, ..Self::default() };
        let solids = plan.lenses.iter().flat_map(|lens| &lens.volume.parts);
        for (part, solid) in solids.enumerate() {
            let rect = window.local(&solid.pixel_rect(&plan.view));
            let Some(faces) = faces(solid).filter(|_| !rect.is_empty()) else { continue };
            maps.maps.push(DepthMap { part, first: maps.end_word, rect });
            maps.end_word += 2 * rect.area();
            maps.add_faces(part, solid, &faces, plan.view.eye);
        }
        maps
    }

    fn add_faces(&mut self, part: usize, solid: &Solid, faces: &Polyhedron, eye: DVec3) {
        let vertex = |corner: DVec3, face: usize| FaceVertex {
            corner: (solid.world_from_local.transform_point3(corner) - eye).as_vec3().to_array(),
            part: part as u32,
            face: face as u32,
        };
        for (face, corners) in &faces.faces {
            // Fans: faces are convex.
            for pair in corners[1..].windows(2) {
                self.vertices.extend([corners[0], pair[0], pair[1]].map(|corner| vertex(corner, *face)));
            }
        }
    }

    pub fn of_part(&self, part: usize) -> Option<&DepthMap> {
        self.maps.iter().find(|map| map.part == part)
    }
}

/// The faces of a part that is drawn rather than asked plane by plane. Flat parts are open to the far side.
fn faces(solid: &Solid) -> Option<Polyhedron> {
    match &solid.form {
        Form::HalfSpaces { planes, .. } if planes.len() >= FROM_PLANES && !solid.is_flat => {
            Polyhedron::from_planes(planes).ok()
        }
        _ => None,
    }
}
