//! Depths of triangles that share their plane with others: twin of `planes.wgsl`.

use super::{Tracer, Triangle};
use crate::cpu::intersect::TriangleHit;
use crate::scene::Shared;
use crate::view::Ray;

/// Those that coincide with a hit are surely met before this share more of its parameter, and of its corners' coordinates.
const ROUNDING: f32 = 1e-4;
/// Seen more edge on than this, as the sine of the angle, single precision does not say where a plane is met: twin of
/// `planes.wgsl`.
const ALONG_PLANE: f64 = 1e-6;

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
        let rate = plane.normal.dot(ray.direction);
        if rate.abs() <= ALONG_PLANE * plane.normal.length() * ray.direction.length() {
            return own;
        }
        ((plane.offset - plane.normal.dot(ray.origin)) / rate) as f32
    }

    /// The parameter beyond which nothing is in front of a hit, however rounding left it.
    pub(super) fn end_behind(&self, triangle: &Triangle, parameter: f32) -> f32 {
        if self.shared(triangle).is_none() {
            return parameter;
        }
        // Parameters are counted from the anchor, about which they are small.
        let largest = triangle.corners.iter().map(|p| p.abs().max_element()).fold(0.0, f32::max);
        parameter + ROUNDING * (parameter.abs() + largest)
    }
}
