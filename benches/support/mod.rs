//! What several benchmarks share: a surface of a million triangles, or of another number.

use glam::Vec3;
use lenspeel::scene::{Material, Mesh, Model, Node, Primitive, Transform};

/// Of the surface, unless another number is asked for; it has 1,002,528.
pub const TRIANGLES: usize = 1_000_000;

/// A rolling surface over the unit square, two units wide, of at least so many triangles.
pub fn surface(triangles: usize) -> Model {
    // Quads along each side.
    let side = (0.5 * triangles as f64).sqrt().ceil() as usize;
    let at = move |i: usize, j: usize| {
        let (x, z) = (2.0 * i as f32 / side as f32 - 1.0, 2.0 * j as f32 / side as f32 - 1.0);
        Vec3::new(x, 0.12 * ((9.0 * x).sin() * (7.0 * z).cos()) + 0.02 * (40.0 * x + 31.0 * z).sin(), z)
    };
    let grid = || (0..=side).flat_map(move |j| (0..=side).map(move |i| (i, j)));
    let normal = move |(i, j): (usize, usize)| {
        let (l, r) = (at(i.saturating_sub(1), j), at((i + 1).min(side), j));
        let (n, f) = (at(i, j.saturating_sub(1)), at(i, (j + 1).min(side)));
        (f - n).cross(r - l).normalize()
    };
    let corner = move |i: usize, j: usize| (j * (side + 1) + i) as u32;
    let triangles = (0..side)
        .flat_map(|j| (0..side).map(move |i| (i, j)))
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
    model("surface.glb", primitive)
}

/// A model of one thing that stands where its node's space is the world's.
pub fn model(name: &str, primitive: Primitive) -> Model {
    let node = Node {
        name: "node".into(),
        parent: None,
        children: Vec::new(),
        rest: Transform::IDENTITY,
        world_from_local: glam::DAffine3::IDENTITY,
        mesh: Some(0),
        camera: None,
        light: None,
        drawn: true,
        hidden: false,
    };
    let material =
        Material { base_color: [0.6, 0.62, 0.55, 1.0], metallic: 0.0, roughness: 0.7, ..Material::default() };
    Model {
        name: name.into(),
        nodes: vec![node],
        meshes: vec![Mesh { name: "mesh".into(), primitives: vec![primitive] }],
        materials: vec![material],
        ..Model::default()
    }
}
