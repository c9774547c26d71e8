//! Closed solids to be used as lenses: a gem, a torus, a bowl and a letter, each a node of one file.

use glam::{DVec3, dvec3};

use super::glb::{Glb, Look, Place};
use super::mesh::Mesh;
use super::shapes::{cuboid_face, torus};
use super::{det, loft};

pub fn solids() -> Vec<u8> {
    let mut glb = Glb::default();
    let material = glb.material(Look::new("glass", 0x9f_d8ff, 0.0, 0.2));
    let all = [("gem", gem()), ("torus", torus(0.7, 0.25, 32, 16)), ("bowl", bowl()), ("letter", letter())];
    for (name, mesh) in all {
        let mesh = glb.mesh(name, &mesh, material);
        glb.node(name, Place::mesh(mesh));
    }
    glb.finish()
}

/// Convex: a girdle of seven corners between a flat top and a point.
fn gem() -> Mesh {
    let top = loft::circle(0.5, 0.4, 7);
    let cap = vec![DVec3::new(0.0, 0.0, 0.4)];
    let tip = vec![DVec3::new(0.0, 0.0, -0.8)];
    loft::solid(&[tip, loft::circle(0.8, 0.1, 7), top, cap]).shaded(10.0)
}

/// The lower half of a ball of radius 0.8 less one of radius 0.6, open to +z.
fn bowl() -> Mesh {
    let (columns, rows) = (32, 10);
    let quarter = |radius: f64| {
        (0..=rows).map(move |row| {
            let angle = std::f64::consts::FRAC_PI_2 * row as f64 / rows as f64;
            if row == 0 { (0.0, -radius) } else { (radius * det::sin(angle), -radius * det::cos(angle)) }
        })
    };
    let inner: Vec<_> = quarter(0.6).collect();
    let profile: Vec<_> = quarter(0.8).chain(inner.into_iter().rev()).collect();
    loft::lathe(&profile, columns).shaded(40.0)
}

/// A block letter of cells 0.3 wide, 0.4 thick, its top towards +y.
fn letter() -> Mesh {
    const ROWS: [&[u8; 5]; 6] = [b"#####", b"#...#", b"#...#", b"#####", b"#...#", b"#...#"];
    const CELL: DVec3 = dvec3(0.3, 0.3, 0.4);
    let filled = |x: i32, y: i32, z: i32| {
        let cell = usize::try_from(5 - y).ok().and_then(|row| ROWS.get(row)?.get(usize::try_from(x).ok()?));
        z == 0 && cell == Some(&b'#')
    };
    let mut mesh = Mesh::default();
    for (x, y) in (0..30).map(|i| (i % 5, i / 5)).filter(|(x, y)| filled(*x, *y, 0)) {
        for (axis, side) in (0..6).map(|i| (i % 3, if i < 3 { 1 } else { -1 })) {
            let step = [0, 1, 2].map(|k| if k == axis { side } else { 0 });
            if !filled(x + step[0], y + step[1], step[2]) {
                let center = (dvec3(f64::from(x), f64::from(y), 0.0) - dvec3(2.0, 2.5, 0.0)) * CELL;
                cuboid_face(&mut mesh, center, CELL, axis, f64::from(side));
            }
        }
    }
    mesh
}
