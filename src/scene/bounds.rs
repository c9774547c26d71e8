//! Tight bounds of nodes, found once for each place where a node has stood last.

use std::sync::{Arc, Mutex, PoisonError};

use glam::DAffine3;

use super::{Aabb, Model, Node, Primitive, object};
use crate::InputError;

/// Farther than this from the origin single precision leaves no room to compute with.
pub(crate) const FARTHEST: f64 = 1e36;
/// And of what is smaller than this nothing is left.
const SMALLEST: f64 = 1e-30;

/// World bounds of the primitives of one node, where it stood last.
#[derive(Debug, Clone)]
struct Known {
    world_from_local: DAffine3,
    mesh: Option<usize>,
    bounds: Arc<Vec<Aabb>>,
}

/// What [`Model::node_bounds`] remembers: a plan of a scene of millions of triangles must not look at each of them again.
/// Poses are seen to by themselves; where a mesh itself changes, a new cache must take the place of this.
#[derive(Debug, Default)]
pub struct BoundsCache(Mutex<Vec<Option<Known>>>);

impl Clone for BoundsCache {
    /// An empty one: the other model may be changed.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Model {
    /// Tight world bounds of each primitive of the node's own mesh.
    pub fn primitive_bounds(&self, index: usize) -> Arc<Vec<Aabb>> {
        let node = &self.nodes[index];
        let mut known = self.bounds_cache.0.lock().unwrap_or_else(PoisonError::into_inner);
        let length = self.nodes.len().max(known.len());
        known.resize(length, None);
        if let Some(known) = &known[index]
            && (known.world_from_local, known.mesh) == (node.world_from_local, node.mesh)
        {
            return Arc::clone(&known.bounds);
        }
        let primitives = node.mesh.map_or(&[][..], |mesh| &self.meshes[mesh].primitives);
        let bounds = Arc::new(primitives.iter().map(|primitive| primitive.bounds(&node.world_from_local)).collect());
        let Node { world_from_local, mesh, .. } = *node;
        known[index] = Some(Known { world_from_local, mesh, bounds: Arc::clone(&bounds) });
        bounds
    }

    /// Tight world bounds of the node's own mesh; empty without triangles.
    pub fn node_bounds(&self, node: usize) -> Aabb {
        self.primitive_bounds(node).iter().copied().fold(Aabb::EMPTY, Aabb::union)
    }

    /// Tight world bounds of what the chosen scene draws.
    pub fn bounds(&self) -> Aabb {
        (0..self.nodes.len())
            .filter(|i| self.nodes[*i].is_shown())
            .fold(Aabb::EMPTY, |b, i| b.union(self.node_bounds(i)))
    }

    /// Fails for what single precision cannot draw: a node that is too far from the origin, a model that is too small.
    pub(crate) fn check_bounds(&self) -> Result<(), InputError> {
        const REMEDY: &str = "scale the model; `lenspeel info` tells its bounds";
        let mut all = Aabb::EMPTY;
        for (index, node) in self.nodes.iter().enumerate().filter(|(_, node)| node.is_shown()) {
            let bounds = self.node_bounds(index);
            let away = bounds.min.abs().max(bounds.max.abs()).max_element();
            if !bounds.is_empty() && away > FARTHEST {
                let label = object("node", index, Some(&node.name));
                let message = format!(
                    "{}: {label} reaches {away:.1e} units from the origin, and pictures reach {FARTHEST:e}",
                    self.name
                );
                return Err(InputError::new(message).help(REMEDY));
            }
            all = all.union(bounds);
        }
        let size = if all.is_empty() { 0.0 } else { all.size().max_element() };
        if size > 0.0 && size < SMALLEST {
            let message = format!(
                "{}: all of the model is {size:.1e} units large, and pictures show what is {SMALLEST:e} or larger",
                self.name
            );
            return Err(InputError::new(message).help(REMEDY));
        }
        Ok(())
    }
}

impl Primitive {
    /// Tight bounds of the vertices that triangles use, after `to_from`.
    fn bounds(&self, to_from: &DAffine3) -> Aabb {
        let mut used = vec![false; self.positions.len()];
        self.triangles.iter().flatten().for_each(|i| used[*i as usize] = true);
        let positions = self.positions.iter().zip(used).filter(|(_, used)| *used);
        Aabb::from_points(positions.map(|(p, _)| to_from.transform_point3(p.as_dvec3())))
    }
}

#[cfg(test)]
mod tests {
    use glam::{DVec3, Vec3};

    use super::*;
    use crate::scene::{Mesh, Transform};

    fn model() -> Model {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::splat(9.0)];
        let primitive = Primitive { positions, triangles: vec![[0, 1, 2]], ..Primitive::default() };
        let node = Node {
            name: "node".into(),
            parent: None,
            children: Vec::new(),
            rest: Transform::IDENTITY,
            world_from_local: DAffine3::IDENTITY,
            mesh: Some(0),
            camera: None,
            light: None,
            drawn: true,
            hidden: false,
        };
        let meshes = vec![Mesh { name: "mesh".into(), primitives: vec![primitive] }];
        Model { nodes: vec![node], meshes, ..Model::default() }
    }

    #[test]
    fn bounds_follow_a_node_and_are_not_found_twice() {
        let mut model = model();
        let first = model.primitive_bounds(0);
        assert_eq!(model.bounds(), Aabb { min: DVec3::ZERO, max: DVec3::new(1.0, 1.0, 0.0) });
        assert!(Arc::ptr_eq(&first, &model.primitive_bounds(0)));
        model.nodes[0].world_from_local.translation = DVec3::Z;
        assert_eq!(model.bounds(), Aabb { min: DVec3::Z, max: DVec3::ONE });
        let mut other = model.clone();
        other.meshes[0].primitives[0].positions[1] = Vec3::X * 2.0;
        assert_eq!(other.bounds().max.x, 2.0);
    }
}
