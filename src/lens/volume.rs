//! A lens volume placed in the world.

use glam::{DAffine3, DVec2, DVec3};

use super::{Crossing, Form, Span};
use crate::scene::Aabb;
use crate::view::{Ray, View};

/// A convex volume: a canonical solid and the affine map that places it.
#[derive(Debug, Clone, PartialEq)]
pub struct Volume {
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

/// What a view ray has inside a volume between near and far: `entry <= depth < exit`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    pub entry: f64,
    pub exit: f64,
}

/// Whole pixels `min.. max` of a picture.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct PixelRect {
    pub min: [u32; 2],
    pub max: [u32; 2],
}

impl PixelRect {
    pub const EMPTY: PixelRect = PixelRect { min: [0, 0], max: [0, 0] };

    pub fn is_empty(&self) -> bool {
        self.min[0] >= self.max[0] || self.min[1] >= self.max[1]
    }

    pub fn area(&self) -> u64 {
        if self.is_empty() { 0 } else { u64::from(self.max[0] - self.min[0]) * u64::from(self.max[1] - self.min[1]) }
    }

    pub fn overlaps(&self, other: &PixelRect) -> bool {
        !self.is_empty()
            && !other.is_empty()
            && (0..2).all(|i| self.min[i] < other.max[i] && other.min[i] < self.max[i])
    }
}

impl Volume {
    pub fn new(form: Form, world_from_local: DAffine3, hull: Vec<DVec3>, center: DVec3, is_flat: bool) -> Self {
        Self { form, world_from_local, local_from_world: world_from_local.inverse(), hull, center, is_flat }
    }

    /// Where the whole line of a ray is inside, before any clipping.
    pub fn span(&self, ray: &Ray) -> Option<Span> {
        let origin = self.local_from_world.transform_point3(ray.origin);
        let direction = self.local_from_world.transform_vector3(ray.direction);
        self.form.span(origin, direction)
    }

    /// The interval of SEMANTICS section 2: cut by near and far, none when the ray only grazes.
    pub fn interval(&self, ray: &Ray, near: f64, far: f64) -> Option<Interval> {
        let span = self.span(ray)?;
        let interval = Interval { entry: span.entry.t.max(near), exit: span.exit.t.min(far) };
        (interval.entry < interval.exit).then_some(interval)
    }

    pub fn contains(&self, p: DVec3) -> bool {
        self.form.contains(self.local_from_world.transform_point3(p))
    }

    /// Distance in world units from a point to the nearest boundary, positive inside; of first order where the volume
    /// is scaled unevenly.
    pub fn depth_inside(&self, p: DVec3) -> f64 {
        self.form.depth_inside(self.local_from_world.transform_point3(p), &self.local_from_world.matrix3.transpose())
    }

    /// Outward unit normal in the world where a ray crosses the surface.
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
            Some(points) if nearest > 0.0 || !view.is_perspective() => {
                points.iter().fold((DVec2::INFINITY, DVec2::NEG_INFINITY), |(min, max), p| (min.min(*p), max.max(*p)))
            }
            _ => (DVec2::ZERO, size),
        };
        let min = (min - 1.0).floor().clamp(DVec2::ZERO, size);
        let max = (max + 1.0).ceil().clamp(DVec2::ZERO, size);
        PixelRect { min: [min.x as u32, min.y as u32], max: [max.x as u32, max.y as u32] }
    }
}
