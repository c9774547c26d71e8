//! Closed forms: where a line enters and leaves a solid in its own space.
//!
//! Every solid is first brought to a canonical pose by an affine map, which keeps the parameter along the
//! line. Working precision is f64: the boundaries found here are what both backends are judged by.

use std::sync::Arc;

use glam::DVec3;

use super::{MeshSolid, Plane};

/// A solid in canonical pose; convex, but for a mesh.
#[derive(Debug, Clone, PartialEq)]
pub enum Form {
    /// Radius 1 about the origin.
    Sphere,
    /// Between the planes z = 0 and z = 1, with radius `r0` at the first and `r1` at the second.
    Cone {
        r0: f64,
        r1: f64,
    },
    /// All within 1 of the segment from the origin to (0, 0, `length`).
    Capsule {
        length: f64,
    },
    /// All points with `normal·p <= offset` for every plane. The first `hidden` planes are the sides of a
    /// flat lens: they pass through the eye and are never seen.
    HalfSpaces {
        planes: Vec<Plane>,
        hidden: usize,
    },
    Mesh(Arc<MeshSolid>),
    /// A flat lens seen edge on.
    Empty,
}

/// A crossing of the solid's surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Crossing {
    /// Parameter along the line.
    pub t: f64,
    /// Which face: an index of `HalfSpaces`; a triangle of a mesh; for a cone 0 and 1 are its caps and 2 its side; else 0.
    pub face: u32,
}

/// What a line has inside a solid; `exit.t > entry.t`, either may be infinite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Span {
    pub entry: Crossing,
    pub exit: Crossing,
}

impl Span {
    /// The span if more of it than a point lies between two planes.
    pub fn between(self, near: f64, far: f64) -> Option<Span> {
        (self.entry.t.max(near) < self.exit.t.min(far)).then_some(self)
    }
}

const CONE_SIDE: u32 = 2;

impl Form {
    pub fn is_convex(&self) -> bool {
        !matches!(self, Form::Mesh(_))
    }

    /// Appends the parts of the line `origin + t * direction` inside the solid, nearest first; none where it misses or
    /// only grazes.
    pub fn spans(&self, origin: DVec3, direction: DVec3, out: &mut Vec<Span>) {
        match self {
            Form::Mesh(mesh) => mesh.spans(origin, direction, out),
            _ => out.extend(self.span(origin, direction)),
        }
    }

    /// The only span that a convex solid can have.
    pub fn span(&self, origin: DVec3, direction: DVec3) -> Option<Span> {
        let span = match self {
            Form::Sphere => sphere_span(origin, direction),
            Form::Cone { r0, r1 } => cone_span(origin, direction, *r0, *r1),
            Form::Capsule { length } => capsule_span(origin, direction, *length),
            Form::HalfSpaces { planes, .. } => halfspace_span(origin, direction, planes),
            Form::Mesh(_) | Form::Empty => None,
        }?;
        (span.exit.t > span.entry.t).then_some(span)
    }

    pub fn contains(&self, p: DVec3) -> bool {
        match self {
            Form::Sphere => p.length_squared() <= 1.0,
            Form::Cone { r0, r1 } => {
                let radius = r0 + (r1 - r0) * p.z;
                (0.0..=1.0).contains(&p.z) && p.truncate().length_squared() <= radius * radius
            }
            Form::Capsule { length } => (p - nearest_on_axis(p, *length)).length_squared() <= 1.0,
            Form::HalfSpaces { planes, .. } => planes.iter().all(|plane| plane.distance(p) <= 0.0),
            Form::Mesh(mesh) => mesh.contains(p),
            Form::Empty => false,
        }
    }

    /// Normal, of any length, at a point of the given face; outward, but for a mesh, whose triangles may be turned
    /// either way.
    pub fn normal(&self, face: u32, p: DVec3) -> DVec3 {
        match self {
            Form::Sphere => p,
            Form::Cone { .. } if face == 0 => DVec3::NEG_Z,
            Form::Cone { .. } if face != CONE_SIDE => DVec3::Z,
            Form::Cone { r0, r1 } => {
                let slope = r1 - r0;
                DVec3::new(p.x, p.y, -slope * (r0 + slope * p.z))
            }
            Form::Capsule { length } => p - nearest_on_axis(p, *length),
            Form::HalfSpaces { planes, .. } => planes[face as usize].normal,
            Form::Mesh(mesh) => mesh.normal(face),
            Form::Empty => DVec3::ZERO,
        }
    }

    /// Whether two faces are parts of one smooth surface, whose silhouette is a tangent line rather than an edge.
    pub fn is_smooth_join(&self, a: u32, b: u32) -> bool {
        match self {
            Form::Sphere | Form::Capsule { .. } => true,
            Form::Cone { .. } => a == CONE_SIDE && b == CONE_SIDE,
            Form::HalfSpaces { .. } | Form::Mesh(_) | Form::Empty => false,
        }
    }

    /// Whether this face is drawn: the sides of a flat lens are not.
    pub fn is_seen(&self, face: u32) -> bool {
        !matches!(self, Form::HalfSpaces { hidden, .. } if (face as usize) < *hidden)
    }
}

pub(super) fn nearest_on_axis(p: DVec3, length: f64) -> DVec3 {
    DVec3::new(0.0, 0.0, p.z.clamp(0.0, length))
}

fn span(entry: (f64, u32), exit: (f64, u32)) -> Span {
    Span { entry: Crossing { t: entry.0, face: entry.1 }, exit: Crossing { t: exit.0, face: exit.1 } }
}

/// Where `a t^2 + 2 b t + c` falls through zero and where it rises through it, whatever the sign of `a`.
/// Both products avoid cancellation, so `a` may vanish; a crossing that does not exist is infinite.
fn falls_and_rises(a: f64, b: f64, c: f64) -> Option<(f64, f64)> {
    let discriminant = b * b - a * c;
    if discriminant <= 0.0 {
        return None;
    }
    let root = discriminant.sqrt();
    Some(if b > 0.0 { ((-b - root) / a, c / (-b - root)) } else { (c / (-b + root), (-b + root) / a) })
}

fn sphere_span(o: DVec3, d: DVec3) -> Option<Span> {
    let a = d.length_squared();
    // Measured from the point of the line nearest to the centre, where `b` vanishes.
    let shift = -o.dot(d) / a;
    let c = (o + d * shift).length_squared() - 1.0;
    let half = (-c / a).max(0.0).sqrt();
    (c < 0.0).then(|| span((shift - half, 0), (shift + half, 0)))
}

fn cone_span(o: DVec3, d: DVec3, r0: f64, r1: f64) -> Option<Span> {
    let (mut t0, mut t1, mut cap0, mut cap1) = (f64::NEG_INFINITY, f64::INFINITY, 0, 1);
    if d.z != 0.0 {
        (t0, t1) = (-o.z / d.z, (1.0 - o.z) / d.z);
        if d.z < 0.0 {
            (t0, t1, cap0, cap1) = (t1, t0, cap1, cap0);
        }
    } else if !(0.0..=1.0).contains(&o.z) {
        return None;
    }
    // The cone is the slab between its caps and the inside of its side; where a line goes through a rim or the
    // apex, rounding moves the crossing from one to the other, and nothing is lost.
    let (inward, outward) = side_span(o, d, r0, r1 - r0)?;
    let entry = if inward > t0 { (inward, CONE_SIDE) } else { (t0, cap0) };
    let exit = if outward < t1 { (outward, CONE_SIDE) } else { (t1, cap1) };
    (entry.0 < exit.0).then(|| span(entry, exit))
}

/// Where a line is inside an endless cone with radius `r0 + slope * z`, on the side of the apex where that is positive.
fn side_span(o: DVec3, d: DVec3, r0: f64, slope: f64) -> Option<(f64, f64)> {
    let radius = r0 + slope * o.z;
    let widening = slope * d.z;
    let a = d.x * d.x + d.y * d.y - widening * widening;
    let b = o.x * d.x + o.y * d.y - widening * radius;
    let c = o.x * o.x + o.y * o.y - radius * radius;
    match falls_and_rises(a, b, c) {
        Some((fall, rise)) if a >= 0.0 => Some((fall, rise)),
        // Steeper than the side, the line is inside both halves of the double cone, and one of them is meant.
        Some((fall, _)) if widening > 0.0 => Some((fall, f64::INFINITY)),
        Some((_, rise)) => Some((f64::NEG_INFINITY, rise)),
        None if a < 0.0 && widening > 0.0 => Some((-radius / widening, f64::INFINITY)),
        None if a < 0.0 => Some((f64::NEG_INFINITY, -radius / widening)),
        None => (a == 0.0 && c < 0.0).then_some((f64::NEG_INFINITY, f64::INFINITY)),
    }
}

fn capsule_span(o: DVec3, d: DVec3, length: f64) -> Option<Span> {
    // The union of two balls and the cylinder between them is convex, so its span is the hull of theirs.
    let scale = DVec3::new(1.0, 1.0, 1.0 / length.max(f64::MIN_POSITIVE));
    let body = (length > 0.0).then(|| cone_span(o * scale, d * scale, 1.0, 1.0)).flatten();
    let ends = [sphere_span(o, d), sphere_span(o - DVec3::Z * length, d)];
    [body, ends[0], ends[1]]
        .into_iter()
        .flatten()
        .map(|s| (s.entry.t, s.exit.t))
        .reduce(|a, b| (a.0.min(b.0), a.1.max(b.1)))
        .map(|(entry, exit)| span((entry, 0), (exit, 0)))
}

fn halfspace_span(o: DVec3, d: DVec3, planes: &[Plane]) -> Option<Span> {
    let mut entry = (f64::NEG_INFINITY, 0);
    let mut exit = (f64::INFINITY, 0);
    for (face, plane) in (0u32..).zip(planes) {
        let distance = plane.distance(o);
        let rate = plane.normal.dot(d);
        if rate == 0.0 {
            if distance > 0.0 {
                return None;
            }
        } else if rate < 0.0 {
            let t = -distance / rate;
            if t > entry.0 {
                entry = (t, face);
            }
        } else {
            let t = -distance / rate;
            if t < exit.0 {
                exit = (t, face);
            }
        }
    }
    Some(span(entry, exit))
}
