//! Ready-made solids: spheres, bevelled boxes, cones, a torus, a quad.

use std::f64::consts::{PI, TAU};

use glam::{DVec2, DVec3};

use super::{det, loft, mesh::Mesh};

/// A sphere about the origin with latitude and longitude as texture coordinates (v = 0 at the north pole, +y).
pub fn globe(radius: f64, columns: usize, rows: usize) -> Mesh {
    let mut mesh = Mesh::default();
    for row in 0..=rows {
        let (sin, cos) = ring_of(row, rows);
        for column in 0..=columns {
            // The seam's two copies share one position, bit for bit.
            let angle = TAU * (column % columns) as f64 / columns as f64;
            let normal = DVec3::new(sin * det::cos(angle), cos, -sin * det::sin(angle));
            mesh.positions.push(normal * radius);
            mesh.normals.push(normal);
            mesh.uv.push(DVec2::new(column as f64 / columns as f64, row as f64 / rows as f64));
        }
    }
    let at = |row: usize, column: usize| (row * (columns + 1) + column) as u32;
    for row in 0..rows {
        for column in 0..columns {
            let [a, b, c, d] = [(0, 0), (1, 0), (1, 1), (0, 1)].map(|(r, q)| at(row + r, column + q));
            if row + 1 < rows {
                mesh.triangles.push([a, b, c]);
            }
            if row > 0 {
                mesh.triangles.push([a, c, d]);
            }
        }
    }
    mesh
}

/// Sine and cosine of a row's polar angle, exact at the poles.
fn ring_of(row: usize, rows: usize) -> (f64, f64) {
    match row {
        0 => (0.0, 1.0),
        r if r == rows => (0.0, -1.0),
        r => (det::sin(PI * r as f64 / rows as f64), det::cos(PI * r as f64 / rows as f64)),
    }
}

/// A sphere without texture coordinates.
pub fn ball(radius: f64, columns: usize, rows: usize) -> Mesh {
    let profile: Vec<_> = (0..=rows)
        .map(|row| {
            let (sin, cos) = ring_of(row, rows);
            (sin * radius, -cos * radius)
        })
        .collect();
    let mut mesh = loft::lathe(&profile, columns);
    mesh.normals = mesh.positions.iter().map(|p| *p / radius).collect();
    mesh
}

/// A box about the origin whose edges are cut by `bevel`.
pub fn bevelled_box(size: DVec3, bevel: f64) -> Mesh {
    let half = size * 0.5;
    let corner = |b: f64| DVec2::new(half.x - b, half.y - b);
    let radius = bevel.max(1e-4);
    let level = |inset: f64, z: f64| loft::rounded_rectangle(corner(inset), radius, z, 3);
    let b = radius * 0.7;
    loft::solid(&[
        vec![DVec3::new(0.0, 0.0, -half.z)],
        level(b, -half.z),
        level(0.0, -half.z + b),
        level(0.0, half.z - b),
        level(b, half.z),
        vec![DVec3::new(0.0, 0.0, half.z)],
    ])
    .shaded(50.0)
}

/// A plain box about `center`: 12 triangles, flat normals.
pub fn cuboid(center: DVec3, size: DVec3) -> Mesh {
    let mut mesh = Mesh::default();
    for axis in 0..3 {
        for side in [-1.0, 1.0] {
            cuboid_face(&mut mesh, center, size, axis, side);
        }
    }
    mesh
}

/// Appends the face of a box on one side along an axis.
pub fn cuboid_face(mesh: &mut Mesh, center: DVec3, size: DVec3, axis: usize, side: f64) {
    let [n, u, v] = [0, 1, 2].map(|k| DVec3::AXES[(axis + k) % 3]);
    let (n, u) = (n * side, u * side);
    let corners = [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)];
    let first = mesh.positions.len() as u32;
    mesh.positions.extend(corners.map(|(a, b)| center + (n + u * a + v * b) * size * 0.5));
    mesh.normals.extend([n; 4]);
    mesh.triangles.extend([[0, 1, 2], [0, 2, 3]].map(|t| t.map(|i| i + first)));
}

/// A rectangle in the xy plane facing +z, `v` pointing down as in an image.
pub fn quad(size: DVec2) -> Mesh {
    let corners = [(-0.5, -0.5), (0.5, -0.5), (0.5, 0.5), (-0.5, 0.5)];
    Mesh {
        positions: corners.map(|(x, y)| DVec3::new(x * size.x, y * size.y, 0.0)).to_vec(),
        normals: vec![DVec3::Z; 4],
        uv: corners.map(|(x, y)| DVec2::new(x + 0.5, 0.5 - y)).to_vec(),
        colors: Vec::new(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Mesh::default()
    }
}

/// A torus about the z axis.
pub fn torus(radius: f64, thickness: f64, around: usize, across: usize) -> Mesh {
    let profile: Vec<_> = (0..across)
        .map(|i| {
            let angle = TAU * i as f64 / across as f64;
            (radius + thickness * det::cos(angle), thickness * det::sin(angle))
        })
        .collect();
    loft::lathe_ring(&profile, around).shaded(80.0)
}
