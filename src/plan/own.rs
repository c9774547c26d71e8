//! The surface of a solid, on which a cap that shows the solid's own colour finds its nearest point (SEMANTICS 6.6).

use glam::{DAffine3, DQuat, DVec3, Vec3};

use super::{Body, Item, Plan};
use crate::lens::TriangleTree;
use crate::scene::{NO_TEXTURE, Scene};
use crate::spec::Cap;

/// The triangles of a body's closed pieces, where its node stands.
#[derive(Debug, Clone)]
pub struct OwnSurface {
    /// In the cube from -1 to 1.
    pub tree: TriangleTree,
    /// Of each triangle of the tree, the member and the triangle among its item's.
    pub faces: Vec<OwnFace>,
    pub cube_from_world: DAffine3,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OwnFace {
    /// Into [`Body::members`].
    pub member: u32,
    pub triangle: u32,
}

impl OwnSurface {
    /// `None` where no cap shows it, or all of it looks the same.
    pub fn new(scene: &Scene, plan: &Plan, body: &Body) -> Option<Self> {
        let item = |member: usize| &plan.items[plan.instances[body.members[member].instance].item];
        let members = 0..body.members.len();
        let is_shown = members.clone().any(|member| item(member).caps.iter().any(|cap| cap.look == Cap::Own));
        let has_parts = |item: &Item| {
            let texture = scene.materials[item.material].base_color_texture.texture;
            item.primitive_of(scene).colors.is_some() || texture != NO_TEXTURE
        };
        let differs = |member: usize| has_parts(item(member)) || item(member).material != item(0).material;
        if !is_shown || !members.clone().any(differs) {
            return None;
        }
        let first = item(0);
        let model = &scene.models[first.model];
        let bounds = model.node_bounds(first.node);
        let half = DVec3::splat((bounds.size().max_element() * 0.5).max(f64::MIN_POSITIVE));
        let world_from_cube = DAffine3::from_scale_rotation_translation(half, DQuat::IDENTITY, bounds.center());
        let cube_from_world = world_from_cube.inverse();
        let cube_from_local = cube_from_world * model.nodes[first.node].world_from_local;
        let (mut vertices, mut triangles, mut faces) = (Vec::new(), Vec::new(), Vec::new());
        for member in members {
            let own = item(member);
            let closure = model.closure(own.mesh, own.ratio);
            let enclosing = &closure.primitives[own.primitive];
            let start = vertices.len() as u32;
            let positions = own.primitive_of(scene).positions.iter();
            vertices.extend(positions.map(|p| cube_from_local.transform_point3(p.as_dvec3())));
            for (number, corners) in own.triangle_list(scene).iter().enumerate() {
                if enclosing.role(number).is_closed() {
                    triangles.push(corners.map(|corner| start + corner));
                    faces.push(OwnFace { member: member as u32, triangle: number as u32 });
                }
            }
        }
        let tree = TriangleTree::new(vertices, &triangles);
        let faces = tree.numbers.iter().map(|number| faces[*number as usize]).collect();
        Some(Self { tree, faces, cube_from_world })
    }

    /// The nearest triangle to a point of the world, and the weights of its corners at the nearest point.
    pub fn nearest(&self, place: DVec3) -> Option<(OwnFace, Vec3)> {
        let (q, face) = self.tree.nearest(self.cube_from_world.transform_point3(place))?;
        let [a, b, c] = self.tree.corners(face);
        let across = (b - a).cross(c - a);
        let weight =
            |p: DVec3, r: DVec3| across.dot((p - q).cross(r - q)) / across.length_squared().max(f64::MIN_POSITIVE);
        let weights = DVec3::new(weight(b, c), weight(c, a), weight(a, b)).clamp(DVec3::ZERO, DVec3::ONE);
        let sum = weights.element_sum();
        let weights = if sum > 0.0 { weights / sum } else { DVec3::X };
        Some((self.faces[face as usize], weights.as_vec3()))
    }
}
