//! The layers that lenses cut a ray into.

use glam::DVec3;
use lenspeel::lens::{LensSet, RayLayers, Volume};
use lenspeel::spec::{Rotation, Shape};
use lenspeel::view::{Ray, View};

use crate::camera::camera;
use crate::random::Random;
use crate::solid::{KINDS, Solid, build, only_interval, placement};

const CASES: usize = 400;
const LENSES: usize = 6;

fn layers(volumes: &[Volume], ray: &Ray, near: f64, far: f64) -> RayLayers {
    let mut layers = RayLayers::default();
    layers.find(volumes.iter().enumerate(), ray, near, far);
    layers
}

/// Lenses of all shapes near one another, and a camera with planes that cut some of them.
fn scattered(random: &mut Random) -> (Vec<Volume>, View) {
    let mut view = camera(random, [16, 16]);
    view.eye = view.forward * random.between(-4.0, -1.0);
    view.near = if view.is_perspective() { random.between(0.01, 2.0) } else { random.between(-4.0, 1.0) };
    view.far = view.near + random.between(0.5, 8.0);
    let solid = |random: &mut Random| {
        let placed = placement(random, &view);
        Solid::new(KINDS[random.index(KINDS.len())], random, &placed, &view)
    };
    let volumes = (0..LENSES).filter_map(|_| Some(solid(random)?.volume)).collect();
    (volumes, view)
}

#[test]
fn the_set_at_a_depth_is_that_of_the_intervals() {
    let mut random = Random::new(400);
    let mut deepest = 0;
    for _ in 0..CASES {
        let (volumes, view) = scattered(&mut random);
        for _ in 0..10 {
            let ray = view.ray(random.between(0.0, 16.0), random.between(0.0, 16.0));
            let found = layers(&volumes, &ray, view.near, view.far);
            let intervals: Vec<_> = volumes.iter().map(|v| only_interval(v, &ray, view.near, view.far)).collect();
            for _ in 0..10 {
                let depth = random.between(view.near, view.far);
                let near_boundary = |x: f64| (x - depth).abs() < 1e-4 * (1.0 + depth.abs());
                if intervals.iter().flatten().any(|i| near_boundary(i.entry) || near_boundary(i.exit)) {
                    continue;
                }
                let inside = |i: usize| intervals[i].is_some_and(|i| i.entry <= depth && depth < i.exit);
                let expected: LensSet = (0..volumes.len()).filter(|i| inside(*i)).collect();
                assert_eq!(found.set_at(depth), expected, "depth {depth} of {intervals:?}");
                deepest = deepest.max(expected.len());
            }
        }
    }
    assert!(deepest >= 4, "no more than {deepest} lenses overlap");
}

#[test]
fn layers_rise_from_near_to_far_and_are_at_most_2n_plus_1() {
    let mut random = Random::new(401);
    let mut most = 0;
    for _ in 0..CASES {
        let (volumes, view) = scattered(&mut random);
        for _ in 0..10 {
            let ray = view.ray(random.between(0.0, 16.0), random.between(0.0, 16.0));
            let found = layers(&volumes, &ray, view.near, view.far);
            assert_eq!(found.starts[0].depth, view.near);
            assert!(found.starts.windows(2).all(|pair| pair[0].depth < pair[1].depth));
            assert!(found.starts.iter().all(|start| start.depth < view.far));
            assert!(
                found.starts.windows(2).all(
                    |pair| pair[1].depth - pair[0].depth > 1e-5 * pair[0].depth.abs() || pair[0].depth == view.near
                )
            );
            assert!(found.starts.len() <= 2 * volumes.len() + 1);
            most = most.max(found.starts.len());
        }
    }
    assert!(most >= 8, "no ray has more than {most} layers");
}

/// Half-open: a lens has the depth at which it begins and not the one at which it ends.
#[test]
fn the_entry_belongs_to_a_lens_and_the_exit_does_not() {
    let mut random = Random::new(402);
    let mut asked = 0;
    for _ in 0..CASES {
        let (volumes, view) = scattered(&mut random);
        let ray = view.ray(8.0, 8.0);
        for (rank, volume) in volumes.iter().enumerate() {
            let Some(interval) = only_interval(volume, &ray, view.near, view.far) else { continue };
            let alone = layers(std::slice::from_ref(volume), &ray, view.near, view.far);
            assert!(alone.set_at(interval.entry).contains(0), "lens {rank} at its entry");
            assert!(interval.exit == view.far || !alone.set_at(interval.exit).contains(0), "lens {rank} at its exit");
            asked += 1;
        }
    }
    assert!(asked > CASES / 2, "only {asked} intervals");
}

/// A row of boxes, each sharing a face with the next, turned, scaled and moved at random.
fn row(random: &mut Random, view: &View, count: usize) -> Vec<Volume> {
    let mut placed = placement(random, view);
    placed.rotation = Rotation::Euler([random.between(-180.0, 180.0), random.between(-180.0, 180.0), 10.0]);
    let borders: Vec<f64> = (0..=count).map(|i| i as f64 * 0.7 + random.between(-0.2, 0.2)).collect();
    let between = |pair: &[f64]| {
        let center = [0.5 * (pair[0] + pair[1]), 0.1, -0.2];
        let shape = Shape::Box { center, size: [pair[1] - pair[0], 1.1, 0.9], rotation: Rotation::default() };
        build(&shape, &placed, view).expect("a box")
    };
    borders.windows(2).map(between).collect()
}

#[test]
fn lenses_that_share_a_face_meet_without_gap_or_sliver() {
    let mut random = Random::new(403);
    let mut passed = 0;
    for _ in 0..CASES {
        let view = camera(&mut random, [16, 16]);
        let volumes = row(&mut random, &view, 4);
        let target = volumes[random.index(4)].center + DVec3::new(0.1, -0.05, 0.02) * random.between(-1.0, 1.0);
        let ray = Ray::new(view.eye, (target - view.eye).normalize());
        // Wide planes: the eye may be inside of one.
        let found = layers(&volumes, &ray, -100.0, 100.0);
        for start in &found.starts {
            assert!(start.set.len() <= 1, "a sliver in two boxes: {found:?}");
        }
        let sets: Vec<LensSet> = found.starts.iter().map(|start| start.set).collect();
        assert!(sets[0].is_empty() && sets[sets.len() - 1].is_empty());
        let inner = &sets[1..sets.len() - 1];
        assert!(inner.iter().all(|set| !set.is_empty()), "a gap between two boxes: {found:?}");
        passed += inner.len().saturating_sub(1);
    }
    assert!(passed > 50, "only {passed} shared faces were passed");
}

/// Negative control: boxes that are pulled apart by more than the tolerance have a gap.
#[test]
fn a_real_gap_stays_one() {
    let mut random = Random::new(404);
    let view = camera(&mut random, [16, 16]);
    let block = |min: f64, max: f64| {
        let shape = Shape::Box {
            center: [0.5 * (min + max), 0.0, 0.0],
            size: [max - min, 1.0, 1.0],
            rotation: Rotation::default(),
        };
        let placed = lenspeel::lens::Placement {
            attach: glam::DAffine3::IDENTITY,
            translation: [0.0; 3],
            rotation: Rotation::default(),
            scale: [1.0; 3],
        };
        build(&shape, &placed, &view).expect("a box")
    };
    let ray = Ray::new(DVec3::ZERO, DVec3::X);
    let counts = [0.0, 1e-7, 1e-4, 1e-3].map(|gap| {
        let volumes = [block(1.0, 2.0), block(2.0 + gap, 3.0)];
        layers(&volumes, &ray, 0.5, 10.0).starts.len()
    });
    assert_eq!(counts, [4, 4, 5, 5]);
}
