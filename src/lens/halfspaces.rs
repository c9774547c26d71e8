//! Convex polyhedra as half-spaces, and their faces.

use glam::DVec3;

/// The half-space `normal·p <= offset`; `normal` has unit length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    pub normal: DVec3,
    pub offset: f64,
}

impl Plane {
    /// From any normal but zero.
    pub fn new(normal: DVec3, offset: f64) -> Self {
        let length = normal.length();
        Self { normal: normal / length, offset: offset / length }
    }

    pub fn through(normal: DVec3, point: DVec3) -> Self {
        let normal = normal.normalize();
        Self { normal, offset: normal.dot(point) }
    }

    /// The same plane as seen from a point.
    fn about(&self, center: DVec3) -> Self {
        Self { offset: -self.distance(center), ..*self }
    }

    /// Signed distance; positive outside.
    pub fn distance(&self, p: DVec3) -> f64 {
        self.normal.dot(p) - self.offset
    }
}

/// The faces of a bounded convex polyhedron.
#[derive(Debug, Clone, PartialEq)]
pub struct Polyhedron {
    /// The index of the half-space that makes the face, and its corners in order.
    pub faces: Vec<(usize, Vec<DVec3>)>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NotSolid {
    /// The half-spaces leave a direction open.
    Unbounded,
    /// They have no common volume.
    Empty,
}

/// How much larger than the farthest plane the box is from which faces are cut; what still touches it is unbounded.
const REACH: f64 = 1e5;
/// What counts as on a plane, as a share of the farthest plane's distance.
const TOLERANCE: f64 = 1e-10;
/// A solid thinner than this share of that is looked at from its own middle.
const THIN: f64 = 1e-3;
/// How often, at the most.
const ROUNDS: usize = 2;

impl Polyhedron {
    /// A solid that is thin or small for its distance from the origin is found twice: about where it is, and then from
    /// there, with all its digits.
    pub fn from_planes(planes: &[Plane]) -> Result<Self, NotSolid> {
        let mut center = DVec3::ZERO;
        let mut found = Self::cut_box(planes);
        let mut reach = farthest(planes);
        for _ in 0..ROUNDS {
            let bounds = crate::scene::Aabb::from_points(found.vertices());
            if bounds.is_empty() || found.is_open() || bounds.size().min_element() > THIN * reach {
                break;
            }
            center += bounds.center();
            let around: Vec<Plane> = planes.iter().map(|plane| plane.about(center)).collect();
            found = Self::cut_box(&around);
            reach = farthest(&around);
        }
        if found.is_open() {
            return Err(NotSolid::Unbounded);
        }
        let bounds = crate::scene::Aabb::from_points(found.vertices());
        if found.faces.len() < 4 || bounds.size().min_element() <= reach * TOLERANCE * 10.0 {
            return Err(NotSolid::Empty);
        }
        found.faces.iter_mut().flat_map(|(_, corners)| corners).for_each(|corner| *corner += center);
        Ok(found)
    }

    fn is_open(&self) -> bool {
        self.faces.iter().any(|(index, _)| *index == OPEN)
    }

    /// Cuts a huge box by one half-space after the other.
    fn cut_box(planes: &[Plane]) -> Self {
        let size = farthest(planes);
        let tolerance = size * TOLERANCE;
        let mut faces = box_faces(size * REACH);
        for (index, plane) in planes.iter().enumerate() {
            cut(&mut faces, index, plane, tolerance);
        }
        Self { faces }
    }

    /// All corners, those shared by several faces several times.
    pub fn vertices(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.faces.iter().flat_map(|(_, corners)| corners.iter().copied())
    }
}

/// The distance of the farthest plane.
fn farthest(planes: &[Plane]) -> f64 {
    planes.iter().map(|plane| plane.offset.abs()).fold(1e-9, f64::max)
}

/// Marks a face of the box that the cutting starts from.
const OPEN: usize = usize::MAX;

fn box_faces(h: f64) -> Vec<(usize, Vec<DVec3>)> {
    let mut faces = Vec::new();
    for axis in 0..3 {
        for side in [-h, h] {
            let corners = [(-h, -h), (h, -h), (h, h), (-h, h)].map(|(u, v)| {
                let mut p = DVec3::ZERO;
                p[axis] = side;
                p[(axis + 1) % 3] = u;
                p[(axis + 2) % 3] = v;
                p
            });
            faces.push((OPEN, corners.to_vec()));
        }
    }
    faces
}

/// Keeps what lies inside the plane and closes the cut with a new face (Sutherland and Hodgman, for each face).
fn cut(faces: &mut Vec<(usize, Vec<DVec3>)>, index: usize, plane: &Plane, tolerance: f64) {
    if faces.iter().all(|(_, corners)| corners.iter().all(|p| plane.distance(*p) <= tolerance)) {
        return;
    }
    let mut rim: Vec<DVec3> = Vec::new();
    for (_, corners) in faces.iter_mut() {
        // Most faces are far from the plane.
        if corners.iter().all(|p| plane.distance(*p) < -tolerance) {
            continue;
        }
        let mut kept = Vec::with_capacity(corners.len() + 1);
        for (i, &p) in corners.iter().enumerate() {
            let q = corners[(i + 1) % corners.len()];
            let (dp, dq) = (plane.distance(p), plane.distance(q));
            if dp <= tolerance {
                kept.push(p);
                if dp >= -tolerance {
                    rim.push(p);
                }
            }
            if (dp > tolerance && dq < -tolerance) || (dp < -tolerance && dq > tolerance) {
                let crossing = p + (q - p) * (dp / (dp - dq));
                kept.push(crossing);
                rim.push(crossing);
            }
        }
        *corners = kept;
    }
    faces.retain(|(_, corners)| corners.len() >= 3);
    let face = ring(rim, plane.normal, tolerance * 10.0);
    if face.len() >= 3 {
        faces.push((index, face));
    }
}

/// The distinct points of a convex polygon in order around its middle.
fn ring(mut points: Vec<DVec3>, normal: DVec3, tolerance: f64) -> Vec<DVec3> {
    if points.is_empty() {
        return points;
    }
    let middle = points.iter().sum::<DVec3>() / points.len() as f64;
    let (u, v) = normal.any_orthonormal_pair();
    let angle = |p: &DVec3| (*p - middle).dot(v).atan2((*p - middle).dot(u));
    points.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    points.dedup_by(|a, b| a.distance(*b) <= tolerance);
    if points.len() > 1 && points[0].distance(points[points.len() - 1]) <= tolerance {
        points.pop();
    }
    points
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cube() -> Vec<Plane> {
        [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|n| [Plane::new(n, 1.0), Plane::new(-n, 1.0)]).collect()
    }

    #[test]
    fn a_cube_has_six_square_faces() {
        let solid = Polyhedron::from_planes(&cube()).unwrap();
        assert_eq!(solid.faces.len(), 6);
        assert!(solid.faces.iter().all(|(_, corners)| corners.len() == 4));
        assert!(solid.vertices().all(|p| (p.abs() - DVec3::ONE).length() < 1e-6));
    }

    #[test]
    fn an_open_side_and_an_empty_set_are_told_apart() {
        assert_eq!(Polyhedron::from_planes(&cube()[..5]), Err(NotSolid::Unbounded));
        let mut planes = cube();
        planes.push(Plane::new(DVec3::X, -2.0));
        assert_eq!(Polyhedron::from_planes(&planes), Err(NotSolid::Empty));
    }

    #[test]
    fn a_solid_thin_for_its_distance_is_found() {
        let planes = |x: f64| {
            [(DVec3::X, x + 0.5), (DVec3::NEG_X, 0.5 - x), (DVec3::Y, 0.5), (DVec3::NEG_Y, 0.5)]
                .into_iter()
                .chain([(DVec3::Z, 0.0005), (DVec3::NEG_Z, 0.0004)])
                .map(|(normal, offset)| Plane::new(normal, offset))
                .collect::<Vec<_>>()
        };
        for x in [0.0, 1e3, 1e6, 1e8] {
            let solid = Polyhedron::from_planes(&planes(x)).unwrap();
            let size = crate::scene::Aabb::from_points(solid.vertices()).size();
            assert!((size - DVec3::new(1.0, 1.0, 0.0009)).abs().max_element() < 1e-6, "{x}: {size}");
        }
    }

    #[test]
    fn a_redundant_plane_makes_no_face() {
        let mut planes = cube();
        planes.push(Plane::new(DVec3::ONE, 5.0));
        assert_eq!(Polyhedron::from_planes(&planes).unwrap().faces.len(), 6);
    }
}
