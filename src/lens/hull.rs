//! The convex hull of points as a solid.

use std::sync::Arc;

use glam::{DAffine3, DMat3, DQuat, DVec3};
use parry3d_f64::math::Vector;

use super::{Form, MeshSolid, Plane};
use crate::pieces::Role;
use crate::scene::Aabb;

/// Up to so many planes a ray asks every one; from there on a hull is a mesh with a hierarchy.
const FEW_PLANES: usize = 64;

/// Why points span no solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FlatPoints;

/// A convex hull as triangles over some of the points.
#[derive(Debug, Clone)]
pub struct Hull {
    vertices: Vec<DVec3>,
    triangles: Vec<[u32; 3]>,
    /// The longest side of its bounds.
    size: f64,
}

impl Hull {
    pub fn of(points: &[DVec3]) -> Result<Self, FlatPoints> {
        let points_from_cube = own_cube(points)?;
        let into_cube = points_from_cube.inverse();
        let input = points.iter().map(|p| into_cube.transform_point3(*p)).map(|p| Vector::new(p.x, p.y, p.z));
        let (vertices, triangles) =
            parry3d_f64::transformation::try_convex_hull(&input.collect::<Vec<_>>()).map_err(|_| FlatPoints)?;
        let vertices: Vec<DVec3> =
            vertices.iter().map(|p| points_from_cube.transform_point3(DVec3::new(p.x, p.y, p.z))).collect();
        let size = Aabb::from_points(vertices.iter().copied()).size().max_element();
        Ok(Self { vertices, triangles, size })
    }

    fn normal(&self, triangle: &[u32; 3]) -> DVec3 {
        let [a, b, c] = triangle.map(|i| self.vertices[i as usize]);
        (b - a).cross(c - a)
    }

    /// One plane for each face, coplanar triangles sharing one; `None` for more than `most`.
    pub fn planes(&self, most: usize) -> Option<Vec<Plane>> {
        let middle = self.vertices.iter().sum::<DVec3>() / self.vertices.len() as f64;
        let mut planes: Vec<Plane> = Vec::new();
        for triangle in &self.triangles {
            let (normal, a) = (self.normal(triangle), self.vertices[triangle[0] as usize]);
            if normal.length() <= 1e-14 * self.size * self.size {
                continue;
            }
            let plane = Plane::through(if normal.dot(a - middle) < 0.0 { -normal } else { normal }, a);
            let known = |p: &Plane| {
                p.normal.dot(plane.normal) > 1.0 - 1e-12 && (p.offset - plane.offset).abs() <= 1e-9 * self.size
            };
            if !planes.iter().any(known) {
                planes.push(plane);
            }
            if planes.len() > most {
                return None;
            }
        }
        Some(planes)
    }
}

/// An affine map from the cube from -1 to 1 which the points fill along its axes. In it nothing is thin: the library
/// takes what is a thousand times as wide as thick for a polygon.
fn own_cube(points: &[DVec3]) -> Result<DAffine3, FlatPoints> {
    let first = *points.first().ok_or(FlatPoints)?;
    let farthest = |height: &dyn Fn(DVec3) -> DVec3| {
        let offsets = points.iter().map(|p| height(*p - first));
        offsets.max_by(|a, b| a.length_squared().total_cmp(&b.length_squared())).unwrap_or_default().normalize_or_zero()
    };
    let x = farthest(&|offset| offset);
    let y = farthest(&|offset| offset - x * offset.dot(x));
    let axes = DMat3::from_cols(x, y, x.cross(y));
    let bounds = Aabb::from_points(points.iter().map(|p| axes.transpose() * *p));
    let half = bounds.size() * 0.5;
    if half.min_element() <= 1e-7 * half.max_element() {
        return Err(FlatPoints);
    }
    Ok(DAffine3::from_mat3_translation(axes * DMat3::from_diagonal(half), axes * bounds.center()))
}

/// The hull of points as a form, and the space of the points from the form's.
pub fn hull_form(points: &[DVec3]) -> Result<(Form, DAffine3), FlatPoints> {
    let hull = Hull::of(points)?;
    if let Some(mut planes) = hull.planes(FEW_PLANES) {
        // The library may nudge points; the planes move out so that every given point is inside.
        for plane in &mut planes {
            plane.offset = points.iter().map(|p| plane.normal.dot(*p)).fold(plane.offset, f64::max);
        }
        return Ok((Form::HalfSpaces { planes, hidden: 0 }, DAffine3::IDENTITY));
    }
    let bounds = Aabb::from_points(hull.vertices.iter().copied());
    let half = DVec3::splat(0.5 * hull.size);
    let vertices = hull.vertices.iter().map(|p| (*p - bounds.center()) / half).collect();
    let pose = DAffine3::from_scale_rotation_translation(half, DQuat::IDENTITY, bounds.center());
    let roles = vec![Role::PLAIN; hull.triangles.len()];
    let solid = MeshSolid { is_convex: true, ..MeshSolid::with_roles(vertices, &hull.triangles, &roles) };
    Ok((Form::Mesh(Arc::new(solid)), pose))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn planes(form: &Form) -> usize {
        if let Form::HalfSpaces { planes, .. } = form { planes.len() } else { 0 }
    }

    #[test]
    fn the_hull_of_a_cube_and_inner_points_has_six_planes() {
        let mut points: Vec<DVec3> =
            (0..8).map(|i| DVec3::new(f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2))).collect();
        points.extend([DVec3::splat(0.5), DVec3::new(0.2, 0.3, 0.9)]);
        assert_eq!(planes(&hull_form(&points).unwrap().0), 6);
    }

    #[test]
    fn points_in_a_plane_span_nothing() {
        let points = [[0.0, 0.0], [1.0, 0.0], [0.0, 1.0], [1.0, 1.0], [0.3, 0.4]].map(|[x, y]| DVec3::new(x, y, 0.0));
        assert_eq!(hull_form(&points).map(drop), Err(FlatPoints));
        assert_eq!(hull_form(&[DVec3::ONE; 5]).map(drop), Err(FlatPoints));
    }

    #[test]
    fn a_thin_hull_keeps_its_corners() {
        for thickness in [1e-2, 1e-4, 1e-6] {
            let at = |i: i32| DVec3::new(f64::from(i % 7), f64::from(i / 7), 0.0);
            let points: Vec<DVec3> = (0..49).map(at).map(|p| p + DVec3::Z * p.length_squared() * thickness).collect();
            let (form, pose) = hull_form(&points).unwrap();
            let lifted =
                |p: DVec3, by: f64| form.contains(pose.inverse().transform_point3(p + DVec3::Z * by * thickness));
            assert!(points.iter().all(|p| lifted(p.lerp(DVec3::new(3.0, 3.0, 20.0 * thickness), 1e-6), 0.0)));
            assert!(points.iter().all(|p| !lifted(*p, -0.01)), "below the bowl, {thickness}");
        }
    }

    #[test]
    fn a_hull_with_many_faces_is_a_mesh() {
        let golden = std::f64::consts::PI * (3.0 - 5.0_f64.sqrt());
        let points: Vec<DVec3> = (0..500)
            .map(|i| {
                let (turn, z) = (golden * f64::from(i), 1.0 - (2.0 * f64::from(i) + 1.0) / 500.0);
                let r = (1.0 - z * z).sqrt();
                DVec3::new(7.0 + 2.0 * r * turn.cos(), 2.0 * r * turn.sin(), 2.0 * z)
            })
            .collect();
        let (form, pose) = hull_form(&points).unwrap();
        assert!(!form.is_convex(), "too many planes to ask each");
        let inside = |p: DVec3| form.contains(pose.inverse().transform_point3(p));
        assert!(inside(DVec3::new(7.0, 1.9, 0.0)) && !inside(DVec3::new(7.0, 2.01, 0.0)) && !inside(DVec3::ZERO));
    }
}
