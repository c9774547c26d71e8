//! Boxes that a volume is said to hold, or not to touch.

use glam::{DAffine3, DVec3};
use lenspeel::lens::{Placement, Tree, Volume};
use lenspeel::scene::Aabb;

use crate::camera::camera;
use crate::random::Random;
use crate::solid::{KINDS, Solid, placement};

const POINTS: usize = 40;

fn bounds(random: &mut Random, middle: DVec3, size: f64) -> Aabb {
    let mut point = |size: f64| DVec3::from_array([0; 3].map(|_| random.between(-0.5, 0.5) * size));
    let center = middle + point(2.0 * size);
    let half = point(0.5 * size).abs();
    Aabb { min: center - half, max: center + half }
}

/// Points of a box: its corners and others.
fn points(random: &mut Random, bounds: &Aabb) -> Vec<DVec3> {
    let inner =
        |random: &mut Random| bounds.min + bounds.size() * DVec3::from_array([0; 3].map(|_| random.between(0.0, 1.0)));
    let inner: Vec<DVec3> = (0..POINTS).map(|_| inner(random)).collect();
    bounds.corners().into_iter().chain(inner).collect()
}

/// Compares what is said of some boxes with their points; how many are held, apart, and neither.
fn count(random: &mut Random, volume: &Volume, middle: DVec3, size: f64, counts: &mut [usize; 3]) {
    for _ in 0..40 {
        let size = size * random.between(0.05, 1.0);
        let bounds = bounds(random, middle, size);
        let said = volume.holds_box(&bounds);
        let points = points(random, &bounds);
        if let Some(held) = said {
            let wrong = points.iter().find(|p| volume.contains(**p) != held);
            assert_eq!(wrong, None, "{said:?} of {bounds:?}: {volume:?}");
        }
        counts[said.map_or(2, |held| if held { 0 } else { 1 })] += 1;
    }
}

#[test]
fn a_box_that_is_held_or_apart_is_so_at_every_point() {
    let mut random = Random::new(900);
    for kind in KINDS {
        let mut counts = [0; 3];
        for _ in 0..40 {
            let view = camera(&mut random, [16, 16]);
            let own = placement(&mut random, &view);
            let placed = Placement { attach: DAffine3::IDENTITY, scale: [1.6, -1.0, 0.8], ..own };
            let Some(solid) = Solid::new(kind, &mut random, &placed, &view) else { continue };
            count(&mut random, &solid.volume, solid.middle, solid.size, &mut counts);
        }
        assert!(counts.iter().all(|count| *count > 20), "{kind}: {counts:?}");
    }
}

#[test]
fn compounds_put_together_what_is_known_of_their_parts() {
    let mut random = Random::new(901);
    let trees: [fn(Vec<Tree>) -> Tree; 3] = [Tree::Union, Tree::Intersection, Tree::Difference];
    for tree in trees {
        let mut counts = [0; 3];
        for _ in 0..60 {
            let view = camera(&mut random, [16, 16]);
            let own = placement(&mut random, &view);
            let placed = Placement { attach: DAffine3::IDENTITY, ..own };
            let mut solid = || (0..20).find_map(|_| Solid::new("ellipsoid", &mut random, &placed, &view));
            let (Some(a), Some(b)) = (solid(), solid()) else { continue };
            let parts = vec![a.volume.parts[0].clone(), b.volume.parts[0].clone()];
            let volume = Volume { parts, tree: tree(vec![Tree::Part(0), Tree::Part(1)]), center: a.middle };
            count(&mut random, &volume, a.middle, a.size, &mut counts);
        }
        assert!(counts.iter().all(|count| *count > 5), "{counts:?}");
    }
}
