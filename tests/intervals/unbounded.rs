//! Half-spaces and slabs, which have no bounds: their intervals, boxes and pixels against the planes themselves.

use glam::DVec3;
use lenspeel::lens::{Placement, Volume};
use lenspeel::scene::Aabb;
use lenspeel::spec::{At, Shape};
use lenspeel::view::View;

use crate::camera::camera;
use crate::random::Random;
use crate::solid::{build, direction, placement};

const CASES: usize = 300;
const RAYS: usize = 40;

/// Random numbers in a cube about the origin.
fn point(random: &mut Random, reach: f64) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|_| random.between(-reach, reach)))
}

/// A shape with its volume, and what it means: heights over its planes in the space of the shape.
struct Stage {
    view: View,
    volume: Volume,
    placement: Placement,
    point: DVec3,
    normal: DVec3,
    thickness: Option<f64>,
}

impl Stage {
    fn new(random: &mut Random) -> Self {
        let mut view = camera(random, [22, 18]);
        view.near = if view.is_perspective() { random.between(0.01, 1.0) } else { random.between(-3.0, 0.0) };
        view.far = view.near + random.between(0.5, 20.0);
        let placement = placement(random, &view);
        let (point, normal) = (point(random, 1.0), direction(random) * random.between(0.1, 10.0));
        let thickness = random.chance(0.5).then(|| random.between(0.05, 2.0));
        let shape = match thickness {
            None => Shape::HalfSpace { point: point.to_array(), normal: normal.to_array() },
            Some(thickness) => Shape::Slab { point: point.to_array(), normal: normal.to_array(), thickness },
        };
        let volume = build(&shape, &placement, &view).expect("it has a volume");
        Self { view, volume, placement, point, normal, thickness }
    }

    /// Whether a world point is inside; `None` where rounding may decide.
    fn holds(&self, p: DVec3) -> Option<bool> {
        let shape = self.placement.world_from_shape().inverse().transform_point3(p);
        let height = self.normal.normalize().dot(shape - self.point);
        let outside = self.thickness.map_or(height, |thickness| height.abs() - 0.5 * thickness);
        (outside.abs() > 1e-9).then_some(outside < 0.0)
    }
}

#[test]
fn rays_are_inside_where_they_lie_within_the_planes() {
    let mut random = Random::new(1300);
    let (mut inside, mut outside) = (0, 0);
    for _ in 0..CASES {
        let stage = Stage::new(&mut random);
        let View { near, far, .. } = stage.view;
        for _ in 0..RAYS {
            let ray = stage.view.ray(random.between(0.0, 22.0), random.between(0.0, 18.0));
            let mut intervals = Vec::new();
            stage.volume.intervals(&ray, near, far, &mut intervals);
            assert!(
                intervals.len() <= 1 && intervals.iter().all(|i| near <= i.entry && i.entry < i.exit && i.exit <= far)
            );
            let depth = random.between(near, far);
            let Some(holds) = stage.holds(ray.at(depth)) else { continue };
            assert_eq!(intervals.iter().any(|i| (i.entry..i.exit).contains(&depth)), holds, "{:?}", stage.volume);
            assert_eq!(stage.volume.contains(ray.at(depth)), holds);
            if holds { inside += 1 } else { outside += 1 }
        }
    }
    assert!(inside > 1000 && outside > 1000, "{inside} inside, {outside} outside");
}

#[test]
fn every_pixel_with_an_interval_is_in_the_rectangle() {
    let mut random = Random::new(1301);
    let (mut smaller, mut empty) = (0, 0);
    for _ in 0..CASES {
        let stage = Stage::new(&mut random);
        let rect = stage.volume.pixel_rect(&stage.view);
        let mut seen = false;
        for (x, y) in (0..18).flat_map(|y| (0..22).map(move |x| (x, y))) {
            let at = |p: u32, random: &mut Random| f64::from(p) + random.between(0.0, 1.0);
            let ray = stage.view.ray(at(x, &mut random), at(y, &mut random));
            let mut intervals = Vec::new();
            stage.volume.intervals(&ray, stage.view.near, stage.view.far, &mut intervals);
            let held = (rect.min[0]..rect.max[0]).contains(&x) && (rect.min[1]..rect.max[1]).contains(&y);
            assert!(intervals.is_empty() || held, "{x},{y} is not in {rect:?}");
            seen |= !intervals.is_empty();
        }
        smaller += usize::from(seen && rect.area() < 22 * 18);
        empty += usize::from(rect.is_empty());
    }
    assert!(smaller > CASES / 20 && empty > CASES / 20, "{smaller} smaller, {empty} empty");
}

#[test]
fn boxes_are_held_or_apart_at_every_corner() {
    let mut random = Random::new(1302);
    let mut counts = [0; 3];
    for _ in 0..CASES {
        let stage = Stage::new(&mut random);
        assert_eq!(stage.volume.bounds(), Aabb::EVERYWHERE);
        for _ in 0..10 {
            let center = stage.volume.center + point(&mut random, 2.0);
            let half = point(&mut random, 0.4).abs();
            let bounds = Aabb { min: center - half, max: center + half };
            let said = stage.volume.holds_box(&bounds);
            let wrong = |p: &DVec3| said.is_some_and(|said| stage.holds(*p).is_some_and(|holds| holds != said));
            assert!(!bounds.corners().iter().any(wrong), "{said:?} of {bounds:?}");
            counts[said.map_or(2, usize::from)] += 1;
        }
    }
    assert!(counts.iter().all(|count| *count > 100), "{counts:?}");
}

#[test]
fn they_reach_no_end_of_the_view_and_their_centre_is_their_point() {
    let mut random = Random::new(1303);
    for _ in 0..CASES {
        let stage = Stage::new(&mut random);
        assert_eq!(stage.volume.hull().count(), 0);
        let center = stage.placement.world_from_shape().transform_point3(stage.point);
        assert!(stage.volume.center.distance(center) < 1e-9 * center.length().max(1.0));
    }
}

#[test]
fn what_goes_on_like_a_half_space_is_known() {
    let at = |shape| At::new(shape, 0..0);
    let half = || at(Shape::HalfSpace { point: [0.0; 3], normal: [0.0, 1.0, 0.0] });
    let ball = || at(Shape::Sphere { center: [0.0; 3], radius: 1.0 });
    for (shape, goes_on) in [
        (Shape::Union(vec![ball(), half()]), true),
        (Shape::Intersection(vec![ball(), half()]), false),
        (Shape::Intersection(vec![half(), half()]), true),
        (Shape::Difference(vec![half(), ball()]), true),
        (Shape::Difference(vec![ball(), half()]), false),
        (Shape::Slab { point: [0.0; 3], normal: [0.0, 1.0, 0.0], thickness: 1.0 }, false),
    ] {
        assert_eq!(shape.is_half_space(), goes_on, "{shape:?}");
    }
}
