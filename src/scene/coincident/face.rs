//! A triangle in the world, its plane, and whether two lie over each other in one plane.

use glam::{DAffine3, DVec2, DVec3};

/// How far corners may lie from where they are meant to be, as a share of their distance from their node's origin: some
/// steps of f32 for themselves, and for the nodes that turn them.
const RESOLUTION: f64 = 1.0 / (1 << 20) as f64;
/// Nodes are placed in f32, too, by many programs. So many times a triangle's own size the distance of its node counts at
/// the most.
const MOST_AWAY: f64 = 8.0;

#[derive(Debug, Clone, Copy)]
pub struct Face {
    /// Around an origin near all that is drawn.
    pub corners: [DVec3; 3],
    /// Unit length.
    pub normal: DVec3,
    /// The least.
    pub height: f64,
    pub area: f64,
    /// How far its corners may be off.
    pub tolerance: f64,
}

impl Face {
    pub fn new(local: [DVec3; 3], world_from_local: &DAffine3, origin: DVec3) -> Self {
        let axes = world_from_local.matrix3;
        let scale = axes.x_axis.length().max(axes.y_axis.length()).max(axes.z_axis.length());
        let size = local.map(|p| p.abs().max_element()).into_iter().fold(0.0, f64::max) * scale;
        let away = world_from_local.translation.abs().max_element().min(MOST_AWAY * size);
        let shift = world_from_local.translation - origin;
        let corners = local.map(|p| axes * p + shift);
        let [a, b, c] = corners;
        let across = (b - a).cross(c - a);
        let longest = (b - a).length().max((c - b).length()).max((a - c).length());
        let normal = across.normalize_or_zero();
        let (height, area) = (across.length() / longest.max(f64::MIN_POSITIVE), 0.5 * across.length());
        Self { corners, normal, height, area, tolerance: RESOLUTION * size.max(away) }
    }

    /// It has a plane, and is not lost in rounding.
    pub fn is_sound(&self) -> bool {
        self.normal != DVec3::ZERO && self.height > 4.0 * self.tolerance && self.height.is_finite()
    }

    pub fn center(&self) -> DVec3 {
        (self.corners[0] + self.corners[1] + self.corners[2]) / 3.0
    }

    /// Whether two lie in one plane, as far as can be told, and over each other there.
    pub fn coincides(&self, other: &Face) -> bool {
        let tolerance = self.tolerance.max(other.tolerance);
        let (plane, held) = if self.height >= other.height { (self, other) } else { (other, self) };
        let is_near = |p: &DVec3| plane.normal.dot(*p - plane.corners[0]).abs() <= 2.0 * tolerance;
        held.corners.iter().all(is_near) && self.overlaps(other, plane.normal, 4.0 * tolerance)
    }

    /// Whether no line in the plane separates the two, but for a strip of this width.
    fn overlaps(&self, other: &Face, normal: DVec3, width: f64) -> bool {
        // Seen along a normal of the plane.
        let right = normal.any_orthonormal_vector();
        let up = normal.cross(right);
        let origin = self.corners[0];
        let flat = |face: &Face| face.corners.map(|p| DVec2::new(right.dot(p - origin), up.dot(p - origin)));
        let (own, others) = (flat(self), flat(other));
        let ends = |points: &[DVec2; 3], axis: DVec2| {
            let along = points.map(|p| axis.dot(p));
            (along[0].min(along[1]).min(along[2]), along[0].max(along[1]).max(along[2]))
        };
        let is_apart = |p: DVec2, q: DVec2| {
            let axis = (q - p).perp().normalize_or_zero();
            let ((low, high), (other_low, other_high)) = (ends(&own, axis), ends(&others, axis));
            high.min(other_high) - low.max(other_low) <= width
        };
        let sides = |t: &[DVec2; 3]| [(t[0], t[1]), (t[1], t[2]), (t[2], t[0])];
        !sides(&own).into_iter().chain(sides(&others)).any(|(p, q)| is_apart(p, q))
    }
}
