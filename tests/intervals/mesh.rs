//! Mesh solids against the solids that they stand for, and rays through their edges and corners.

use std::f64::consts::TAU;
use std::path::PathBuf;

use glam::{DAffine3, DVec3};
use lenspeel::lens::{Interval, LensMeshes, MeshForm, Placement, Volume, build_volume};
use lenspeel::scene::{Mesh, Model, Node, Primitive};
use lenspeel::spec::{At, Convex, MeshShape, Rotation, Shape};
use lenspeel::view::Ray;

use crate::camera::camera;
use crate::facets::{Triangle, lathe};
use crate::random::Random;
use crate::solid::{build, direction, placement};

const RAYS: usize = 4000;

/// A file of one node with loose triangles: corners that coincide must be found to be one.
fn model(triangles: &[Triangle]) -> Model {
    let positions = triangles.iter().flatten().map(|p| p.as_vec3()).collect();
    let indices = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let primitive = Primitive { positions, triangles: indices, ..Primitive::default() };
    let node = Node {
        name: "solid".into(),
        parent: None,
        children: Vec::new(),
        world_from_local: DAffine3::IDENTITY,
        mesh: Some(0),
        camera: None,
        light: None,
        drawn: true,
    };
    let mesh = Mesh { name: "solid".into(), primitives: vec![primitive] };
    Model { name: "test.glb".into(), nodes: vec![node], meshes: vec![mesh], ..Model::default() }
}

fn placed(triangles: &[Triangle], convex: Convex, placement: &Placement) -> Volume {
    let mesh = MeshShape { file: At::new(PathBuf::from("test.glb"), 0..0), node: None, convex };
    let mut meshes = LensMeshes::default();
    meshes.insert(&mesh, MeshForm::new(&model(triangles), None, convex).unwrap_or_else(|e| panic!("{e}")));
    let view = camera(&mut Random::new(1), [16, 16]);
    build_volume(&At::new(Shape::Mesh(mesh), 0..0), placement, &view, &meshes).unwrap_or_else(|e| panic!("{}", e.value))
}

fn unmoved() -> Placement {
    Placement { attach: DAffine3::IDENTITY, translation: [0.0; 3], rotation: Rotation::default(), scale: [1.0; 3] }
}

fn intervals(volume: &Volume, ray: &Ray, near: f64, far: f64) -> Vec<Interval> {
    let mut found = Vec::new();
    volume.intervals(ray, near, far, &mut found);
    found
}

fn f32_exact(p: DVec3) -> DVec3 {
    p.as_vec3().as_dvec3()
}

fn cube() -> Vec<Triangle> {
    let corner = |i: usize| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2 & 1) as f64) * 2.0 - 1.0;
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|t| t.map(corner)).collect()
}

/// About z, of radii 0.7 and 0.25.
fn torus() -> Vec<Triangle> {
    let (around, across) = (160, 80);
    let at = |i: usize, j: usize| {
        let [a, b] = [(i % around) as f64 / around as f64, (j % across) as f64 / across as f64].map(|t| t * TAU);
        let radius = 0.7 + 0.25 * b.cos();
        f32_exact(DVec3::new(radius * a.cos(), radius * a.sin(), 0.25 * b.sin()))
    };
    let quads = (0..around * across).map(|n| (n / across, n % across));
    quads
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
            [[a, b, c], [a, c, d]]
        })
        .collect()
}

/// The lower half of a ball of radius 0.8 less one of radius 0.6.
fn bowl() -> Vec<Triangle> {
    let quarter = |radius: f64| {
        (0..=40).map(move |i| {
            let angle = 0.25 * TAU * f64::from(i) / 40.0;
            (radius * angle.sin(), -radius * angle.cos())
        })
    };
    let inner: Vec<(f64, f64)> = quarter(0.6).collect();
    let mut profile: Vec<(f64, f64)> = quarter(0.8).chain(inner.into_iter().rev()).collect();
    profile.iter_mut().for_each(|p| {
        if p.0.abs() < 1e-9 {
            p.0 = 0.0
        }
    });
    lathe(&profile).into_iter().map(|t| t.map(f32_exact)).collect()
}

/// How far outside of the solid that is meant a point lies, in the mesh's own space.
type Outside = fn(DVec3) -> f64;

fn outside_torus(p: DVec3) -> f64 {
    (p.truncate().length() - 0.7).hypot(p.z) - 0.25
}

fn outside_bowl(p: DVec3) -> f64 {
    (p.length() - 0.8).max(0.6 - p.length()).max(p.z)
}

/// Samples of a ray where the meant solid is clear: farther from its surface than facets deviate.
fn check(volume: &Volume, outside: Outside, own: &DAffine3, ray: &Ray, found: &[Interval]) -> Result<usize, String> {
    let mut clear = 0;
    for step in 0..80 {
        let depth = -2.0 + 8.0 * (f64::from(step) + 0.5) / 80.0;
        let outside = outside(own.transform_point3(ray.at(depth)));
        if outside.abs() < 3e-3 {
            continue;
        }
        clear += 1;
        let inside = found.iter().any(|i| i.entry <= depth && depth < i.exit);
        if inside != (outside < 0.0) || volume.contains(ray.at(depth)) != inside {
            return Err(format!("{outside} outside at {depth} of {found:?}"));
        }
    }
    Ok(clear)
}

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
            let ray = Ray { origin: aim - direction * random.between(0.0, 3.0), direction };
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
        let ray = Ray { origin: direction * -2.0 + DVec3::new(0.7, 0.0, 0.0), direction };
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
        let ray = Ray { origin: aim - direction * 3.0, direction };
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
        let ray = Ray { origin: from, direction: (to - from).normalize_or(DVec3::X) };
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
        let ray = Ray { origin: through - direction * 2.0, direction };
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
        let ray = Ray { origin: DVec3::new(0.6, 0.3, 0.0) - direction * 2.0, direction };
        let [found, same] = [&one, &other].map(|volume| intervals(volume, &ray, 0.0, 6.0));
        let equal = |(a, b): (&Interval, &Interval)| (a.entry - b.entry).abs().max((a.exit - b.exit).abs()) < 1e-12;
        assert!(found.len() == same.len() && found.iter().zip(&same).all(equal), "{found:?} and {same:?}");
    }
}

fn refusal(triangles: &[Triangle], convex: Convex) -> String {
    MeshForm::new(&model(triangles), None, convex).map(drop).expect_err("this mesh must be refused").to_string()
}

#[test]
fn an_open_mesh_and_one_that_is_not_convex_are_refused() {
    let mut open = cube();
    open.pop();
    for convex in [Convex::AsItStands, Convex::Decompose] {
        assert!(refusal(&open, convex).contains("3 of its 18 edges have an odd number"), "{}", refusal(&open, convex));
    }
    assert!(MeshForm::new(&model(&open), None, Convex::Hull).is_ok(), "a hull needs only the corners");
    for solid in [torus(), bowl()] {
        assert!(refusal(&solid, Convex::AsItStands).contains("is not convex"));
    }
    let apart = |t: Triangle| t.map(|p| p + DVec3::X * 3.0);
    let two: Vec<Triangle> = cube().into_iter().chain(cube().into_iter().map(apart)).collect();
    assert!(refusal(&two, Convex::AsItStands).contains("lies 1.000 inside its convex hull"), "the inner faces");
    // A roof over one face of the cube, and the same pushed in.
    let capped = |height: f64| -> Vec<Triangle> {
        let [top, rest]: [Vec<Triangle>; 2] =
            [true, false].map(|at_top| cube().into_iter().filter(|t| t.iter().all(|p| p.z == 1.0) == at_top).collect());
        let [a, b, c, d] = [top[0][0], top[0][1], top[0][2], top[1][2]];
        let tip = DVec3::Z * (1.0 + height);
        rest.into_iter().chain([[a, b, tip], [b, c, tip], [c, d, tip], [d, a, tip]]).collect()
    };
    assert!(MeshForm::new(&model(&capped(0.5)), None, Convex::AsItStands).is_ok());
    assert!(MeshForm::new(&model(&capped(-1e-4)), None, Convex::AsItStands).is_ok(), "less than a ten-thousandth");
    assert!(refusal(&capped(-1e-3), Convex::AsItStands).contains("at (0, 0, 0.999) its surface lies 0.001 inside"));
    assert!(refusal(&[], Convex::Hull).contains("no triangles"));
}

#[test]
fn two_cubes_that_touch_are_one_solid() {
    let shifted = |by: DVec3| cube().into_iter().map(move |t| t.map(|p| p + by));
    let ray = Ray { origin: DVec3::new(-5.0, 0.3, 0.1), direction: DVec3::X };
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
