//! The skeleton inside the hand, in the same space as the skin: named bones of 27 kinds, radius and ulna.

use std::f64::consts::TAU;

use glam::{DVec3, dvec3};

use super::anatomy::{CARPALS, CM, Digit, centimetres, digits};
use super::det;
use super::glb::{Glb, Look, Place};
use super::loft::{Loop, solid};
use super::mesh::Mesh;
use super::noise::value;
use super::shapes::ball;

/// Radius along a long bone: (position 0..1, share of the radius at that end).
const SHAFT: [(f64, f64); 14] = [
    (0.0, 0.45),
    (0.012, 0.72),
    (0.04, 0.92),
    (0.09, 1.0),
    (0.16, 0.88),
    (0.27, 0.66),
    (0.4, 0.56),
    (0.55, 0.53),
    (0.7, 0.58),
    (0.82, 0.76),
    (0.9, 0.95),
    (0.95, 1.0),
    (0.985, 0.8),
    (1.0, 0.5),
];
const AROUND: usize = 24;

pub fn skeleton() -> Vec<u8> {
    let mut glb = Glb::default();
    let bone = glb.material(Look::new("bone", 0xe8_dcc0, 0.0, 0.6));
    let carpal = glb.material(Look::new("carpal-bone", 0xdc_c9a4, 0.0, 0.62));
    let root = glb.node("skeleton", Place::default());
    let forearm = glb.node("forearm", Place::default().under(root));
    for (name, a, b, ra, rb) in [
        ("radius", [-1.05, -5.7, 0.0], [-0.78, 0.12, 0.0], 0.72, 1.0),
        ("ulna", [1.1, -5.7, 0.0], [0.92, -0.02, 0.0], 0.78, 0.6),
    ] {
        let mesh = long_bone(centimetres(a), centimetres(b), ra * CM, rb * CM, 0.06);
        let mesh = glb.mesh(name, &mesh, bone);
        glb.node(name, Place::mesh(mesh).under(forearm));
    }
    let wrist = glb.node("carpals", Place::default().under(root));
    for (k, (name, at, half)) in CARPALS.into_iter().enumerate() {
        let mesh = glb.mesh(name, &pebble(k as u64, centimetres(half) * 1.16), carpal);
        let at = centimetres(at);
        glb.node(name, Place::mesh(mesh).under(wrist).at(at.x, at.y, at.z));
    }
    let digits = digits();
    let names: &[&str] = &["metacarpal", "proximal", "middle", "distal"];
    for digit in &digits {
        let group = glb.node(digit.name, Place::default().under(root));
        let kinds: Vec<&str> = names.iter().copied().filter(|n| digit.joints.len() == 5 || *n != "middle").collect();
        for (k, kind) in kinds.into_iter().enumerate() {
            let name = format!("{kind}-{}", digit.name);
            let mesh = glb.mesh(&name, &segment(digit, k), bone);
            glb.node(&name, Place::mesh(mesh).under(group));
        }
    }
    glb.finish()
}

/// The bone from joint k to k + 1 of a digit, with room for cartilage at both ends.
fn segment(digit: &Digit, k: usize) -> Mesh {
    let last = k + 2 == digit.joints.len();
    let (a, b) = (digit.joints[k], digit.joints[k + 1]);
    let step = (b - a).normalize() * 0.07 * CM;
    let share = |joint: usize| 0.6 * digit.skin[joint];
    let start = if k == 0 { 0.56 * CM } else { share(k) };
    // The last phalanx is shorter than the finger tip and ends in a narrow tuft.
    let (end, tip) = if last { (a.lerp(b, 0.86), 0.42 * digit.skin[k + 1]) } else { (b - step, share(k + 1)) };
    long_bone(a + step, end, start, tip, 0.1)
}

/// A long bone with thick, two-lobed ends, radii `ra` and `rb` there.
fn long_bone(a: DVec3, b: DVec3, ra: f64, rb: f64, lobes: f64) -> Mesh {
    let turn = det::frame((b - a).normalize(), DVec3::X);
    let mut loops: Vec<Loop> = vec![vec![a]];
    for (t, share) in SHAFT {
        let radius = share * det::lerp(ra, rb, t);
        // Lobes grow towards the ends.
        let lobe = lobes * (share - 0.53).max(0.0) / 0.47;
        loops.push((0..AROUND).map(|i| a.lerp(b, t) + turn * (lobed(i, lobe) * radius)).collect());
    }
    loops.push(vec![b]);
    solid(&loops).shaded(80.0)
}

fn lobed(i: usize, lobe: f64) -> DVec3 {
    let angle = TAU * i as f64 / AROUND as f64;
    let (s, c) = (det::sin(angle), det::cos(angle));
    dvec3(c, s * 0.88, 0.0) * (1.0 - lobe + lobe * (c * c - s * s))
}

/// A rounded lump with uneven sides.
fn pebble(seed: u64, half: DVec3) -> Mesh {
    let mut mesh = ball(1.0, 20, 12);
    for p in &mut mesh.positions {
        let bump = 0.94 + 0.16 * value(seed + 50, *p * 1.6);
        *p = *p * half * bump.min(1.0);
    }
    mesh.shaded(80.0)
}
