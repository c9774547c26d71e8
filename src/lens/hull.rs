//! Half-spaces of the convex hull of points.

use glam::DVec3;
use parry3d_f64::math::Vector;

use super::Plane;

/// Why points span no solid.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct FlatPoints;

/// One plane for each face of the hull; coplanar triangles share one.
pub fn hull_planes(points: &[[f64; 3]]) -> Result<Vec<Plane>, FlatPoints> {
    let input: Vec<Vector> = points.iter().map(|p| Vector::new(p[0], p[1], p[2])).collect();
    let bounds = crate::scene::Aabb::from_points(points.iter().map(|p| DVec3::from_array(*p)));
    let scale = bounds.size().max_element();
    let (vertices, triangles) = parry3d_f64::transformation::try_convex_hull(&input).map_err(|_| FlatPoints)?;
    let vertices: Vec<DVec3> = vertices.iter().map(|p| DVec3::new(p.x, p.y, p.z)).collect();
    let middle = vertices.iter().sum::<DVec3>() / vertices.len().max(1) as f64;
    let mut planes: Vec<Plane> = Vec::new();
    for [a, b, c] in triangles.into_iter().map(|t| t.map(|i| vertices[i as usize])) {
        let normal = (b - a).cross(c - a);
        if normal.length() <= 1e-14 * scale * scale {
            continue;
        }
        let outward = if normal.dot(a - middle) < 0.0 { -normal } else { normal };
        let plane = Plane::through(outward, a);
        let known =
            |p: &Plane| p.normal.dot(plane.normal) > 1.0 - 1e-12 && (p.offset - plane.offset).abs() <= 1e-9 * scale;
        if !planes.iter().any(known) {
            planes.push(plane);
        }
    }
    let extent = planes
        .iter()
        .map(|plane| -vertices.iter().map(|v| plane.distance(*v)).fold(0.0, f64::min))
        .fold(f64::INFINITY, f64::min);
    if planes.len() < 4 || extent <= 1e-7 * scale {
        return Err(FlatPoints);
    }
    // The library may nudge points; the planes move out so that every given point is inside.
    for plane in &mut planes {
        plane.offset = points.iter().map(|p| plane.normal.dot(DVec3::from_array(*p))).fold(plane.offset, f64::max);
    }
    Ok(planes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_hull_of_a_cube_and_inner_points_has_six_planes() {
        let mut points: Vec<[f64; 3]> =
            (0..8).map(|i| [f64::from(i & 1), f64::from(i >> 1 & 1), f64::from(i >> 2)]).collect();
        points.extend([[0.5, 0.5, 0.5], [0.2, 0.3, 0.9]]);
        assert_eq!(hull_planes(&points).unwrap().len(), 6);
    }

    #[test]
    fn points_in_a_plane_span_nothing() {
        let points = [[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [1.0, 1.0, 0.0], [0.3, 0.4, 0.0]];
        assert_eq!(hull_planes(&points), Err(FlatPoints));
        assert_eq!(hull_planes(&[[1.0; 3]; 5]), Err(FlatPoints));
    }
}
