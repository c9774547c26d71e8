//! Rays through edges and corners, and surfaces that touch themselves.

use glam::{DAffine3, DVec3};
use lenspeel::lens::Interval;
use lenspeel::spec::{Convex, Rotation, Shape};
use lenspeel::view::Ray;

use super::{check, cube, intervals, outside_torus, placed, torus, unmoved};
use crate::camera::camera;
use crate::facets::Triangle;
use crate::random::Random;
use crate::solid::{build, direction};

const RAYS: usize = 4000;

/// The same rays through the same box as a closed form, as planes of a hull, and as triangles.
#[test]
fn a_cube_of_triangles_is_a_box() {
    let mut random = Random::new(604);
    let shape = Shape::Box { center: [0.0; 3], size: [2.0; 3], rotation: Rotation::default() };
    let view = camera(&mut random, [16, 16]);
    let closed = build(&shape, &unmoved(), &view).expect("a box");
    let meshes = [Convex::AsItStands, Convex::Hull, Convex::Decompose].map(|c| placed(&cube(), c, &unmoved()));
    let mut hits = 0;
    for number in 0..RAYS {
        // Many rays go through corners, the middles of edges and of faces, and along faces.
        let lattice = |random: &mut Random| {
            DVec3::new(random.index(5) as f64, random.index(5) as f64, random.index(5) as f64) - DVec3::splat(2.0)
        };
        let (from, to) = match number % 3 {
            0 => (lattice(&mut random), lattice(&mut random)),
            1 => (direction(&mut random) * 4.0, lattice(&mut random) * 0.5),
            _ => (direction(&mut random) * 4.0, direction(&mut random)),
        };
        let ray = Ray::new(from, (to - from).normalize_or(DVec3::X));
        let expected = intervals(&closed, &ray, -9.0, 9.0);
        for mesh in &meshes {
            let found = intervals(mesh, &ray, -9.0, 9.0);
            let long = |list: &[Interval]| list.iter().filter(|i| i.exit - i.entry > 1e-9).copied().collect::<Vec<_>>();
            let (found, expected) = (long(&found), long(&expected));
            let on_face = (0..3).any(|axis| ray.direction[axis] == 0.0 && ray.origin[axis].abs() == 1.0);
            let same = |(a, b): (&Interval, &Interval)| (a.entry - b.entry).abs().max((a.exit - b.exit).abs()) < 1e-9;
            assert!(
                on_face || (found.len() == expected.len() && found.iter().zip(&expected).all(same)),
                "{ray:?}: {found:?} and {expected:?}"
            );
            hits += found.len();
        }
    }
    assert!(hits > RAYS, "only {hits} intervals");
}

/// A ray through any corner or edge goes in and comes out: sampled points beside it tell the same.
#[test]
fn rays_through_corners_and_edges_leak_nowhere() {
    let mut random = Random::new(605);
    let triangles = torus();
    let volume = placed(&triangles, Convex::Decompose, &unmoved());
    for number in 0..RAYS {
        let [a, b, _] = triangles[random.index(triangles.len())];
        let through = match number % 3 {
            0 => a,
            1 => (a + b) * 0.5,
            _ => a.lerp(b, random.between(0.0, 1.0)),
        };
        // Along axes and diagonals too, where several edges line up.
        let direction = match number % 4 {
            0 => DVec3::AXES[random.index(3)],
            1 => DVec3::new(1.0, 1.0, 0.0),
            2 => (triangles[random.index(triangles.len())][0] - through).normalize_or(DVec3::Z),
            _ => direction(&mut random),
        };
        let ray = Ray::new(through - direction * 2.0, direction);
        let found = intervals(&volume, &ray, -2.0, 6.0);
        check(&volume, outside_torus, &DAffine3::IDENTITY, &ray, &found).unwrap_or_else(|e| panic!("{e}: {ray:?}"));
    }
}

#[test]
fn how_triangles_are_turned_does_not_matter() {
    let mut random = Random::new(606);
    let mut turned = torus();
    turned.iter_mut().filter(|_| random.chance(0.5)).for_each(|t| t.swap(0, 1));
    // Triangles without an area, and one twice over.
    let [a, b, c] = turned[7];
    turned.extend([[a, a, b], [a, b, a], [a, b, c], [c, b, a]]);
    let [one, other] = [torus(), turned].map(|t| placed(&t, Convex::Decompose, &unmoved()));
    for _ in 0..400 {
        let direction = direction(&mut random);
        let ray = Ray::new(DVec3::new(0.6, 0.3, 0.0) - direction * 2.0, direction);
        let [found, same] = [&one, &other].map(|volume| intervals(volume, &ray, 0.0, 6.0));
        let equal = |(a, b): (&Interval, &Interval)| (a.entry - b.entry).abs().max((a.exit - b.exit).abs()) < 1e-12;
        assert!(found.len() == same.len() && found.iter().zip(&same).all(equal), "{found:?} and {same:?}");
    }
}

#[test]
fn two_cubes_that_touch_are_one_solid() {
    let shifted = |by: DVec3| cube().into_iter().map(move |t| t.map(|p| p + by));
    let ray = Ray::new(DVec3::new(-5.0, 0.3, 0.1), DVec3::X);
    // Along a face, along part of a face, at a corner.
    for (by, wanted) in [
        (DVec3::new(2.0, 0.0, 0.0), vec![[4.0, 8.0]]),
        (DVec3::new(2.0, 0.7, 0.2), vec![[4.0, 8.0]]),
        (DVec3::new(2.0, 2.0, 2.0), vec![[4.0, 6.0]]),
    ] {
        let both: Vec<Triangle> = cube().into_iter().chain(shifted(by)).collect();
        let found = intervals(&placed(&both, Convex::Decompose, &unmoved()), &ray, 0.0, 20.0);
        let found: Vec<[f64; 2]> = found.iter().map(|i| [i.entry, i.exit]).collect();
        let near = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < 1e-5;
        assert!(found.len() == wanted.len() && found.iter().zip(&wanted).all(near), "{by}: {found:?}");
    }
}

/// What two cubes have together, whichever way each faces; one wholly inside the other that faces the other way is a hole.
#[test]
fn solids_that_overlap_unite_and_what_faces_inwards_is_a_hole() {
    let at = |center: DVec3, half: f64| cube().into_iter().map(move |t| t.map(|p| center + p * half));
    let turned = |t: Triangle| [t[0], t[2], t[1]];
    let ray = Ray { origin: DVec3::new(-5.0, 0.03, 0.1), direction: DVec3::X, ..Ray::default() };
    let small = || at(DVec3::new(0.1, 0.0, 0.0), 0.5);
    let beside = || at(DVec3::new(1.0, 0.2, 0.1), 1.0);
    let all = |own: Vec<Triangle>| cube().into_iter().chain(own).collect::<Vec<_>>();
    for (triangles, wanted) in [
        (all(beside().collect()), vec![[4.0, 7.0]]),
        (all(beside().map(turned).collect()), vec![[4.0, 7.0]]),
        (all(small().collect()), vec![[4.0, 6.0]]),
        (all(small().map(turned).collect()), vec![[4.0, 4.6], [5.6, 6.0]]),
        (all(small().map(turned).collect()).into_iter().map(turned).collect(), vec![[4.0, 4.6], [5.6, 6.0]]),
    ] {
        let volume = placed(&triangles, Convex::Decompose, &unmoved());
        let found: Vec<[f64; 2]> = intervals(&volume, &ray, 0.0, 20.0).iter().map(|i| [i.entry, i.exit]).collect();
        let near = |(a, b): (&[f64; 2], &[f64; 2])| (a[0] - b[0]).abs().max((a[1] - b[1]).abs()) < 1e-5;
        assert!(found.len() == wanted.len() && found.iter().zip(&wanted).all(near), "{found:?}, not {wanted:?}");
        for depth in [4.3, 5.1, 5.8, 6.5] {
            let is_in = wanted.iter().any(|[entry, exit]| *entry < depth && depth < *exit);
            assert_eq!(volume.contains(ray.at(depth)), is_in, "at {depth}");
        }
    }
}
