//! Rays that only touch a solid, and rays through its sharp places.

use glam::{DAffine3, DVec3};
use lenspeel::lens::{Interval, Placement, Volume};
use lenspeel::spec::{Rotation, Shape};
use lenspeel::view::{Ray, View};

use crate::camera::camera;
use crate::random::Random;
use crate::solid::{KINDS, Solid, build, direction, only_interval, placement};

const CASES: usize = 300;
/// Where nothing is cut off.
const PLANES: (f64, f64) = (-1e6, 1e6);

fn interval(volume: &Volume, ray: &Ray) -> Option<Interval> {
    only_interval(volume, ray, PLANES.0, PLANES.1)
}

/// A direction across a normal.
fn across(normal: DVec3, random: &mut Random) -> DVec3 {
    normal.cross(direction(random)).normalize()
}

#[test]
fn a_line_beside_a_solid_misses_it_and_one_through_it_does_not() {
    let mut random = Random::new(200);
    for kind in KINDS {
        for _ in 0..CASES {
            let view = camera(&mut random, [16, 16]);
            let placed = placement(&mut random, &view);
            let Some(solid) = Solid::new(kind, &mut random, &placed, &view) else { continue };
            let normal = direction(&mut random);
            let (touched, along) = (solid.support(normal), across(normal, &mut random));
            // Without depth a flat lens goes on beyond the end of its mesh.
            if solid.is_flat && touched.length() > 100.0 {
                continue;
            }
            let reach = solid.size + touched.distance(solid.middle);
            let beside = Ray::new(touched + normal * 1e-7 * reach - along * 2.0, along);
            assert_eq!(interval(&solid.volume, &beside), None, "{kind}: {:?}", solid.volume);
            let inner = touched + (solid.middle - touched) * 1e-5;
            let through = Ray::new(inner - along * 2.0, along);
            let Some(found) = interval(&solid.volume, &through) else { panic!("{kind}: {:?}", solid.volume) };
            assert!(found.entry < 2.0 && found.exit > 2.0, "{kind}: {found:?} does not hold depth 2");
        }
    }
}

fn plain(shape: &Shape) -> Volume {
    let view = View {
        eye: DVec3::ZERO,
        right: DVec3::X,
        up: DVec3::Y,
        forward: DVec3::NEG_Z,
        projection: lenspeel::view::Projection::Perspective { tan_half_y: 1.0 },
        anchor: lenspeel::view::Anchor::default(),
        near: 0.1,
        far: 10.0,
        size: [16, 16],
    };
    let placed =
        Placement { attach: DAffine3::IDENTITY, translation: [0.0; 3], rotation: Rotation::default(), scale: [1.0; 3] };
    build(shape, &placed, &view).expect("a sound shape")
}

/// Lines through `sharp` and a point inside have an interval that ends there; rounding must not lose it.
fn ends_at(shape: &Shape, sharp: DVec3, inside: DVec3, random: &mut Random) {
    let volume = plain(shape);
    let direction = (inside - sharp) * random.between(0.5, 2.0);
    let ray = Ray::new(sharp - direction * random.between(0.5, 3.0), direction);
    let depth = (sharp - ray.origin).dot(direction) / direction.length_squared();
    let Some(found) = interval(&volume, &ray) else { panic!("{shape:?}: nothing along {ray:?}") };
    let close = |x: f64| (x - depth).abs() < 1e-6;
    assert!(close(found.entry), "{shape:?}: {found:?} does not begin at {depth} along {ray:?}");
    let back = Ray::new(ray.at(10.0), -direction);
    let Some(found) = interval(&volume, &back) else { panic!("{shape:?}: nothing along {back:?}") };
    assert!((found.exit - (10.0 - depth)).abs() < 1e-6, "{shape:?}: {found:?} along {back:?}");
}

#[test]
fn lines_through_an_apex_keep_their_interval() {
    let mut random = Random::new(201);
    for number in 0..4000 {
        let (from, axis) = (direction(&mut random) * random.between(0.0, 2.0), direction(&mut random));
        let (to, radius) = (from + axis * random.between(0.3, 2.0), random.between(0.2, 1.5));
        let (from_radius, to_radius, apex) = if number % 2 == 0 { (radius, 0.0, to) } else { (0.0, radius, from) };
        let shape = Shape::Cone { from: from.to_array(), to: to.to_array(), from_radius, to_radius };
        let base = if number % 2 == 0 { from } else { to };
        let inside = base + across(axis, &mut random) * radius * random.between(0.0, 0.9);
        ends_at(&shape, apex, inside, &mut random);
    }
}

#[test]
fn lines_through_a_rim_keep_their_interval() {
    let mut random = Random::new(202);
    for _ in 0..4000 {
        let (from, axis) = (direction(&mut random) * random.between(0.0, 2.0), direction(&mut random));
        let (to, radius) = (from + axis * random.between(0.3, 2.0), random.between(0.2, 1.5));
        let other = random.between(0.2, 1.5);
        let shape = Shape::Cone { from: from.to_array(), to: to.to_array(), from_radius: radius, to_radius: other };
        let rim = from + across(axis, &mut random) * radius;
        let inside = from + (to - from) * random.between(0.2, 0.8);
        ends_at(&shape, rim, inside, &mut random);
    }
}

#[test]
fn lines_along_the_axis_and_the_side_of_a_cylinder() {
    let shape = Shape::Cylinder { from: [0.0, 0.0, -1.0], to: [0.0, 0.0, 1.0], radius: 0.5 };
    let volume = plain(&shape);
    for x in [0.0, 0.25, 0.499_999] {
        let ray = Ray::new(DVec3::new(x, 0.0, 5.0), DVec3::NEG_Z);
        let found = interval(&volume, &ray).expect("a line inside, along the axis");
        assert!((found.entry - 4.0).abs() < 1e-12 && (found.exit - 6.0).abs() < 1e-12, "{found:?}");
    }
    let beside = Ray::new(DVec3::new(0.500_001, 0.0, 5.0), DVec3::NEG_Z);
    assert_eq!(interval(&volume, &beside), None);
}

/// A slab across a random normal, of some thickness, with four sides.
fn slab(random: &mut Random, thickness: f64) -> Shape {
    let (normal, center) = (direction(random), direction(random) * random.between(0.0, 3.0));
    let axes = crate::facets::frame(normal);
    let plane = |n: DVec3, reach: f64| [n.x, n.y, n.z, n.dot(center) + reach];
    let (x, y) = (axes.x_axis, axes.y_axis);
    let mut planes: Vec<[f64; 4]> = [x, -x, y, -y].map(|n| plane(n, 1.0)).to_vec();
    planes.extend([normal, -normal].map(|n| plane(n, 0.5 * thickness)));
    Shape::Polytope { planes }
}

#[test]
fn a_polytope_without_thickness_is_refused_however_it_lies() {
    let mut random = Random::new(203);
    let built = |shape: &Shape| {
        let view = camera(&mut Random::new(1), [16, 16]);
        let placed = Placement {
            attach: DAffine3::IDENTITY,
            translation: [0.0; 3],
            rotation: Rotation::default(),
            scale: [1.0; 3],
        };
        build(shape, &placed, &view)
    };
    for _ in 0..CASES {
        assert!(built(&slab(&mut random, 1e-3)).is_ok());
        for thickness in [0.0, -1e-3] {
            let shape = slab(&mut random, thickness);
            assert!(built(&shape).is_err(), "{shape:?} has a volume");
        }
    }
}
