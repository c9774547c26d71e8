//! Against the closed forms of what is meshed, and against every triangle.

use glam::{DAffine3, DVec3};
use lenspeel::lens::Placement;
use lenspeel::spec::Convex;
use lenspeel::view::Ray;

use super::{Outside, bowl, check, intervals, outside_bowl, outside_torus, placed, torus, unmoved};
use crate::camera::camera;
use crate::facets::Triangle;
use crate::random::Random;
use crate::solid::{direction, placement};

const RAYS: usize = 4000;

fn agrees(triangles: &[Triangle], outside: Outside, seed: u64) {
    let mut random = Random::new(seed);
    let view = camera(&mut random, [16, 16]);
    let (mut several, mut at_near) = (0, 0);
    for _ in 0..20 {
        let placement = placement(&mut random, &view);
        let volume = placed(triangles, Convex::Decompose, &placement);
        let own = placement.world_from_shape().inverse();
        for _ in 0..RAYS / 20 {
            let aim = volume.center + direction(&mut random) * random.between(0.0, 1.0);
            let direction = direction(&mut random);
            let ray = Ray::new(aim - direction * random.between(0.0, 3.0), direction);
            let found = intervals(&volume, &ray, -2.0, 6.0);
            check(&volume, outside, &own, &ray, &found).unwrap_or_else(|e| panic!("{e}: {placement:?}"));
            several += usize::from(found.len() > 1);
            at_near += usize::from(intervals(&volume, &ray, 0.0, 6.0).first().is_some_and(|i| i.entry == 0.0));
        }
    }
    assert!(several > RAYS / 20 && at_near > RAYS / 40, "{several} with several intervals, {at_near} from near");
}

#[test]
fn a_ring_is_where_the_closed_form_has_it() {
    agrees(&torus(), outside_torus, 600);
}

#[test]
fn a_bowl_is_a_ball_less_another() {
    agrees(&bowl(), outside_bowl, 601);
}

/// Negative control: a triangle that is moved, and another solid, are noticed.
#[test]
fn another_solid_is_noticed() {
    let mut random = Random::new(602);
    let volume = placed(&torus(), Convex::Decompose, &unmoved());
    let thicker: Outside = |p| outside_torus(p) - 0.02;
    let wrong = (0..RAYS / 10).filter(|_| {
        let direction = direction(&mut random);
        let ray = Ray::new(direction * -2.0 + DVec3::new(0.7, 0.0, 0.0), direction);
        let found = intervals(&volume, &ray, -2.0, 6.0);
        check(&volume, outside_torus, &DAffine3::IDENTITY, &ray, &found).unwrap_or_else(|e| panic!("{e}"));
        check(&volume, thicker, &DAffine3::IDENTITY, &ray, &found).is_err()
    });
    assert!(wrong.count() > RAYS / 100);
}

/// Against Möller and Trumbore over all triangles.
#[test]
fn boundaries_are_where_the_triangles_are() {
    let mut random = Random::new(603);
    let triangles = torus();
    let volume = placed(&triangles, Convex::Decompose, &unmoved());
    let mut compared = 0;
    for _ in 0..200 {
        let direction = direction(&mut random);
        let aim = DVec3::new(random.between(-0.9, 0.9), random.between(-0.9, 0.9), random.between(-0.2, 0.2));
        let ray = Ray::new(aim - direction * 3.0, direction);
        let mut hits: Vec<f64> = triangles.iter().filter_map(|t| crossing(t, &ray)).collect();
        hits.sort_by(f64::total_cmp);
        let found: Vec<f64> = intervals(&volume, &ray, -9.0, 9.0).iter().flat_map(|i| [i.entry, i.exit]).collect();
        // The plain test may meet both triangles of an edge.
        hits.dedup_by(|a, b| (*a - *b).abs() < 1e-9);
        if hits.len() == found.len() {
            assert!(hits.iter().zip(&found).all(|(a, b)| (a - b).abs() < 1e-9), "{hits:?} and {found:?}");
            compared += hits.len();
        }
    }
    assert!(compared > 300, "only {compared} boundaries");
}

fn crossing([a, b, c]: &Triangle, ray: &Ray) -> Option<f64> {
    let (ab, ac, from) = (b - a, c - a, ray.origin - a);
    let across = ray.direction.cross(ac);
    let (determinant, up) = (ab.dot(across), from.cross(ab));
    let (u, v) = (from.dot(across) / determinant, ray.direction.dot(up) / determinant);
    (u >= 0.0 && v >= 0.0 && u + v <= 1.0).then(|| ac.dot(up) / determinant)
}

#[test]
fn the_depth_in_a_ring_is_the_distance_to_its_surface() {
    let mut random = Random::new(607);
    let volume = placed(&torus(), Convex::Decompose, &Placement { scale: [2.0; 3], ..unmoved() });
    for _ in 0..400 {
        let p = DVec3::new(random.between(-1.2, 1.2), random.between(-1.2, 1.2), random.between(-0.4, 0.4));
        let (depth, wanted) = (volume.depth_inside(p * 2.0), -2.0 * outside_torus(p));
        assert!((depth - wanted).abs() < 4e-3, "{depth} for {wanted} at {p}");
    }
}
