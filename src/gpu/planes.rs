//! The planes of triangles that are very large for how near they are: see [`View::is_large`](crate::view::View::is_large).
//!
//! Where a ray meets a plane is told by its distance from the view's origin and its normal, both found in double precision:
//! far corners say it only as finely as they are far.

use glam::DVec3;
use rayon::prelude::*;

use super::draws::shown_from_local;
use super::records::NONE;
use crate::plan::{Instance, Plan};
use crate::scene::{Aabb, Scene};

/// Of larger meshes triangles are not looked at one by one: they are not large themselves.
const MOST: usize = 1 << 16;

/// Whether each instance has very large triangles.
pub fn large(scene: &Scene, plan: &Plan) -> Vec<bool> {
    let view = &plan.view;
    let is_large = |instance: &Instance| {
        let Aabb { min, max } = instance.bounds;
        let origin = view.origin();
        // No triangle is larger than the whole, nor farther.
        let may_be = view.is_large(&[min - origin, max - origin, min - origin]);
        may_be && corners(scene, plan, instance).is_some_and(|mut corners| corners.any(|t| view.is_large(&t)))
    };
    plan.instances.par_iter().map(is_large).collect()
}

/// Appends the planes of all triangles of the instances that have large ones; where those of each start, or [`NONE`].
pub fn push(scene: &Scene, plan: &Plan, large: &[bool], vectors: &mut Vec<[f32; 4]>) -> Vec<u32> {
    let mut place = |(instance, is_large): (&Instance, &bool)| {
        let Some(corners) = corners(scene, plan, instance).filter(|_| *is_large) else { return NONE };
        let first = vectors.len() as u32;
        vectors.extend(corners.map(|[a, b, c]| {
            let normal = (b - a).cross(c - a).normalize_or_zero();
            normal.extend(normal.dot(a)).as_vec4().to_array()
        }));
        first
    };
    plan.instances.iter().zip(large).map(&mut place).collect()
}

/// The corners of an instance's triangles around the view's origin; `None` for a mesh of many.
fn corners<'a>(
    scene: &'a Scene,
    plan: &'a Plan,
    instance: &'a Instance,
) -> Option<impl Iterator<Item = [DVec3; 3]> + 'a> {
    let item = &plan.items[instance.item];
    let triangles = item.triangle_list(scene);
    let shown = shown_from_local(scene, item, instance);
    let origin = plan.view.origin();
    let positions = &item.primitive_of(scene).positions;
    let place = move |i: u32| shown.transform_point3(positions[i as usize].as_dvec3()) - origin;
    (triangles.len() <= MOST).then(|| triangles.iter().map(move |t| t.map(&place)))
}
