//! What several benchmarks share: a surface of a million triangles, and lenses over it.

use std::path::Path;

use glam::Vec3;
use lenspeel::scene::{Material, Mesh, Model, Node, Primitive, Transform};
use lenspeel::spec::Spec;

/// Quads along each side of the surface: 2 * 708^2 = 1,002,528 triangles.
const SIDE: usize = 708;

/// One sphere that covers 10.2 % of the picture, or several that overlap in a ring.
pub fn spec(lenses: usize, filters: &str) -> Spec {
    let mut text = String::from(
        "[scene]\nfile = \"surface.glb\"\n[camera]\neye = [0, 1.5, 2.2]\ntarget = [0, 0, 0]\n[image]\nsize = [1280, 720]\nsamples = 1\n",
    );
    for i in 0..lenses {
        let angle = std::f64::consts::TAU * i as f64 / lenses as f64;
        let (x, z, radius) = if lenses == 1 { (0.0, 0.0, 0.52) } else { (0.45 * angle.cos(), 0.35 * angle.sin(), 0.4) };
        text += &format!(
            "[[lens]]\nname = \"l{i}\"\npriority = {i}\nglass = false\nfilters = [{filters}]\n\
             shape.sphere = {{ center = [{x:.4}, 0, {z:.4}], radius = {radius} }}\n"
        );
    }
    Spec::parse(&text, "bench.toml", Path::new("")).expect("the specs of the benchmark are valid")
}

/// A rolling surface over the unit square, two units wide.
pub fn surface() -> Model {
    let at = |i: usize, j: usize| {
        let (x, z) = (2.0 * i as f32 / SIDE as f32 - 1.0, 2.0 * j as f32 / SIDE as f32 - 1.0);
        Vec3::new(x, 0.12 * ((9.0 * x).sin() * (7.0 * z).cos()) + 0.02 * (40.0 * x + 31.0 * z).sin(), z)
    };
    let grid = || (0..=SIDE).flat_map(|j| (0..=SIDE).map(move |i| (i, j)));
    let normal = |(i, j): (usize, usize)| {
        let (l, r) = (at(i.saturating_sub(1), j), at((i + 1).min(SIDE), j));
        let (n, f) = (at(i, j.saturating_sub(1)), at(i, (j + 1).min(SIDE)));
        (f - n).cross(r - l).normalize()
    };
    let corner = |i: usize, j: usize| (j * (SIDE + 1) + i) as u32;
    let triangles = (0..SIDE)
        .flat_map(|j| (0..SIDE).map(move |i| (i, j)))
        .flat_map(|(i, j)| {
            let [a, b, c, d] = [corner(i, j), corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1)];
            [[a, d, c], [a, c, b]]
        })
        .collect();
    let primitive = Primitive {
        positions: grid().map(|(i, j)| at(i, j)).collect(),
        normals: Some(grid().map(normal).collect()),
        triangles,
        ..Primitive::default()
    };
    let node = Node {
        name: "surface".into(),
        parent: None,
        children: Vec::new(),
        rest: Transform::IDENTITY,
        world_from_local: glam::DAffine3::IDENTITY,
        mesh: Some(0),
        camera: None,
        light: None,
        drawn: true,
    };
    let material =
        Material { base_color: [0.6, 0.62, 0.55, 1.0], metallic: 0.0, roughness: 0.7, ..Material::default() };
    Model {
        name: "surface.glb".into(),
        nodes: vec![node],
        meshes: vec![Mesh { name: "surface".into(), primitives: vec![primitive] }],
        materials: vec![material],
        ..Model::default()
    }
}
