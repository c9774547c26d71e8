//! Where the nodes of a model stand: at rest, or at a time of its animations.

use glam::{DAffine3, DQuat, DVec3, DVec4};

use super::{Model, Node, Property, Scene};
use crate::InputError;

/// The place of a node in its parent.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Transform {
    /// glTF does not animate these.
    Matrix(DAffine3),
    /// Scaled first, then turned, then moved.
    Parts { translation: DVec3, rotation: DQuat, scale: DVec3 },
}

impl Transform {
    pub const IDENTITY: Transform = Transform::Matrix(DAffine3::IDENTITY);

    pub fn parent_from_local(&self) -> DAffine3 {
        match *self {
            Transform::Matrix(matrix) => matrix,
            Transform::Parts { translation, rotation, scale } => {
                DAffine3::from_scale_rotation_translation(scale, rotation, translation)
            }
        }
    }

    fn set(&mut self, property: Property, value: DVec4) {
        let Transform::Parts { translation, rotation, scale } = self else { return };
        match property {
            Property::Translation => *translation = value.truncate(),
            Property::Rotation => *rotation = DQuat::from_vec4(value.try_normalize().unwrap_or(DVec4::W)),
            Property::Scale => *scale = value.truncate(),
        }
    }
}

impl Scene {
    /// Poses the scene and its alternates at one time; see [`Model::pose`].
    pub fn pose(&mut self, time: Option<f64>) -> Result<(), InputError> {
        self.models.iter_mut().try_for_each(|model| model.pose(time))
    }
}

impl Model {
    /// Moves all nodes to where they are `time` seconds into the animations, or to the rest pose. All animations of
    /// the file act, in its order: of two that set one property of a node the later wins. An error says that numbers
    /// grow too large; the model is then posed in part.
    pub fn pose(&mut self, time: Option<f64>) -> Result<(), InputError> {
        let mut local: Vec<Transform> = self.nodes.iter().map(|node| node.rest).collect();
        if let Some(time) = time {
            for channel in self.animations.iter().flat_map(|animation| &animation.channels) {
                local[channel.node].set(channel.property, channel.at(time));
            }
        }
        for index in top_down(&self.nodes) {
            let own = local[index].parent_from_local();
            let parent = self.nodes[index].parent;
            let world = parent.map_or(own, |parent| self.nodes[parent].world_from_local * own);
            if !world.is_finite() {
                let label = super::object("node", index, Some(&self.nodes[index].name));
                let message =
                    format!("{}: {label}: its transform, with those of its ancestors, is not finite", self.name);
                return Err(InputError::new(message));
            }
            self.nodes[index].world_from_local = world;
        }
        Ok(())
    }
}

/// Every node that a root reaches, after its parent.
pub(super) fn top_down(nodes: &[Node]) -> Vec<usize> {
    let mut order: Vec<usize> = (0..nodes.len()).filter(|n| nodes[*n].parent.is_none()).collect();
    let mut next = 0;
    while let Some(node) = order.get(next) {
        order.extend(&nodes[*node].children);
        next += 1;
    }
    order
}
