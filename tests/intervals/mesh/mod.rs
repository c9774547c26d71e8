//! Mesh solids, and what they stand for.

mod agreement;
mod edges;
mod refusals;

use std::f64::consts::TAU;
use std::path::PathBuf;

use glam::{DAffine3, DVec3};
use lenspeel::lens::{Interval, LensMeshes, MeshForm, Placement, Volume, build_volume};
use lenspeel::scene::{Mesh, Model, Node, Primitive, Transform};
use lenspeel::spec::{At, Convex, MeshShape, Rotation, Shape};
use lenspeel::view::Ray;

use crate::camera::camera;
use crate::facets::{Triangle, lathe};
use crate::random::Random;

/// A file of one node with loose triangles: corners that coincide must be found to be one.
pub fn model(triangles: &[Triangle]) -> Model {
    let positions = triangles.iter().flatten().map(|p| p.as_vec3()).collect();
    let indices = (0..triangles.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
    let primitive = Primitive { positions, triangles: indices, ..Primitive::default() };
    let node = Node {
        name: "solid".into(),
        parent: None,
        children: Vec::new(),
        rest: Transform::IDENTITY,
        world_from_local: DAffine3::IDENTITY,
        mesh: Some(0),
        camera: None,
        light: None,
        drawn: true,
        hidden: false,
    };
    let mesh = Mesh { name: "solid".into(), primitives: vec![primitive] };
    Model { name: "test.glb".into(), nodes: vec![node], meshes: vec![mesh], ..Model::default() }
}

pub fn placed(triangles: &[Triangle], convex: Convex, placement: &Placement) -> Volume {
    let mesh = MeshShape { file: At::new(PathBuf::from("test.glb"), 0..0), node: None, convex };
    let mut meshes = LensMeshes::default();
    meshes.insert(&mesh, MeshForm::new(&model(triangles), None, convex).unwrap_or_else(|e| panic!("{e}")));
    let view = camera(&mut Random::new(1), [16, 16]);
    build_volume(&At::new(Shape::Mesh(mesh), 0..0), placement, &view, &meshes).unwrap_or_else(|e| panic!("{}", e.value))
}

pub fn unmoved() -> Placement {
    Placement { attach: DAffine3::IDENTITY, translation: [0.0; 3], rotation: Rotation::default(), scale: [1.0; 3] }
}

pub fn intervals(volume: &Volume, ray: &Ray, near: f64, far: f64) -> Vec<Interval> {
    let mut found = Vec::new();
    volume.intervals(ray, near, far, &mut found);
    found
}

fn f32_exact(p: DVec3) -> DVec3 {
    p.as_vec3().as_dvec3()
}

pub fn cube() -> Vec<Triangle> {
    let corner = |i: usize| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2 & 1) as f64) * 2.0 - 1.0;
    let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
    faces.iter().flat_map(|[a, b, c, d]| [[*a, *b, *c], [*a, *c, *d]]).map(|t| t.map(corner)).collect()
}

/// About z, of radii 0.7 and 0.25.
pub fn torus() -> Vec<Triangle> {
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
pub fn bowl() -> Vec<Triangle> {
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
pub type Outside = fn(DVec3) -> f64;

pub fn outside_torus(p: DVec3) -> f64 {
    (p.truncate().length() - 0.7).hypot(p.z) - 0.25
}

pub fn outside_bowl(p: DVec3) -> f64 {
    (p.length() - 0.8).max(0.6 - p.length()).max(p.z)
}

/// Samples of a ray where the meant solid is clear: farther from its surface than facets deviate.
pub fn check(
    volume: &Volume,
    outside: Outside,
    own: &DAffine3,
    ray: &Ray,
    found: &[Interval],
) -> Result<usize, String> {
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
