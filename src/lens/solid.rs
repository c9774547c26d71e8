//! One part of a lens volume placed in the world.

use glam::{DAffine3, DVec2, DVec3};

use super::{Crossing, Form, PixelRect, Span};
use crate::scene::Aabb;
use crate::view::{Ray, View};

/// A canonical solid and the affine map that places it.
#[derive(Debug, Clone, PartialEq)]
pub struct Solid {
    pub form: Form,
    pub world_from_local: DAffine3,
    pub local_from_world: DAffine3,
    /// World points whose convex hull holds the volume or, for a flat lens, what it is seen through.
    pub hull: Vec<DVec3>,
    /// World space. For a flat lens the mean of the corners.
    pub center: DVec3,
    /// A flat lens reaches away from the eye beyond `hull`.
    pub is_flat: bool,
}

impl Solid {
    pub fn new(form: Form, world_from_local: DAffine3, hull: Vec<DVec3>, center: DVec3, is_flat: bool) -> Self {
        Self { form, world_from_local, local_from_world: world_from_local.inverse(), hull, center, is_flat }
    }

    /// Origin and direction of a ray in the solid's own space.
    fn local(&self, ray: &Ray) -> (DVec3, DVec3) {
        (self.local_from_world.transform_point3(ray.origin), self.local_from_world.transform_vector3(ray.direction))
    }

    /// Appends where the whole line of a ray is inside, nearest first, before any clipping.
    pub fn spans(&self, ray: &Ray, out: &mut Vec<Span>) {
        let (origin, direction) = self.local(ray);
        self.form.spans(origin, direction, out);
    }

    /// The only span of a convex solid.
    pub fn span(&self, ray: &Ray) -> Option<Span> {
        let (origin, direction) = self.local(ray);
        self.form.span(origin, direction)
    }

    pub fn contains(&self, p: DVec3) -> bool {
        self.form.contains(self.local_from_world.transform_point3(p))
    }

    /// Distance in world units to the boundary, positive inside; see [`Form::depth_inside`].
    pub fn depth_inside(&self, p: DVec3) -> f64 {
        self.form.depth_inside(self.local_from_world.transform_point3(p), &self.local_from_world.matrix3)
    }

    /// Unit normal in the world where a ray crosses the surface; outward, but for a mesh.
    pub fn normal(&self, ray: &Ray, crossing: &Crossing) -> DVec3 {
        let local = self.form.normal(crossing.face, self.local_from_world.transform_point3(ray.at(crossing.t)));
        (self.local_from_world.matrix3.transpose() * local).normalize_or_zero()
    }

    /// World bounds; unlimited for a flat lens.
    pub fn bounds(&self) -> Aabb {
        if self.is_flat {
            return Aabb { min: DVec3::NEG_INFINITY, max: DVec3::INFINITY };
        }
        Aabb::from_points(self.hull.iter().copied())
    }

    /// The pixels outside which no view ray meets the volume between near and far: the projected hull, a
    /// pixel larger on each side; all of them where part of the hull is not in front of the eye.
    pub fn pixel_rect(&self, view: &View) -> PixelRect {
        let depths = || self.hull.iter().map(|p| view.depth(*p));
        let nearest = depths().fold(f64::INFINITY, f64::min);
        let farthest = depths().fold(f64::NEG_INFINITY, f64::max);
        if matches!(self.form, Form::Empty) || (!self.is_flat && farthest <= view.near) || nearest >= view.far {
            return PixelRect::EMPTY;
        }
        let size = DVec2::new(f64::from(view.size[0]), f64::from(view.size[1]));
        let projected: Option<Vec<DVec2>> = self.hull.iter().map(|p| view.project(*p)).collect();
        let (min, max) = match projected {
            Some(points) if view.from_eye(nearest) > 0.0 || !view.is_perspective() => {
                points.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), p| (min.min(*p), max.max(*p)))
            }
            _ => (DVec2::ZERO, size),
        };
        let min = (min - 1.0).floor().clamp(DVec2::ZERO, size);
        let max = (max + 1.0).ceil().clamp(DVec2::ZERO, size);
        PixelRect { min: [min.x as u32, min.y as u32], max: [max.x as u32, max.y as u32] }
    }
}
