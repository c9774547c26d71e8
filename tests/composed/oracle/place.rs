//! Where nodes and lenses stand in the world.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::view::View;
use crate::case::{Attach, Case, Lens, Model, Rotation};

/// World from a node's space: its own transform under those of its ancestors.
pub fn of_node(model: &Model, node: usize) -> DAffine3 {
    let own = &model.nodes[node];
    let local = DAffine3::from_scale_rotation_translation(own.scale, own.rotation.normalize(), own.translation);
    own.parent.map_or(local, |parent| of_node(model, parent) * local)
}

/// The centre of the tight world bounds of a node's own mesh.
pub fn center_of_node(model: &Model, node: usize) -> DVec3 {
    let world = of_node(model, node);
    let corners = model.nodes[node].primitives.iter().flat_map(|p| p.triangles.iter().flatten());
    middle(corners.map(|p| world.transform_point3(*p)))
}

/// The middle of the bounds of some points.
pub fn middle(points: impl Iterator<Item = DVec3>) -> DVec3 {
    let (low, high) = points.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| (low.min(p), high.max(p)));
    0.5 * (low + high)
}

/// World from the space of a lens's shape: `T·R·S` in the space it is attached to.
pub fn of_lens(case: &Case, lens: &Lens, view: &View) -> DAffine3 {
    let scene = &case.models[0];
    let attach = match &lens.attach {
        Attach::Scene => DAffine3::IDENTITY,
        Attach::Camera => view.world_from_camera(),
        Attach::Node(name) => {
            of_node(scene, scene.nodes.iter().position(|n| n.name == *name).expect("the case names a node it has"))
        }
    };
    let matrix = turn(lens.rotation) * DMat3::from_diagonal(lens.scale);
    attach * DAffine3::from_mat3_translation(matrix, lens.translation)
}

/// Intrinsic XYZ turns about x, then about the turned y, then about the twice turned z.
pub fn turn(rotation: Rotation) -> DMat3 {
    match rotation {
        Rotation::Euler(degrees) => {
            let [x, y, z] = degrees.map(f64::to_radians);
            DMat3::from_rotation_x(x) * DMat3::from_rotation_y(y) * DMat3::from_rotation_z(z)
        }
        Rotation::Quaternion(q) => DMat3::from_quat(DQuat::from_array(q).normalize()),
    }
}
