//! The triangles of a glTF file, or of one node of it, as one surface.

use glam::{DAffine3, DVec3};

use crate::InputError;
use crate::pieces::Welder;
use crate::scene::{Aabb, Model};

/// Triangles over welded vertices, none of them without an area.
#[derive(Debug, Clone)]
pub struct Surface {
    /// As messages call it.
    pub name: String,
    /// In the cube from -1 to 1.
    pub vertices: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// The file's space from the cube.
    pub pose: DAffine3,
}

impl Surface {
    /// The meshes of a node with its descendants, or of all nodes that the file's scene shows, in the file's rest pose.
    pub fn new(model: &Model, node: Option<usize>) -> Result<Self, InputError> {
        let is_in = |index: usize| match node {
            Some(root) => std::iter::successors(Some(index), |i| model.nodes[*i].parent).any(|i| i == root),
            None => model.nodes[index].is_shown(),
        };
        let corners: Vec<[DVec3; 3]> =
            (0..model.nodes.len()).filter(|i| is_in(*i)).flat_map(|i| corners(model, i)).collect();
        let name = match node {
            Some(root) => format!("node `{}` of `{}`", model.nodes[root].name, model.name),
            None => format!("`{}`", model.name),
        };
        let bounds = Aabb::from_points(corners.iter().flatten().copied());
        let half = bounds.size().max_element() * 0.5;
        if !(half.is_finite() && half > 0.0) {
            return Err(InputError::new(format!("{name} has no triangles that bound a volume"))
                .help("a lens takes a closed mesh; `lenspeel info` lists what a model holds"));
        }
        let pose =
            DAffine3::from_scale_rotation_translation(DVec3::splat(half), glam::DQuat::IDENTITY, bounds.center());
        let largest = bounds.min.abs().max(bounds.max.abs()).max_element() / half;
        let mut welded = Welder::new(largest);
        let into_cube = |p: DVec3| (p - bounds.center()) / half;
        let triangles = corners.iter().map(|t| t.map(|p| welded.vertex(into_cube(p))));
        let triangles = triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        Ok(Self { name, vertices: welded.vertices, triangles, pose })
    }
}

/// The triangles of a node's own mesh in the file's space, turned as they are seen: mirrors turn them round.
fn corners(model: &Model, node: usize) -> Vec<[DVec3; 3]> {
    let node = &model.nodes[node];
    let is_mirrored = node.world_from_local.matrix3.determinant() < 0.0;
    let facing = move |[a, b, c]: [DVec3; 3]| if is_mirrored { [a, c, b] } else { [a, b, c] };
    let primitives = node.mesh.iter().flat_map(|mesh| &model.meshes[*mesh].primitives);
    primitives
        .flat_map(|primitive| {
            let at = |i: u32| node.world_from_local.transform_point3(primitive.positions[i as usize].as_dvec3());
            primitive.triangles.iter().map(move |triangle| facing(triangle.map(at)))
        })
        .collect()
}
