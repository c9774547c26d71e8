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
    divided_rectangle(half, radius, z, per_corner, [1, 1])
}

/// The same with its straight sides along x and y cut into pieces, so that long walls get well-shaped triangles.
pub fn divided_rectangle(half: DVec2, radius: f64, z: f64, per_corner: usize, pieces: [usize; 2]) -> Loop {
    let corners = rectangle_corners(half, radius, z, per_corner);
    (0..4)
        .flat_map(|k| {
            let (last, next) = (corners[k][per_corner - 1], corners[(k + 1) % 4][0]);
            // After the first corner (+x +y) comes the upper side, which runs along x.
            let pieces = pieces[k % 2];
            let inner = (1..pieces).map(move |i| last.lerp(next, i as f64 / pieces as f64));
            corners[k].iter().copied().chain(inner)
        })
        .collect()
}

fn rectangle_corners(half: DVec2, radius: f64, z: f64, per_corner: usize) -> [Loop; 4] {
    let signs = [(1.0, 1.0), (-1.0, 1.0), (-1.0, -1.0), (1.0, -1.0)];
    std::array::from_fn(|k| {
        let center = DVec2::from(signs[k]) * (half - DVec2::splat(radius));
        (0..per_corner)
            .map(|i| {
                let angle = TAU / 4.0 * (k as f64 + i as f64 / (per_corner - 1) as f64);
                (center + DVec2::new(det::cos(angle), det::sin(angle)) * radius).extend(z)
            })
            .collect()
    })
}
