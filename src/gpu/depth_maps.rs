//! Lenses with many planes: their faces are drawn, one map of entry and exit faces for each, as large as the pixels
//! that the lens covers.

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
    pub rank: u32,
    /// Which plane of the volume.
    pub face: u32,
}

/// One lens's map.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct DepthMap {
    pub rank: usize,
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
        for (rank, lens) in plan.lenses.iter().enumerate() {
            let rect = window.local(&lens.rect);
            let Some(solid) = faces(&lens.volume.parts[0]).filter(|_| !rect.is_empty()) else { continue };
            maps.maps.push(DepthMap { rank, first: maps.end_word, rect });
            maps.end_word += 2 * rect.area();
            maps.add_faces(rank, &lens.volume.parts[0], &solid, plan.view.eye);
        }
        maps
    }

    fn add_faces(&mut self, rank: usize, volume: &Solid, solid: &Polyhedron, eye: DVec3) {
        let vertex = |corner: DVec3, face: usize| FaceVertex {
            corner: (volume.world_from_local.transform_point3(corner) - eye).as_vec3().to_array(),
            rank: rank as u32,
            face: face as u32,
        };
        for (face, corners) in &solid.faces {
            // Fans: faces are convex.
            for pair in corners[1..].windows(2) {
                self.vertices.extend([corners[0], pair[0], pair[1]].map(|corner| vertex(corner, *face)));
            }
        }
    }

    pub fn of_lens(&self, rank: usize) -> Option<&DepthMap> {
        self.maps.iter().find(|map| map.rank == rank)
    }
}

/// The faces of a volume that is drawn rather than asked plane by plane. Flat lenses are open to the far side.
fn faces(volume: &Solid) -> Option<Polyhedron> {
    match &volume.form {
        Form::HalfSpaces { planes, .. } if planes.len() >= FROM_PLANES && !volume.is_flat => {
            Polyhedron::from_planes(planes).ok()
        }
        _ => None,
    }
}
