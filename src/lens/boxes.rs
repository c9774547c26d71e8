//! Boxes against volumes: wholly inside, wholly outside, or neither for sure.

use glam::DVec3;

use super::tree::Algebra;
use super::{Form, Solid, Volume};
use crate::scene::Aabb;

impl Volume {
    /// `Some(true)` only if all of a world box is inside, `Some(false)` only if nothing of it is.
    pub fn holds_box(&self, bounds: &Aabb) -> Option<bool> {
        let algebra: Algebra<Option<bool>> =
            Algebra { union: |a, b| not(both(not(a), not(b))), intersection: both, difference: |a, b| both(a, not(b)) };
        self.tree.fold(&algebra, &|part| self.parts[part].holds_box(bounds)).unwrap_or(Some(false))
    }
}

fn not(a: Option<bool>) -> Option<bool> {
    a.map(|a| !a)
}

fn both(a: Option<bool>, b: Option<bool>) -> Option<bool> {
    match (a, b) {
        (Some(false), _) | (_, Some(false)) => Some(false),
        (Some(true), Some(true)) => Some(true),
        _ => None,
    }
}

impl Solid {
    fn holds_box(&self, bounds: &Aabb) -> Option<bool> {
        if !self.bounds().overlaps(bounds) {
            return Some(false);
        }
        let corners = bounds.corners().map(|p| self.local_from_world.transform_point3(p));
        if self.form.is_apart(&corners) {
            return Some(false);
        }
        let is_inside = self.form.is_convex() && corners.into_iter().all(|corner| self.form.contains(corner));
        is_inside.then_some(true)
    }
}

impl Form {
    /// True only if nothing of the hull of a turned box's corners, in the solid's own space, is inside.
    fn is_apart(&self, corners: &[DVec3; 8]) -> bool {
        let around = Aabb::from_points(corners.iter().copied());
        match self {
            Form::Sphere => DVec3::ZERO.clamp(around.min, around.max).length() > 1.0,
            Form::Cone { r0, r1 } => {
                let radius = r0.max(*r1);
                let own = Aabb { min: DVec3::new(-radius, -radius, 0.0), max: DVec3::new(radius, radius, 1.0) };
                !own.overlaps(&around)
            }
            Form::Capsule { length } => {
                let across = DVec3::ZERO.clamp(around.min, around.max).truncate();
                let along = (around.min.z - length).max(-around.max.z).max(0.0);
                across.extend(along).length() > 1.0
            }
            Form::HalfSpaces { planes, .. } => {
                planes.iter().any(|plane| corners.iter().all(|corner| plane.distance(*corner) > 0.0))
            }
            Form::Mesh(_) => false,
            Form::Empty => true,
        }
    }
}
