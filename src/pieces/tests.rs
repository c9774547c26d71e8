use std::f64::consts::{PI, TAU};

use super::*;
use crate::scene::Aabb;

const CUBE: Aabb = Aabb { min: DVec3::NEG_ONE, max: DVec3::ONE };

type Triangle = [DVec3; 3];

fn pieces(triangles: &[Triangle]) -> Pieces {
    let mut welder = Welder::new(&CUBE);
    let corners: Vec<[u32; 3]> = triangles.iter().map(|t| t.map(|p| welder.vertex(p))).collect();
    Pieces::new(&welder.vertices, &corners)
}

/// Whether a point is inside, by every one of some rays from it; lids count, too.
fn holds(triangles: &[Triangle], p: DVec3) -> bool {
    let mut welder = Welder::new(&CUBE);
    let corners: Vec<[u32; 3]> = triangles.iter().map(|t| t.map(|p| welder.vertex(p))).collect();
    let pieces = Pieces::new(&welder.vertices, &corners);
    let roles: Vec<Role> = pieces.roles.iter().copied().chain(pieces.lids.iter().map(|lid| lid.1)).collect();
    let corners: Vec<[u32; 3]> = corners.into_iter().chain(pieces.lids.iter().map(|lid| lid.0)).collect();
    let tree = crate::lens::TriangleTree::new(welder.vertices, &corners);
    let told: Vec<bool> = (0..24)
        .map(|i| {
            let (a, z) = (f64::from(i) * 2.4, (f64::from(i) + 0.5) / 12.0 - 1.0);
            let direction = DVec3::new((1.0 - z * z).sqrt() * a.cos(), (1.0 - z * z).sqrt() * a.sin(), z);
            let mut around = Around::default();
            tree.cross(p, direction, |face, crossing| {
                if crossing.t > 0.0 {
                    around.cross(roles[tree.numbers[face as usize] as usize], crossing.turns_left);
                }
            });
            around.is_inside()
        })
        .collect();
    assert!(told.iter().all(|one| *one == told[0]), "rays differ at {p}: {told:?}");
    told[0]
}

fn cuboid(center: [f64; 3], half: f64) -> Vec<Triangle> {
    let corner = |i: usize| {
        DVec3::from_array(center)
            + half * (DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64) * 2.0 - 1.0)
    };
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|t| t.map(corner)).collect()
}

fn turned(triangles: Vec<Triangle>) -> Vec<Triangle> {
    triangles.into_iter().map(|[a, b, c]| [a, c, b]).collect()
}

/// A ball whose seam and poles are only as good as sines are.
fn ball(radius: f64, meridians: u32) -> Vec<Triangle> {
    let parallels = meridians / 2;
    let at = |i: u32, j: u32| {
        let (u, v) = (f64::from(i) / f64::from(meridians) * TAU, f64::from(j) / f64::from(parallels) * PI);
        (radius * DVec3::new(u.cos() * v.sin(), v.cos(), u.sin() * v.sin())).as_vec3().as_dvec3()
    };
    let quads = (0..meridians).flat_map(|i| (0..parallels).map(move |j| (i, j)));
    quads
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

fn joined(all: &[Vec<Triangle>]) -> Vec<Triangle> {
    all.concat()
}

const MIDDLE: DVec3 = DVec3::new(0.013, 0.021, -0.017);

#[test]
fn seams_and_poles_are_welded() {
    let found = pieces(&ball(0.9, 48));
    assert_eq!((found.closed, found.open, found.edges.open, found.edges.turned), (1, 0, 0, 0));
    assert!(holds(&ball(0.9, 48), MIDDLE));
    // Negative control: a gap of ten times the distance.
    let mut torn = ball(0.9, 48);
    torn[777][0] += DVec3::splat(2e-5);
    assert!(pieces(&torn).edges.open > 0);
}

#[test]
fn a_sheet_beside_a_solid_or_grown_into_it_changes_nothing() {
    let solid = cuboid([0.0; 3], 0.5);
    let sheet = |at: [[f64; 3]; 4]| {
        let [a, b, c, d] = at.map(DVec3::from_array);
        vec![[a, b, c], [a, c, d]]
    };
    for sheet in [
        sheet([[-0.9, 0.3, -0.8], [0.9, 0.3, -0.8], [0.9, 0.3, 0.8], [-0.9, 0.3, 0.8]]),
        // On an edge of the solid; and a wall within it, from edge to edge.
        sheet([[0.5, 0.5, -0.5], [0.5, 0.5, 0.5], [0.9, 0.9, 0.5], [0.9, 0.9, -0.5]]),
        sheet([[0.5, 0.5, -0.5], [0.5, 0.5, 0.5], [-0.5, -0.5, 0.5], [-0.5, -0.5, -0.5]]),
    ] {
        let both = joined(&[solid.clone(), sheet]);
        let found = pieces(&both);
        assert_eq!((found.closed, found.open), (1, 1), "{found:?}");
        assert!(found.roles[..12].iter().all(|role| role.is_closed()));
        assert!(!found.roles[12].is_closed() && !found.roles[13].is_closed());
        assert!(holds(&both, MIDDLE) && !holds(&both, DVec3::new(0.7, 0.31, 0.1)));
    }
}

#[test]
fn turned_triangles_are_turned_back() {
    let mut solid = ball(0.9, 24);
    solid.iter_mut().step_by(7).for_each(|t| t.swap(0, 1));
    let found = pieces(&solid);
    assert!(found.edges.turned > 100 && found.closed == 1);
    assert!(found.roles.iter().all(|role| role.faces_one_way()), "no parity is needed");
    assert!(holds(&solid, MIDDLE));
}

#[test]
fn a_surface_that_has_one_side_is_told_by_parity() {
    // A Klein bottle: a ring of rings, the last of which is the first one mirrored. Where its corners lie makes no difference.
    let n = 24u32;
    let at = |i: u32, j: u32| {
        let (i, j) = if i == n { (0, (n - j) % n) } else { (i, j % n) };
        let spread = |factor: f64| (f64::from(i * n + j) * factor).fract() * 1.8 - 0.9;
        DVec3::new(spread(0.618_034), spread(0.754_878), spread(0.569_840))
    };
    let quads = (0..n).flat_map(|i| (0..n).map(move |j| (i, j)));
    let bottle: Vec<Triangle> = quads
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect();
    let found = pieces(&bottle);
    assert_eq!((found.edges.open, found.open), (0, 0));
    assert!(found.roles.iter().all(|role| *role == Role::parity(0)), "{:?}", found.edges);
}

#[test]
fn solids_unite_and_only_what_faces_the_other_way_inside_is_a_hole() {
    let (outer, inner) = (cuboid([0.0; 3], 0.9), cuboid([0.05, 0.0, 0.0], 0.4));
    let beside = cuboid([0.5, 0.5, 0.5], 0.45);
    let in_inner = DVec3::new(0.11, 0.07, -0.03);
    for (solid, expected) in [
        (joined(&[outer.clone(), turned(inner.clone())]), false),
        (joined(&[outer.clone(), inner.clone()]), true),
        // All of it inside out.
        (joined(&[turned(outer.clone()), inner.clone()]), false),
        (joined(&[turned(outer.clone()), turned(inner.clone())]), true),
        // A solid in the hole, whichever way it faces; and another beside all that.
        (joined(&[outer.clone(), turned(inner.clone()), cuboid([0.1, 0.05, 0.0], 0.1)]), true),
        (joined(&[turned(outer.clone()), inner.clone(), cuboid([0.1, 0.05, 0.0], 0.1)]), true),
        (joined(&[outer.clone(), turned(inner.clone()), turned(beside.clone())]), false),
    ] {
        assert_eq!(holds(&solid, in_inner), expected);
        assert!(holds(&solid, DVec3::new(-0.8, 0.13, 0.17)));
        assert!(!holds(&solid, DVec3::new(-0.98, 0.13, 0.17)));
    }
    // Partly in each other they are one, even where one is inside out.
    let (a, b) = (cuboid([-0.3, 0.0, 0.0], 0.5), cuboid([0.3, 0.1, 0.05], 0.5));
    for both in [joined(&[a.clone(), b.clone()]), joined(&[a.clone(), turned(b.clone())]), joined(&[turned(a), b])] {
        for x in [-0.7, 0.01, 0.7] {
            assert!(holds(&both, DVec3::new(x, 0.03, 0.02)), "at {x}");
        }
        assert!(!holds(&both, DVec3::new(0.9, 0.0, 0.0)));
    }
}

#[test]
fn small_holes_have_lids_and_bowls_have_none() {
    let mut torn = ball(0.9, 48);
    torn.drain(700..703);
    let found = pieces(&torn);
    assert_eq!((found.closed, found.mended, found.open, found.are_closed()), (1, 1, 0, false));
    assert!(holds(&torn, MIDDLE) && !holds(&torn, DVec3::splat(0.6)));
    let without_floor: Vec<Triangle> = cuboid([0.0; 3], 0.5).drain(2..).collect();
    assert_eq!(pieces(&without_floor).mended, 1);
    let bowl: Vec<Triangle> = ball(0.9, 48).into_iter().filter(|t| t.iter().all(|p| p.y < 1e-9)).collect();
    let found = pieces(&bowl);
    assert_eq!((found.closed, found.open), (0, 1));
    assert!(found.edges.open == 48 && !holds(&bowl, DVec3::new(0.0, -0.3, 0.0)));
}

#[test]
fn solids_that_touch_in_an_edge_and_doubled_triangles_are_closed() {
    let (a, b) = (cuboid([-0.3, 0.0, 0.0], 0.3), cuboid([0.3, 0.6, 0.0], 0.3));
    let both = joined(&[a.clone(), b]);
    let found = pieces(&both);
    assert_eq!((found.closed, found.open, found.edges.touching), (2, 0, 1));
    assert!(holds(&both, DVec3::new(-0.31, 0.02, 0.01)) && !holds(&both, DVec3::new(0.3, 0.02, 0.01)));
    for other in [a.clone(), turned(a.clone())] {
        let doubled = joined(&[a.clone(), other]);
        assert!(pieces(&doubled).are_closed() && holds(&doubled, DVec3::new(-0.31, 0.02, 0.01)));
    }
    // A triangle over two corners belongs to the solid and opens nothing.
    let mut with_slivers = cuboid([0.0; 3], 0.5);
    let [p, q, _] = with_slivers[0];
    with_slivers.extend([[p, q, q], [p, p, p]]);
    assert!(pieces(&with_slivers).are_closed() && pieces(&with_slivers).closed == 1);
}

#[test]
fn many_pieces_take_little_longer_than_their_triangles() {
    let many: Vec<Triangle> = (0..20_000)
        .flat_map(|i| {
            let place = [i % 50, i / 50 % 40, i / 2000].map(|n| f64::from(n) / 26.0 - 0.95);
            let one = cuboid(place, 0.01);
            if i % 2 == 0 { one } else { turned(one) }
        })
        .collect();
    let found = pieces(&many);
    assert_eq!((found.closed, found.open), (20_000, 0));
}
