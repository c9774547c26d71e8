//! Compounds: the intervals of a ray against membership of points, worked out part by part.

use glam::{DAffine3, DVec2, DVec3};
use lenspeel::lens::{Interval, LensMeshes, Placement, Volume, build_volume};
use lenspeel::spec::{At, Rotation, Shape};
use lenspeel::view::{Ray, View};

use crate::camera::camera;
use crate::random::Random;
use crate::solid::{KINDS, direction, placement, shape};

const CASES: usize = 300;
const SAMPLES: usize = 60;

fn at(shape: Shape) -> At<Shape> {
    At::new(shape, 0..0)
}

/// A random compound of single shapes and compounds.
fn compound(random: &mut Random, depth: usize) -> Shape {
    if depth == 0 {
        return shape(KINDS[random.index(KINDS.len())], random);
    }
    let list = (0..1 + random.index(4)).map(|_| at(compound(random, depth - 1))).collect();
    [Shape::Union, Shape::Intersection, Shape::Difference][random.index(3)](list)
}

/// Membership by the words of the format, given that of each part in the order of the file.
fn holds(shape: &Shape, parts: &mut impl Iterator<Item = bool>) -> bool {
    let mut each = |list: &[At<Shape>]| list.iter().map(|part| holds(&part.value, parts)).collect::<Vec<bool>>();
    match shape {
        Shape::Union(list) => each(list).contains(&true),
        Shape::Intersection(list) => !each(list).contains(&false),
        Shape::Difference(list) => {
            let all = each(list);
            all[0] && !all[1..].contains(&true)
        }
        _ => parts.next().expect("as many parts as shapes that are no compounds"),
    }
}

fn intervals(volume: &Volume, ray: &Ray, near: f64, far: f64) -> Vec<Interval> {
    let mut found = Vec::new();
    volume.intervals(ray, near, far, &mut found);
    found
}

/// What is wrong with the intervals of a ray, away from where any part begins or ends.
fn check(shape: &Shape, volume: &Volume, ray: &Ray, near: f64, far: f64, found: &[Interval]) -> Result<(), String> {
    let ends = |i: &Interval| near <= i.entry && i.entry < i.exit && i.exit <= far;
    if !found.iter().all(ends) || !found.windows(2).all(|pair| pair[0].exit < pair[1].entry) {
        return Err(format!("not in order between {near} and {far}: {found:?}"));
    }
    let mut spans = Vec::new();
    volume.parts.iter().for_each(|part| part.spans(ray, &mut spans));
    for step in 0..SAMPLES {
        let depth = near + (far - near) * (step as f64 + 0.5) / SAMPLES as f64;
        let beside = |t: f64| (t - depth).abs() <= 1e-4 * (1.0 + depth.abs());
        if spans.iter().any(|span| beside(span.entry.t) || beside(span.exit.t)) {
            continue;
        }
        let p = ray.at(depth);
        let wanted = holds(shape, &mut volume.parts.iter().map(|part| part.contains(p)));
        let got = found.iter().any(|i| i.entry <= depth && depth < i.exit);
        if got != wanted || volume.contains(p) != wanted {
            return Err(format!(
                "at {depth}: {wanted} is wanted, intervals {found:?}, contains {}",
                volume.contains(p)
            ));
        }
    }
    Ok(())
}

/// A compound before a camera, with planes that often cut it.
fn stage(random: &mut Random) -> Option<(Shape, Volume, View)> {
    let mut view = camera(random, [16, 16]);
    view.eye = view.forward * random.between(-4.0, 1.0);
    view.near = if view.is_perspective() { random.between(0.01, 1.0) } else { random.between(-4.0, 1.0) };
    view.far = view.near + random.between(1.0, 9.0);
    let shape = compound(random, 3);
    let placed = placement(random, &view);
    let volume = build_volume(&at(shape.clone()), &placed, &view, &LensMeshes::default()).ok()?;
    Some((shape, volume, view))
}

/// Through some part, or anywhere.
fn some_ray(volume: &Volume, view: &View, random: &mut Random) -> Ray {
    let near = volume.parts[random.index(volume.parts.len())].center + direction(random) * random.between(0.0, 0.5);
    let pixel = view.project(near).filter(|_| random.chance(0.9));
    let pixel = pixel.unwrap_or_else(|| DVec2::new(random.between(0.0, 16.0), random.between(0.0, 16.0)));
    view.ray(pixel.x, pixel.y)
}

#[test]
fn intervals_are_where_the_points_are_inside() {
    let mut random = Random::new(500);
    let (mut several, mut inside_at_near, mut rays) = (0, 0, 0);
    for _ in 0..CASES {
        let Some((shape, volume, view)) = stage(&mut random) else { continue };
        for _ in 0..12 {
            let ray = some_ray(&volume, &view, &mut random);
            let found = intervals(&volume, &ray, view.near, view.far);
            check(&shape, &volume, &ray, view.near, view.far, &found).unwrap_or_else(|e| panic!("{e}: {shape:?}"));
            several += usize::from(found.len() > 1);
            inside_at_near += usize::from(found.first().is_some_and(|i| i.entry == view.near));
            rays += usize::from(!found.is_empty());
        }
    }
    assert!(several > 60 && inside_at_near > 60 && rays > 400, "{several}, {inside_at_near}, {rays} of {CASES} x 12");
}

#[test]
fn what_is_wrong_with_intervals_is_noticed() {
    let mut random = Random::new(501);
    let (mut asked, mut noticed) = (0, 0);
    for _ in 0..CASES {
        let Some((shape, volume, view)) = stage(&mut random) else { continue };
        let ray = some_ray(&volume, &view, &mut random);
        let found = intervals(&volume, &ray, view.near, view.far);
        if found.is_empty() {
            continue;
        }
        let shift = 0.05 * (view.far - view.near);
        let mut moved = found.clone();
        moved[0].entry = (moved[0].entry + shift).min(moved[0].exit);
        for wrong in [&found[1..], &moved[..], &[]] {
            asked += 1;
            noticed += usize::from(check(&shape, &volume, &ray, view.near, view.far, wrong).is_err());
        }
    }
    assert!(asked > 200 && noticed * 100 >= asked * 90, "{noticed} of {asked}");
}

#[test]
fn the_pixels_of_a_compound_hold_every_interval() {
    let mut random = Random::new(502);
    let mut tight = 0;
    for _ in 0..CASES {
        let Some((shape, volume, view)) = stage(&mut random) else { continue };
        let rect = volume.pixel_rect(&view);
        for (x, y) in (0..256).map(|i| (i % 16, i / 16)) {
            let ray = view.ray(f64::from(x) + random.between(0.0, 1.0), f64::from(y) + random.between(0.0, 1.0));
            let held = (rect.min[0]..rect.max[0]).contains(&x) && (rect.min[1]..rect.max[1]).contains(&y);
            let seen = !intervals(&volume, &ray, view.near, view.far).is_empty();
            assert!(held || !seen, "{x},{y} is not in {rect:?}: {shape:?}");
        }
        tight += usize::from(rect.area() < 256);
    }
    assert!(tight > CASES / 10, "only {tight} rectangles are smaller than the picture");
}

fn plain(shape: Shape) -> Volume {
    let placed =
        Placement { attach: DAffine3::IDENTITY, translation: [0.0; 3], rotation: Rotation::default(), scale: [1.0; 3] };
    let view = camera(&mut Random::new(1), [16, 16]);
    build_volume(&at(shape), &placed, &view, &LensMeshes::default()).expect("a sound shape")
}

fn block(min: f64, max: f64) -> At<Shape> {
    let center = [0.5 * (min + max), 0.0, 0.0];
    at(Shape::Box { center, size: [max - min, 1.0, 1.0], rotation: Rotation::default() })
}

/// Along x through the middle.
fn along_x(shape: Shape) -> Vec<[f64; 2]> {
    let ray = Ray::new(DVec3::ZERO, DVec3::X);
    intervals(&plain(shape), &ray, 0.5, 10.0).iter().map(|i| [i.entry, i.exit]).collect()
}

#[test]
fn parts_that_share_a_face_meet_without_gap_or_sliver() {
    for gap in [0.0, 1e-7, -1e-7] {
        let (left, right) = (block(1.0, 2.0), block(2.0 + gap, 3.0));
        let both = || vec![left.clone(), right.clone()];
        assert_eq!(along_x(Shape::Union(both())), [[1.0, 3.0]], "no boundary inside");
        assert_eq!(along_x(Shape::Intersection(both())), [[0.0; 2]; 0], "no sliver shared");
        assert_eq!(along_x(Shape::Difference(both())).len(), 1, "nothing is taken away but at the face");
        let rest = vec![block(1.0, 3.0), right.clone(), left.clone()];
        assert_eq!(along_x(Shape::Difference(rest)), [[0.0; 2]; 0], "nothing is left between");
    }
    // Negative control: a real gap stays one.
    assert_eq!(along_x(Shape::Union(vec![block(1.0, 2.0), block(2.01, 3.0)])), [[1.0, 2.0], [2.01, 3.0]]);
}

#[test]
fn a_shape_less_itself_is_nothing_and_a_list_of_one_is_that_shape() {
    assert_eq!(along_x(Shape::Difference(vec![block(1.0, 2.0), block(1.0, 2.0)])), [[0.0; 2]; 0]);
    for one in [Shape::Union, Shape::Intersection, Shape::Difference] {
        assert_eq!(along_x(one(vec![block(1.0, 2.0)])), [[1.0, 2.0]]);
    }
}

#[test]
fn the_centre_is_the_mean_of_the_parts_centres() {
    let volume =
        plain(Shape::Union(vec![block(1.0, 2.0), at(Shape::Difference(vec![block(3.0, 5.0), block(6.0, 8.0)]))]));
    // Of the first and of the second, whose own is that of its two.
    let wanted = (1.5 + 0.5 * (4.0 + 7.0)) / 2.0;
    assert!(volume.center.distance(DVec3::X * wanted) < 1e-12, "{}", volume.center);
    assert!(!volume.is_flat() && volume.bounds().max.x == 5.0, "what is taken away does not count");
}
