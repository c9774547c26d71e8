//! Triangles around the anchor, in BVHs: one for each content in place, one for all that lenses simplify, and one for all that
//! they move.

use std::collections::HashSet;
use std::time::Duration;

use glam::{DVec3, Vec3, Vec3A};
use obvhs::bvh2::{Bvh2, builder::build_bvh2};
use obvhs::{BvhBuildParams, aabb::Aabb};
use rayon::prelude::*;

use super::intersect::{ShearedRay, TriangleHit};
use crate::plan::{Instance, Plan};
use crate::scene::{self, Enclosing, Scene};
use crate::view::View;

/// Triangles in the order of the BVH's leaves.
pub struct Geometry {
    pub bvh: Bvh2,
    pub triangles: Vec<Triangle>,
    /// Corners in double precision of what has very large triangles, as [`Triangle::exact`] says.
    exact: Vec<[DVec3; 3]>,
}

/// A triangle and what it belongs to.
#[derive(Debug, Clone, Copy)]
pub struct Triangle {
    /// Relative to the view's origin along the world's axes, times [`scale`].
    pub corners: [Vec3; 3],
    /// Into [`Plan::instances`].
    pub instance: u32,
    /// Into the primitive's triangles.
    pub index: u32,
    /// Into [`Geometry::exact`], or [`NONE`].
    pub exact: u32,
}

/// Stands for "not there" in [`Triangle::exact`].
pub const NONE: u32 = u32::MAX;

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

/// The scale at which rays are traced: scenes of any size as if what is seen were about one unit away, far from the least
/// and the largest numbers that f32 has. A power of two changes no digit of a coordinate.
pub fn scale(view: &View) -> f64 {
    (-view.anchor.unit.log2().round()).clamp(-300.0, 300.0).exp2()
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

    /// Where a ray meets a triangle.
    pub fn hit(&self, ray: &ShearedRay, triangle: &Triangle) -> Option<TriangleHit> {
        match self.exact.get(triangle.exact as usize) {
            Some(corners) => ray.hit_exact(corners),
            None => ray.hit(&triangle.corners),
        }
    }

    /// All that encloses something of the nodes that may be cut.
    pub fn of_bodies(scene: &Scene, plan: &Plan) -> Self {
        let members = plan.bodies.par_iter().flat_map_iter(|body| &body.members);
        let everywhere = scene::Aabb::EVERYWHERE;
        Self::new(
            &plan.view,
            members
                .flat_map(|member| {
                    let instance = &plan.instances[member.instance];
                    let item = &plan.items[instance.item];
                    let closure = scene.models[item.model].closure(item.mesh, item.ratio);
                    let primitive = item.primitive;
                    let lids = lids(scene, plan, member.instance, &closure.primitives[primitive]);
                    let encloses = move |(triangle, _): &(Triangle, [DVec3; 3])| {
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
            &plan.view,
            instances.flat_map(|(index, instance)| triangles(scene, plan, index, instance, bounds(instance))).collect(),
        )
    }

    /// `found`: each triangle with its corners in double precision.
    fn new(view: &View, found: Vec<(Triangle, [DVec3; 3])>) -> Self {
        let scale = scale(view);
        let is_large = |corners: &[DVec3; 3]| view.is_large(&corners.map(|p| p / scale));
        // All of an instance is met in one way: its triangles share edges.
        let large: HashSet<u32> =
            found.par_iter().filter(|(_, corners)| is_large(corners)).map(|(triangle, _)| triangle.instance).collect();
        let mut exact = Vec::new();
        let place = |(mut triangle, corners): (Triangle, [DVec3; 3])| {
            if large.contains(&triangle.instance) {
                triangle.exact = exact.len() as u32;
                exact.push(corners);
            }
            triangle
        };
        let triangles: Vec<Triangle> = found.into_iter().map(place).collect();
        Self::of_triangles(triangles, exact)
    }

    pub fn of_triangles(triangles: Vec<Triangle>, exact: Vec<[DVec3; 3]>) -> Self {
        if triangles.is_empty() {
            return Self { bvh: Bvh2::default(), triangles, exact };
        }
        let bvh = build_bvh2(&triangles, QUICK, &mut Duration::default());
        let ordered = bvh.primitive_indices.par_iter().map(|i| triangles[*i as usize]).collect();
        Self { bvh, triangles: ordered, exact }
    }
}

/// What closes holes of an instance over, numbered from its triangles on.
fn lids(scene: &Scene, plan: &Plan, index: usize, enclosing: &Enclosing) -> Vec<(Triangle, [DVec3; 3])> {
    let instance = &plan.instances[index];
    let item = &plan.items[instance.item];
    let world = instance.shown_from_world * scene.models[item.model].nodes[item.node].world_from_local;
    let (scale, origin) = (scale(&plan.view), plan.view.origin());
    let around = |p: Vec3| (world.transform_point3(p.as_dvec3()) - origin) * scale;
    let numbered = (item.triangles..).zip(&enclosing.lids);
    numbered
        .map(|(index_in_item, (corners, _))| {
            let corners = corners.map(around);
            let single = corners.map(|p| p.as_vec3());
            (Triangle { corners: single, instance: index as u32, index: index_in_item, exact: NONE }, corners)
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
) -> impl ParallelIterator<Item = (Triangle, [DVec3; 3])> + 'a {
    let item = &plan.items[instance.item];
    let model = &scene.models[item.model];
    let primitive = item.primitive_of(scene);
    let world = instance.shown_from_world * model.nodes[item.node].world_from_local;
    let (scale, origin) = (scale(&plan.view), plan.view.origin());
    let shown: Vec<DVec3> = primitive.positions.par_iter().map(|p| world.transform_point3(p.as_dvec3())).collect();
    let numbered = item.triangle_list(scene).par_iter().enumerate();
    numbered.filter_map(move |(number, corners)| {
        let shown = corners.map(|i| shown[i as usize]);
        let is_near = scene::Aabb::from_points(shown).overlaps(&bounds);
        is_near.then(|| {
            let corners = shown.map(|p| (p - origin) * scale);
            let (instance, index) = (index as u32, number as u32);
            (Triangle { corners: corners.map(|p| p.as_vec3()), instance, index, exact: NONE }, corners)
        })
    })
}
