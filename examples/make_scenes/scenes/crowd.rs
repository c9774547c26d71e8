//! A crowd on a board: many pieces, each a node, and one in their middle that they hide.

use glam::dvec3;

use super::glb::{Glb, Look, Place};
use super::mesh::Mesh;
use super::shapes::bevelled_box;
use super::{det, loft};

/// Pieces along a side, one apart.
const SIDE: i32 = 9;
const AROUND: usize = 20;

/// Pawns named `pawn-x-z`, the one in the middle left out for the `king`; all stand on y = 0.
pub fn crowd() -> Vec<u8> {
    let mut glb = Glb::default();
    let [board, gold] = [Look::new("board", 0x33_414e, 0.0, 0.6), Look::new("gold", 0xf5_b02e, 0.3, 0.35)]
        .map(|look| glb.material(look));
    let slab = bevelled_box(dvec3(f64::from(SIDE) + 0.4, f64::from(SIDE) + 0.4, 0.25), 0.04).upright();
    let slab = glb.mesh("board", &slab, board);
    glb.node("board", Place::mesh(slab).at(0.0, -0.125, 0.0));
    let king = glb.mesh("king", &king(), gold);
    glb.node("king", Place::mesh(king));

    let pawn = pawn();
    let pawns = [("ivory", 0xe9_dfc9), ("slate", 0x6d_8699)].map(|(name, hex)| {
        let material = glb.material(Look::new(name, hex, 0.0, 0.45));
        glb.mesh(name, &pawn, material)
    });
    let group = glb.node("pawns", Place::default());
    let half = SIDE / 2;
    for (x, z) in (0..SIDE * SIDE).map(|i| (i % SIDE - half, i / SIDE - half)).filter(|at| *at != (0, 0)) {
        let piece = Place::mesh(pawns[(x + z).rem_euclid(2) as usize]).under(group);
        glb.node(&format!("pawn-{}-{}", x + half, z + half), piece.at(f64::from(x), 0.0, f64::from(z)));
    }
    glb.finish()
}

/// The half outline of a foot and a waist, (radius, height), from the ground up.
const FOOT: [(f64, f64); 8] =
    [(0.0, 0.0), (0.3, 0.0), (0.3, 0.08), (0.26, 0.12), (0.24, 0.2), (0.17, 0.36), (0.12, 0.6), (0.11, 0.74)];

fn pawn() -> Mesh {
    turned(&[&FOOT, &[(0.19, 0.76), (0.19, 0.8)], &head(0.17, 0.93)])
}

fn king() -> Mesh {
    let taller: Vec<_> = FOOT.iter().map(|(radius, height)| (radius * 1.1, height * 1.4)).collect();
    let crown = [(0.22, 1.06), (0.22, 1.12), (0.15, 1.16), (0.24, 1.46), (0.2, 1.52)];
    turned(&[&taller, &crown, &head(0.1, 1.6)])
}

/// A ball of `radius` about `height`, from where it meets the neck to its top.
fn head(radius: f64, height: f64) -> Vec<(f64, f64)> {
    let steps = 10;
    (2..=steps)
        .map(|step| match std::f64::consts::PI * f64::from(step) / f64::from(steps) {
            _ if step == steps => (0.0, height + radius),
            angle => (radius * det::sin(angle), height - radius * det::cos(angle)),
        })
        .collect()
}

fn turned(parts: &[&[(f64, f64)]]) -> Mesh {
    loft::lathe(&parts.concat(), AROUND).upright().shaded(40.0)
}
