//! Triangles whose depths are those of their planes: twin of `planes.wgsl`.
//!
//! Some lie over others in one plane, and all of these have one depth there. Others are very large for how near they are
//! (see [`View::is_large`](crate::view::View::is_large)): a plane is told by its distance from the view's origin and its
//! normal, both found in double precision, where far corners say it only as finely as they are far.

use glam::DVec3;
use rayon::prelude::*;

use super::draws::shown_from_local;
use super::records::NONE;
use super::upload::SceneData;
use crate::plan::{Instance, Plan};
use crate::scene::Scene;

/// Of each instance the triangles that there are, by their numbers in its primitive.
#[derive(Debug, Default)]
pub struct Planes(Vec<Vec<InPlane>>);

/// A triangle and its plane.
#[derive(Debug, Clone, Copy)]
pub struct InPlane {
    pub triangle: u32,
    /// How many others of its plane are drawn before it.
    rank: u32,
    /// Around the view's origin, as shown.
    normal: DVec3,
    offset: f64,
}

impl Planes {
    pub fn new(scene: &Scene, plan: &Plan, uploaded: &SceneData) -> Self {
        let of_instance = |instance: &Instance| {
            let mut found = shared(plan, instance);
            let known = found.len();
            for large in large(scene, plan, uploaded, instance) {
                let is_shared = found[..known].binary_search_by_key(&large.triangle, |shared| shared.triangle).is_ok();
                found.extend((!is_shared).then_some(large));
            }
            found.sort_by_key(|own| own.triangle);
            found
        };
        Self(plan.instances.par_iter().map(of_instance).collect())
    }

    pub fn is_empty(&self) -> bool {
        self.0.iter().all(Vec::is_empty)
    }

    pub fn of(&self, instance: usize) -> &[InPlane] {
        &self.0[instance]
    }

    /// Appends the words of all instances; where those of each start, or [`NONE`].
    pub fn push(&self, words: &mut Vec<u32>) -> Vec<u32> {
        let mut place = |own: &Vec<InPlane>| {
            if own.is_empty() {
                return NONE;
            }
            let first = words.len() as u32;
            words.push(own.len() as u32);
            for InPlane { triangle, rank, normal, offset } in own {
                words.extend([*triangle, *rank]);
                words.extend(normal.as_vec3().to_array().map(f32::to_bits));
                words.push((*offset as f32).to_bits());
            }
            first
        };
        self.0.iter().map(&mut place).collect()
    }
}

/// Those that lie over others.
fn shared(plan: &Plan, instance: &Instance) -> Vec<InPlane> {
    let own = &plan.coincident.parts[instance.item];
    if own.is_empty() {
        return Vec::new();
    }
    let world_from_shown = instance.shown_from_world.inverse();
    let place = |shared: &crate::scene::Shared| {
        let plane = &plan.coincident.planes[shared.plane as usize];
        let normal = world_from_shown.matrix3.transpose() * plane.normal;
        let offset = plane.offset - plane.normal.dot(world_from_shown.transform_point3(plan.view.origin()));
        InPlane { triangle: shared.triangle, rank: shared.rank, normal, offset }
    };
    own.iter().map(place).collect()
}

/// Those that are very large. Whole clusters are asked first: no triangle is larger than its cluster, nor nearer.
fn large(scene: &Scene, plan: &Plan, uploaded: &SceneData, instance: &Instance) -> Vec<InPlane> {
    let view = &plan.view;
    let item = &plan.items[instance.item];
    let shown = shown_from_local(scene, item, instance);
    let origin = view.origin();
    let may_be_large = |corners: [DVec3; 8]| view.is_large(&corners.map(|p| p - origin));
    if !may_be_large(instance.bounds.corners()) {
        return Vec::new();
    }
    let (_, clusters) = uploaded.primitive(item);
    let (order, triangles) = (uploaded.order(item), item.triangle_list(scene));
    let positions = &item.primitive_of(scene).positions;
    let corner = |i: u32| shown.transform_point3(positions[i as usize].as_dvec3()) - origin;
    let near = clusters.iter().filter(|own| may_be_large(own.bounds.corners().map(|p| shown.transform_point3(p))));
    let numbers = near.flat_map(|own| &order[own.first as usize..(own.first + own.count) as usize]);
    let found = numbers.filter_map(|number| {
        let [a, b, c] = triangles[*number as usize].map(corner);
        let normal = (b - a).cross(c - a).normalize_or_zero();
        let offset = normal.dot(a);
        view.is_large(&[a, b, c]).then_some(InPlane { triangle: *number, rank: 0, normal, offset })
    });
    found.collect()
}
