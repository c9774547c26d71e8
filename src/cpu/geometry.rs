//! Triangles of each content around the eye, in a wide BVH.

use std::time::Duration;

use glam::{Vec3, Vec3A};
use obvhs::cwbvh::{CwBvh, builder::build_cwbvh};
use obvhs::{BvhBuildParams, aabb::Aabb};
use rayon::prelude::*;

use crate::plan::Plan;
use crate::scene::Scene;
use crate::view::View;

/// One content: its triangles in the order of the BVH's leaves.
pub struct Geometry {
    pub bvh: CwBvh,
    pub triangles: Vec<Triangle>,
}

/// A triangle and what it belongs to.
#[derive(Debug, Clone, Copy)]
pub struct Triangle {
    /// Relative to the eye along the world's axes, times [`Reach::scale`].
    pub corners: [Vec3; 3],
    /// Into [`Plan::items`].
    pub item: u32,
    /// Into the primitive's triangles.
    pub index: u32,
}

/// Boxes are padded by this share of the largest coordinate, so that rounding in the box test loses no flat triangle.
const PADDING: f32 = 1e-6;

impl obvhs::Boundable for Triangle {
    fn aabb(&self) -> Aabb {
        let [a, b, c] = self.corners;
        let (min, max) = (a.min(b).min(c), a.max(b).max(c));
        let pad = PADDING * min.abs().max(max.abs()).max_element() + f32::MIN_POSITIVE;
        Aabb { min: Vec3A::from(min - pad), max: Vec3A::from(max + pad) }
    }
}

/// Where rays start, and the scale at which they are traced.
///
/// obvhs takes everything nearer than 1e-4 for behind the ray, in whatever units. A power of two changes no digit of
/// a coordinate, so scenes of any size are traced as if the near plane were far enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Depth at which rays start: the eye, or some way before the near plane of an orthographic camera.
    pub start: f64,
    pub scale: f64,
}

/// Ten times what obvhs takes for behind the ray.
const NEAREST: f64 = 1e-3;

impl Reach {
    pub fn new(view: &View) -> Self {
        let before = if view.is_perspective() { view.near } else { 0.01 * (view.far - view.near) };
        let start = if view.is_perspective() { 0.0 } else { view.near - before };
        Self { start, scale: (NEAREST / before).max(1.0).log2().ceil().exp2() }
    }
}

impl Geometry {
    /// The geometry of every content of a plan.
    pub fn build_all(scene: &Scene, plan: &Plan) -> Vec<Geometry> {
        (0..plan.contents.len()).map(|content| Self::build(scene, plan, content)).collect()
    }

    fn build(scene: &Scene, plan: &Plan, content: usize) -> Self {
        let scale = Reach::new(&plan.view).scale;
        let items = plan.items.par_iter().enumerate().filter(|(_, item)| item.content == content);
        let triangles: Vec<Triangle> = items
            .flat_map_iter(|(index, item)| {
                let model = &scene.models[item.model];
                let primitive = &model.meshes[item.mesh].primitives[item.primitive];
                let world = model.nodes[item.node].world_from_local;
                let traced = |p: &Vec3| ((world.transform_point3(p.as_dvec3()) - plan.view.eye) * scale).as_vec3();
                let positions: Vec<Vec3> = primitive.positions.iter().map(traced).collect();
                primitive.triangles.iter().enumerate().map(move |(number, corners)| Triangle {
                    corners: corners.map(|i| positions[i as usize]),
                    item: index as u32,
                    index: number as u32,
                })
            })
            .collect();
        if triangles.is_empty() {
            return Self { bvh: CwBvh::default(), triangles };
        }
        let bvh = build_cwbvh(&triangles, BvhBuildParams::medium_build(), &mut Duration::default());
        let ordered = bvh.primitive_indices.par_iter().map(|i| triangles[*i as usize]).collect();
        Self { bvh, triangles: ordered }
    }
}
