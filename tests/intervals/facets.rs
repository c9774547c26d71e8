//! Surfaces of convex solids as triangles, by plain geometry.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec3};

pub type Triangle = [DVec3; 3];

/// Steps around the axis of a lathe, and along a quarter of a circle.
const AROUND: usize = 64;
const QUARTER: usize = 12;

/// A profile `(radius, height)` turned around the z axis, from its lower end to its upper.
pub fn lathe(profile: &[(f64, f64)]) -> Vec<Triangle> {
    let at = |(radius, height): (f64, f64), step: usize| {
        let angle = TAU * (step % AROUND) as f64 / AROUND as f64;
        DVec3::new(radius * angle.cos(), radius * angle.sin(), height)
    };
    let mut triangles = Vec::new();
    for pair in profile.windows(2) {
        for step in 0..AROUND {
            let [a, b] = [at(pair[0], step), at(pair[0], step + 1)];
            let [c, d] = [at(pair[1], step), at(pair[1], step + 1)];
            triangles.extend([[a, b, d], [a, d, c]]);
        }
    }
    triangles.retain(|t| (t[1] - t[0]).cross(t[2] - t[0]).length() > 1e-12);
    triangles
}

/// The profile of a unit ball stretched along z so that its halves are `length` apart.
pub fn capsule_profile(length: f64) -> Vec<(f64, f64)> {
    let mut profile: Vec<(f64, f64)> = Vec::new();
    for step in 0..=QUARTER {
        let angle = 0.5 * PI * step as f64 / QUARTER as f64;
        profile.push((angle.sin(), -angle.cos()));
    }
    let upper: Vec<(f64, f64)> = profile.iter().rev().map(|(r, h)| (*r, length - h)).collect();
    profile.extend(upper);
    profile
}

/// Columns: two axes across the given one, and it.
pub fn frame(axis: DVec3) -> DMat3 {
    let across = if axis.x.abs() < 0.6 * axis.length() { DVec3::X } else { DVec3::Y };
    let x = axis.cross(across).normalize();
    let z = axis.normalize();
    DMat3::from_cols(x, z.cross(x), z)
}

/// The faces of the hull of a few points: every plane through three of them that has all on one side.
pub fn hull_facets(points: &[DVec3]) -> Vec<Triangle> {
    let count = points.len();
    let size = points.iter().map(|p| p.distance(points[0])).fold(0.0, f64::max);
    let mut triangles = Vec::new();
    for i in 0..count {
        for j in i + 1..count {
            for k in j + 1..count {
                let face = face(points, [i, j, k], size);
                triangles.extend((1..face.len().saturating_sub(1)).map(|n| [face[0], face[n], face[n + 1]]));
            }
        }
    }
    triangles
}

/// The corners of the face through three points, in order, if it is one and they are the first three on it.
fn face(points: &[DVec3], three: [usize; 3], size: f64) -> Vec<DVec3> {
    let [a, b, c] = three.map(|i| points[i]);
    let normal = (b - a).cross(c - a);
    // Three points nearly in a line tell nothing about a plane.
    if normal.length() < 1e-7 * (b - a).length() * (c - a).length() {
        return Vec::new();
    }
    let normal = normal.normalize();
    let height = |p: &DVec3| normal.dot(*p - a);
    let tolerance = 1e-9 * size;
    let (mut above, mut below) = (0, 0);
    for p in points {
        above += usize::from(height(p) > tolerance);
        below += usize::from(height(p) < -tolerance);
    }
    let on: Vec<usize> = (0..points.len()).filter(|i| height(&points[*i]).abs() <= tolerance).collect();
    let first = on.len() >= 3 && on[..3] == three;
    if (above > 0 && below > 0) || !first {
        return Vec::new();
    }
    around(on.iter().map(|i| points[*i]).collect(), normal)
}

fn around(mut corners: Vec<DVec3>, normal: DVec3) -> Vec<DVec3> {
    let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
    let axes = frame(normal);
    let angle = |p: &DVec3| (*p - middle).dot(axes.y_axis).atan2((*p - middle).dot(axes.x_axis));
    corners.sort_by(|a, b| angle(a).total_cmp(&angle(b)));
    corners
}

/// The corners of `normal·p <= d` for all planes: where three planes meet inside the others.
pub fn corners_of_planes(planes: &[[f64; 4]]) -> Vec<DVec3> {
    let normal = |i: usize| DVec3::new(planes[i][0], planes[i][1], planes[i][2]);
    let inside = |p: DVec3| (0..planes.len()).all(|i| normal(i).dot(p) <= planes[i][3] + 1e-9);
    let mut corners: Vec<DVec3> = Vec::new();
    for i in 0..planes.len() {
        for j in i + 1..planes.len() {
            for k in j + 1..planes.len() {
                let system = DMat3::from_cols(normal(i), normal(j), normal(k)).transpose();
                if system.determinant().abs() < 1e-9 {
                    continue;
                }
                let p = system.inverse() * DVec3::new(planes[i][3], planes[j][3], planes[k][3]);
                if inside(p) && corners.iter().all(|c| c.distance(p) > 1e-7) {
                    corners.push(p);
                }
            }
        }
    }
    corners
}
