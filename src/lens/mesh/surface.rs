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
    /// Those that the file hides are left out.
    pub fn new(model: &Model, node: Option<usize>) -> Result<Self, InputError> {
        let corners: Vec<[DVec3; 3]> =
            nodes_of(model, node).into_iter().flat_map(|node| corners(model, node)).collect();
        let name = match node {
            Some(root) => format!("node `{}` of `{}`", model.nodes[root].name, model.name),
            None => format!("`{}`", model.name),
        };
        let bounds = Aabb::from_points(corners.iter().flatten().copied());
        let half = bounds.size().max_element() * 0.5;
        if !(half.is_finite() && half > 0.0) {
            let hidden = node.is_some_and(|root| model.nodes[root].hidden);
            let why = if hidden { ": the file hides it" } else { "" };
            return Err(InputError::new(format!("{name} has no triangles that bound a volume{why}"))
                .help("a lens takes a closed mesh; `lenspeel info` lists what a model holds"));
        }
        let mut welded = Welder::new(&bounds);
        let triangles = corners.iter().map(|t| t.map(|p| welded.vertex(p)));
        let triangles = triangles.filter(|[a, b, c]| a != b && b != c && c != a).collect();
        Ok(Self { name, pose: welded.pose(), vertices: welded.vertices, triangles })
    }
}

/// How many triangles a surface is made of.
pub fn count_triangles(model: &Model, node: Option<usize>) -> u64 {
    let meshes = nodes_of(model, node).into_iter().filter_map(|node| model.nodes[node].mesh);
    let primitives = meshes.flat_map(|mesh| &model.meshes[mesh].primitives);
    primitives.map(|primitive| primitive.triangles.len() as u64).sum()
}

/// The nodes that are shown of a node and its descendants, or of all of the file, in its order.
fn nodes_of(model: &Model, node: Option<usize>) -> Vec<usize> {
    let Some(root) = node else {
        return (0..model.nodes.len()).filter(|node| model.nodes[*node].is_shown()).collect();
    };
    let (mut nodes, mut open) = (Vec::new(), vec![root]);
    while let Some(node) = open.pop() {
        if !model.nodes[node].hidden {
            nodes.push(node);
            open.extend(&model.nodes[node].children);
        }
    }
    nodes.sort_unstable();
    nodes
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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::{Mesh, Node, Primitive, Transform};

    /// A chain of nodes, each with one triangle, of which some are hidden with all below.
    fn chain(count: usize, first_hidden: usize) -> Model {
        let node = |index: usize| Node {
            name: format!("n{index}"),
            parent: index.checked_sub(1),
            children: (index + 1 < count).then_some(index + 1).into_iter().collect(),
            rest: Transform::Matrix(DAffine3::IDENTITY),
            world_from_local: DAffine3::IDENTITY,
            mesh: Some(0),
            camera: None,
            light: None,
            drawn: true,
            hidden: index >= first_hidden,
        };
        let positions = vec![glam::Vec3::ZERO, glam::Vec3::X, glam::Vec3::Y];
        let primitive = Primitive { positions, triangles: vec![[0, 1, 2]], ..Primitive::default() };
        let mesh = Mesh { name: String::new(), primitives: vec![primitive] };
        Model { nodes: (0..count).map(node).collect(), meshes: vec![mesh], ..Model::default() }
    }

    #[test]
    fn hidden_descendants_are_left_out() {
        let model = chain(5, 3);
        assert_eq!(count_triangles(&model, Some(1)), 2);
        assert_eq!(count_triangles(&model, None), 3);
        let error = Surface::new(&model, Some(3)).expect_err("it is hidden").message;
        assert!(error.ends_with("no triangles that bound a volume: the file hides it"), "{error}");
    }

    #[test]
    fn a_deep_chain_is_walked_once() {
        assert_eq!(count_triangles(&chain(100_000, usize::MAX), Some(0)), 100_000);
    }
}
