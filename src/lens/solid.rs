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
    /// World points whose convex hull holds the volume or, for a flat lens, what it is seen through; none where nothing
    /// bounds it.
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

    /// Whether it has an end on every side: flat lenses, half-spaces and slabs have not.
    pub fn is_bounded(&self) -> bool {
        !self.is_flat && !self.hull.is_empty()
    }

    /// World bounds; unlimited where it is not bounded.
    pub fn bounds(&self) -> Aabb {
        if !self.is_bounded() {
            return Aabb::EVERYWHERE;
        }
        Aabb::from_points(self.hull.iter().copied())
    }

    /// The pixels outside which no view ray meets the volume between near and far: the projected hull, a
    /// pixel larger on each side; all of them where part of the hull is not in front of the eye.
    pub fn pixel_rect(&self, view: &View) -> PixelRect {
        if self.hull.is_empty() {
            return self.unbounded_rect(view);
        }
        let depths = || self.hull.iter().map(|p| view.depth(*p));
        let nearest = depths().fold(f64::INFINITY, f64::min);
        let farthest = depths().fold(f64::NEG_INFINITY, f64::max);
        if matches!(self.form, Form::Empty) || (!self.is_flat && farthest <= view.near) || nearest >= view.far {
            return PixelRect::EMPTY;
        }
        let projected: Option<Vec<DVec2>> = self.hull.iter().map(|p| view.project(*p)).collect();
        match projected {
            Some(points) if view.from_eye(nearest) > 0.0 || !view.is_perspective() => {
                PixelRect::around(points, view.size)
            }
            _ => PixelRect::whole(view.size),
        }
    }

    /// The same of a volume of planes without a hull: where the edges of what is seen lie inside all planes or cross one.
    fn unbounded_rect(&self, view: &View) -> PixelRect {
        let Form::HalfSpaces { planes, .. } = &self.form else { return PixelRect::whole(view.size) };
        let [width, height] = view.size.map(f64::from);
        let corners = [[0.0, 0.0], [width, 0.0], [width, height], [0.0, height]].map(DVec2::from_array);
        let ends: Vec<(DVec2, DVec3)> = [view.near, view.far]
            .into_iter()
            .flat_map(|depth| corners.map(|at| (at, view.ray(at.x, at.y).at(depth))))
            .map(|(at, point)| (at, self.local_from_world.transform_point3(point)))
            .collect();
        let beside = (0..4).flat_map(|i| [(i, (i + 1) % 4), (i + 4, (i + 1) % 4 + 4)]);
        let mut points = Vec::new();
        for (a, b) in beside.chain((0..4).map(|i| (i, i + 4))) {
            let ((at_a, a), (at_b, b)) = (ends[a], ends[b]);
            points.extend([(at_a, a), (at_b, b)].iter().filter(|end| self.form.contains(end.1)).map(|end| end.0));
            // Near and far are planes of one depth, and along a ray the place in the picture is one: it is linear on all edges.
            let crossings = planes.iter().map(|plane| (plane.distance(a), plane.distance(b)));
            let crossings = crossings.filter(|(a, b)| (*a <= 0.0) != (*b <= 0.0)).map(|(a, b)| a / (a - b));
            points.extend(crossings.map(|along| at_a.lerp(at_b, along)));
        }
        PixelRect::around(points, view.size)
    }
}
