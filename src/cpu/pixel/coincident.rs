//! Depths of triangles that share their plane with others: twin of `coincident.wgsl`.

use super::{Tracer, Triangle};
use crate::cpu::intersect::TriangleHit;
use crate::scene::Shared;
use crate::view::Ray;

/// Those that coincide with a hit are surely met before this share more of its parameter.
const ROUNDING: f32 = 1e-4;

impl Tracer<'_> {
    fn shared(&self, triangle: &Triangle) -> Option<&Shared> {
        self.plan.coincident.shared(self.instance(triangle.instance).item, triangle.index)
    }

    /// The depth of a hit: of one that lies in a shared plane that of the plane, the same for all that lie in it.
    pub(super) fn depth_of(&self, triangle: &Triangle, hit: &TriangleHit, ray: &Ray) -> f32 {
        let own = self.depth(hit.t);
        let Some(shared) = self.shared(triangle) else { return own };
        let plane = &self.plan.coincident.planes[shared.plane as usize];
        let instance = self.instance(triangle.instance);
        // A moved ray has the same parameter.
        let ray = if instance.is_moved() { ray.moved(&instance.shown_from_world.inverse()) } else { *ray };
        let depth = (plane.offset - plane.normal.dot(ray.origin)) / plane.normal.dot(ray.direction);
        if depth.is_finite() { depth as f32 } else { own }
    }

    /// The parameter beyond which nothing is in front of a hit, however rounding left it.
    pub(super) fn end_behind(&self, triangle: &Triangle, parameter: f32) -> f32 {
        let room = if self.shared(triangle).is_some() { ROUNDING * parameter.abs() } else { 0.0 };
        parameter + room
    }
}
