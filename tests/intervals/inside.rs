//! How deep a point is inside a volume, which `soft` fades by.

use glam::{DAffine3, DVec3};
use lenspeel::lens::Placement;

use crate::camera::camera;
use crate::random::Random;
use crate::solid::{KINDS, Solid, direction, placement};

/// Depth of the points that are asked, as a share of the size. The depth is of first order where a shape is stretched.
const DEPTH: f64 = 0.001;
const ROUGH: f64 = 0.1;

/// From a point inside to the boundary of a convex solid: the least distance to a plane that touches it, searched for
/// from the best few facets, each turned away from the others.
fn distance(solid: &Solid, p: DVec3, near: DVec3, random: &mut Random) -> f64 {
    let height = |n: DVec3| n.dot(solid.support(n) - p);
    let mut starts = vec![near];
    for _ in 0..8 {
        let facets = solid.facets.iter().map(|facet| facet.normal);
        let apart = facets.filter(|n| starts.iter().all(|start| start.dot(*n) < 0.98));
        starts.extend(apart.min_by(|a, b| height(*a).total_cmp(&height(*b))));
    }
    let lowest = |start: DVec3| {
        (0..150).fold(start, |best, step| {
            let other = (best + direction(random) * 0.2 * 0.5_f64.powi(step / 12)).normalize();
            if height(other) < height(best) { other } else { best }
        })
    };
    starts.into_iter().map(lowest).map(height).fold(f64::INFINITY, f64::min)
}

#[test]
fn just_inside_a_face_the_depth_is_the_distance_to_it() {
    let mut random = Random::new(700);
    let mut compared = 0;
    for kind in KINDS {
        for _ in 0..120 {
            let view = camera(&mut random, [16, 16]);
            let own = placement(&mut random, &view);
            // At a tip that is stretched nothing is of first order.
            let scale = if kind == "apex" { [1.5; 3] } else { [1.6, -1.0, 0.8] };
            let placed = Placement { attach: DAffine3::IDENTITY, scale, ..own };
            let Some(solid) = Solid::new(kind, &mut random, &placed, &view) else { continue };
            let normal = direction(&mut random);
            let touched = solid.support(normal);
            if solid.is_flat && touched.length() > 100.0 {
                continue;
            }
            let below = DEPTH * solid.size;
            let p = touched - normal * below;
            let wanted = distance(&solid, p, normal, &mut random);
            if wanted < 0.3 * below {
                continue;
            }
            let depth = solid.volume.depth_inside(p);
            assert!((depth - wanted).abs() < ROUGH * wanted, "{kind}: {depth} for {wanted}: {:?}", solid.volume);
            let outside = solid.volume.depth_inside(touched + normal * below);
            assert!(outside < 0.0, "{kind}: {outside} outside");
            compared += 1;
        }
    }
    assert!(compared > 500, "only {compared} points");
}

/// Deep inside too, where the map to the world is a similarity, and shapes have flat faces.
#[test]
fn the_depth_of_a_polytope_is_the_distance_to_its_nearest_face() {
    let mut random = Random::new(701);
    for kind in ["cuboid", "polytope", "hull"] {
        for _ in 0..300 {
            let view = camera(&mut random, [16, 16]);
            let placed = placement(&mut random, &view);
            let solid = Solid::new(kind, &mut random, &placed, &view).expect("not flat");
            let p = solid.inner(&mut random);
            let wanted = solid.facets.iter().map(|f| f.reach - f.normal.dot(p)).fold(f64::INFINITY, f64::min);
            let depth = solid.volume.depth_inside(p);
            assert!((depth - wanted).abs() < 1e-6 * solid.size, "{kind}: {depth} for {wanted}");
        }
    }
}

#[test]
fn a_point_far_out_is_far_outside() {
    let mut random = Random::new(702);
    for kind in KINDS.iter().filter(|kind| **kind != "flat") {
        let view = camera(&mut random, [16, 16]);
        let placed = placement(&mut random, &view);
        let solid = Solid::new(kind, &mut random, &placed, &view).expect("not flat");
        let p = solid.middle + DVec3::X * 10.0 * solid.size;
        assert!(solid.volume.depth_inside(p) < -solid.size, "{kind}");
    }
}
