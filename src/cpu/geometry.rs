//! Triangles around the eye, in BVHs: one for each content in place, one for all that lenses simplify, and one for all that
//! they move.

use std::time::Duration;

use glam::{DVec3, Vec3, Vec3A};
use obvhs::bvh2::{Bvh2, builder::build_bvh2};
use obvhs::{BvhBuildParams, aabb::Aabb};
use rayon::prelude::*;

use crate::plan::{Instance, Plan};
use crate::scene::{self, Enclosing, Scene};
use crate::view::View;

/// Triangles in the order of the BVH's leaves.
pub struct Geometry {
    pub bvh: Bvh2,
    pub triangles: Vec<Triangle>,
}

/// A triangle and what it belongs to.
#[derive(Debug, Clone, Copy)]
pub struct Triangle {
    /// Relative to the eye along the world's axes, times [`Reach::scale`].
    pub corners: [Vec3; 3],
    /// Into [`Plan::instances`].
    pub instance: u32,
    /// Into the primitive's triangles.
    pub index: u32,
}

/// Boxes are padded by this share of the largest coordinate, so that rounding in the box test loses no flat triangle.
const PADDING: f32 = 1e-6;

/// Whole blocks of rays go down the BVH together, so that it costs more to make it better than that saves.
const QUICK: BvhBuildParams = BvhBuildParams { reinsertion_batch_ratio: 0.0, ..BvhBuildParams::very_fast_build() };

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
/// Scenes of any size are traced as if the near plane were not very near, away from the least numbers that f32 has; a
/// power of two changes no digit of a coordinate.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Reach {
    /// Depth at which rays start: the eye, or some way before the near plane of an orthographic camera.
    pub start: f64,
    pub scale: f64,
}

/// Where the near plane is at least.
const NEAREST: f64 = 1e-3;

impl Reach {
    pub fn new(view: &View) -> Self {
        let before = if view.is_perspective() { view.near } else { 0.01 * (view.far - view.near) };
        let start = if view.is_perspective() { 0.0 } else { view.near - before };
        Self { start, scale: (NEAREST / before).max(1.0).log2().ceil().exp2() }
    }
}

impl Geometry {
    /// The geometry of each content in place, in their order, then that of simplified versions in place, then that of
    /// everything moved.
    pub fn build_all(scene: &Scene, plan: &Plan) -> Vec<Geometry> {
        let item = |instance: &Instance| &plan.items[instance.item];
        let in_place = |instance: &Instance| !instance.is_moved() && !item(instance).is_simplified();
        let simplified = |instance: &Instance| !instance.is_moved() && item(instance).is_simplified();
        (0..plan.contents.len())
            .map(|content| Self::build(scene, plan, |own| in_place(own) && item(own).content == content))
            .chain([Self::build(scene, plan, simplified), Self::build(scene, plan, Instance::is_moved)])
            .collect()
    }

    /// All that encloses something of the nodes that may be cut.
    pub fn of_bodies(scene: &Scene, plan: &Plan) -> Self {
        let members = plan.bodies.par_iter().flat_map_iter(|body| &body.members);
        let everywhere = scene::Aabb::EVERYWHERE;
        Self::new(
            members
                .flat_map(|member| {
                    let instance = &plan.instances[member.instance];
                    let item = &plan.items[instance.item];
                    let closure = scene.models[item.model].closure(item.mesh, item.ratio);
                    let primitive = item.primitive;
                    let lids = lids(scene, plan, member.instance, &closure.primitives[primitive]);
                    let encloses = move |triangle: &Triangle| {
                        closure.primitives[primitive].role(triangle.index as usize).is_closed()
                    };
                    triangles(scene, plan, member.instance, instance, everywhere).filter(encloses).chain(lids)
                })
                .collect(),
        )
    }

    fn build(scene: &Scene, plan: &Plan, wanted: impl Fn(&Instance) -> bool + Sync) -> Self {
        let instances = plan.instances.par_iter().enumerate().filter(|(_, instance)| wanted(instance));
        // Of a moved instance only what reaches into the lenses that move it there.
        let bounds = |instance: &Instance| {
            if instance.is_moved() { instance.bounds } else { scene::Aabb::EVERYWHERE }
        };
        Self::new(
            instances.flat_map(|(index, instance)| triangles(scene, plan, index, instance, bounds(instance))).collect(),
        )
    }

    fn new(triangles: Vec<Triangle>) -> Self {
        if triangles.is_empty() {
            return Self { bvh: Bvh2::default(), triangles };
        }
        let bvh = build_bvh2(&triangles, QUICK, &mut Duration::default());
        let ordered = bvh.primitive_indices.par_iter().map(|i| triangles[*i as usize]).collect();
        Self { bvh, triangles: ordered }
    }
}

/// What closes holes of an instance over, numbered from its triangles on.
fn lids(scene: &Scene, plan: &Plan, index: usize, enclosing: &Enclosing) -> Vec<Triangle> {
    let instance = &plan.instances[index];
    let item = &plan.items[instance.item];
    let world = instance.shown_from_world * scene.models[item.model].nodes[item.node].world_from_local;
    let scale = Reach::new(&plan.view).scale;
    let around_eye = |p: Vec3| ((world.transform_point3(p.as_dvec3()) - plan.view.eye) * scale).as_vec3();
    let numbered = (item.triangles..).zip(&enclosing.lids);
    numbered
        .map(|(number, (corners, _))| Triangle {
            corners: corners.map(around_eye),
            instance: index as u32,
            index: number,
        })
        .collect()
}

/// The triangles of an instance that reach into some bounds.
fn triangles<'a>(
    scene: &'a Scene,
    plan: &'a Plan,
    index: usize,
    instance: &'a Instance,
    bounds: scene::Aabb,
) -> impl ParallelIterator<Item = Triangle> + 'a {
    let item = &plan.items[instance.item];
    let model = &scene.models[item.model];
    let primitive = item.primitive_of(scene);
    let world = instance.shown_from_world * model.nodes[item.node].world_from_local;
    let scale = Reach::new(&plan.view).scale;
    let shown: Vec<DVec3> = primitive.positions.par_iter().map(|p| world.transform_point3(p.as_dvec3())).collect();
    let numbered = item.triangle_list(scene).par_iter().enumerate();
    numbered.filter_map(move |(number, corners)| {
        let shown = corners.map(|i| shown[i as usize]);
        let is_near = scene::Aabb::from_points(shown).overlaps(&bounds);
        is_near.then(|| Triangle {
            corners: shown.map(|p| ((p - plan.view.eye) * scale).as_vec3()),
            instance: index as u32,
            index: number as u32,
        })
    })
}
