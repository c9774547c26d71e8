//! Closed solids from loops of points: lathes, prisms, tubes, cups, gears.

use std::f64::consts::TAU;

use glam::{DVec2, DVec3};

use super::{det, mesh::Mesh};

/// A loop around the solid's axis, counter-clockwise seen from the axis' tip; one point closes the solid there.
pub type Loop = Vec<DVec3>;

/// Joins consecutive loops, first to last; the first and last one should be single points. Loops may differ in length.
pub fn solid(loops: &[Loop]) -> Mesh {
    skin(loops, false)
}

/// Like [`solid`], but the last loop is joined to the first: a ring.
pub fn ring(loops: &[Loop]) -> Mesh {
    skin(loops, true)
}

fn skin(loops: &[Loop], wrap: bool) -> Mesh {
    let mut mesh = Mesh::default();
    let firsts: Vec<u32> = loops
        .iter()
        .map(|points| {
            let first = mesh.positions.len() as u32;
            mesh.positions.extend(points);
            first
        })
        .collect();
    let pairs = if wrap { loops.len() } else { loops.len() - 1 };
    for k in 0..pairs {
        let next = (k + 1) % loops.len();
        stitch(&mut mesh.triangles, (firsts[k], loops[k].len()), (firsts[next], loops[next].len()));
    }
    mesh
}

/// Triangles between two loops given as (first vertex, length), advancing on each in proportion to its length.
fn stitch(triangles: &mut Vec<[u32; 3]>, (a0, a_len): (u32, usize), (b0, b_len): (u32, usize)) {
    let a = |i: usize| a0 + (i % a_len) as u32;
    let b = |i: usize| b0 + (i % b_len) as u32;
    // A single point is never left.
    let steps = |len: usize| if len == 1 { 0 } else { len };
    let (a_steps, b_steps) = (steps(a_len), steps(b_len));
    let (mut i, mut j) = (0, 0);
    while i < a_steps || j < b_steps {
        if i < a_steps && (j >= b_steps || (i + 1) * b_steps <= (j + 1) * a_steps) {
            triangles.push([a(i), a(i + 1), b(j)]);
            i += 1;
        } else {
            triangles.push([a(i), b(j + 1), b(j)]);
            j += 1;
        }
    }
}

/// A circle about the z axis; radius 0 is the single point.
pub fn circle(radius: f64, z: f64, count: usize) -> Loop {
    if radius == 0.0 {
        return vec![DVec3::new(0.0, 0.0, z)];
    }
    (0..count)
        .map(|i| {
            let angle = TAU * i as f64 / count as f64;
            DVec3::new(radius * det::cos(angle), radius * det::sin(angle), z)
        })
        .collect()
}

/// A solid of revolution about z from (radius, z) pairs, from the lower axis point to the upper one.
pub fn lathe(profile: &[(f64, f64)], count: usize) -> Mesh {
    let mut profile = profile.to_vec();
    profile.dedup();
    solid(&profile.iter().map(|(r, z)| circle(*r, *z, count)).collect::<Vec<_>>())
}

/// A ring of revolution about z; the profile is closed, counter-clockwise with the radius to the right and z up.
pub fn lathe_ring(profile: &[(f64, f64)], count: usize) -> Mesh {
    ring(&profile.iter().map(|(r, z)| circle(*r, *z, count)).collect::<Vec<_>>())
}

/// A rectangle with rounded corners about the z axis. `half` is half its size.
pub fn rounded_rectangle(half: DVec2, radius: f64, z: f64, per_corner: usize) -> Loop {
    let corner_centers = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    let mut points = Vec::new();
    for (k, (sx, sy)) in corner_centers.into_iter().enumerate() {
        for i in 0..per_corner {
            let angle = TAU / 4.0 * (k as f64 + i as f64 / (per_corner - 1) as f64);
            let x = sx * (half.x - radius) + radius * det::cos(angle);
            let y = sy * (half.y - radius) + radius * det::sin(angle);
            points.push(DVec3::new(x, y, z));
        }
    }
    points
}
