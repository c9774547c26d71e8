//! How deep a point lies inside a solid.

use glam::{DMat3, DVec3};

use super::Form;
use super::form::nearest_on_axis;

impl Form {
    /// The distance in the world from a point of the solid's own space to the boundary, positive inside. To first order
    /// where the map to the world is no similarity: the height inside each face over the length of its gradient in the
    /// world, the least of them.
    pub fn depth_inside(&self, p: DVec3, local_from_world: &DMat3) -> f64 {
        let gradient_to_world = local_from_world.transpose();
        let below = |height: f64, gradient: DVec3| height / (gradient_to_world * gradient).length();
        match self {
            Form::Sphere => below(1.0 - p.length(), p.normalize_or(DVec3::X)),
            Form::Cone { r0, r1 } => {
                let slope = r1 - r0;
                let outward = p.truncate().extend(0.0).normalize_or(DVec3::X);
                let side = below(r0 + slope * p.z - p.truncate().length(), DVec3::Z * slope - outward);
                side.min(below(p.z, DVec3::Z)).min(below(1.0 - p.z, DVec3::Z))
            }
            Form::Capsule { length } => {
                let outward = p - nearest_on_axis(p, *length);
                below(1.0 - outward.length(), outward.normalize_or(DVec3::X))
            }
            Form::HalfSpaces { planes, .. } => {
                planes.iter().map(|plane| below(-plane.distance(p), plane.normal)).fold(f64::INFINITY, f64::min)
            }
            Form::Mesh(mesh) => {
                let outward = mesh.nearest(p) - p;
                let height = if mesh.contains(p) { outward.length() } else { -outward.length() };
                below(height, outward.normalize_or(DVec3::X))
            }
            Form::Empty => f64::NEG_INFINITY,
        }
    }
}
