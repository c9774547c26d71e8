//! Closed meshes for lenses: one convex, some with notches, holes or two parts.

use std::f64::consts::TAU;

use glam::{DQuat, DVec3};

use super::scene::{cuboid, quad};
use super::single;
use crate::case::{Material, Model, Node, Primitive};
use crate::random::Random;

/// One of each kind, sized at random.
pub fn solids(random: &mut Random) -> Vec<Model> {
    let size = DVec3::from_array(std::array::from_fn(|_| random.between(0.4, 0.8)));
    let mut apart = model("apart", vec![node(size * 0.5), node(size * 0.4)]);
    apart.nodes[1].translation = single(DVec3::X * (0.95 * size.x + 0.1));
    vec![
        model("gem", vec![mesh(octahedron(size))]),
        model("ell", vec![mesh(prism(&ell(), size))]),
        model("star", vec![mesh(prism(&star(), size))]),
        model("ring", vec![mesh(ring(size))]),
        apart,
    ]
}

fn model(name: &str, nodes: Vec<Node>) -> Model {
    let material = Material { name: "plain".into(), color: [1.0; 4], unlit: true, double_sided: false };
    let named = |(i, node): (usize, Node)| Node { name: format!("part-{i}"), ..node };
    Model { name: name.into(), nodes: nodes.into_iter().enumerate().map(named).collect(), materials: vec![material] }
}

fn node(half: DVec3) -> Node {
    mesh(cuboid(half))
}

fn mesh(triangles: Vec<[DVec3; 3]>) -> Node {
    let triangles = triangles.into_iter().map(|t| t.map(single)).collect();
    Node {
        name: String::new(),
        parent: None,
        translation: DVec3::ZERO,
        rotation: DQuat::IDENTITY,
        scale: DVec3::ONE,
        primitives: vec![Primitive { material: 0, triangles }],
    }
}

fn octahedron(size: DVec3) -> Vec<[DVec3; 3]> {
    let corner = |axis: usize, sign: f64| DVec3::AXES[axis] * sign * size;
    let signs = (0..8).map(|i| [0, 1, 2].map(|bit| if i >> bit & 1 == 1 { 1.0 } else { -1.0 }));
    let face = |[x, y, z]: [f64; 3]| {
        let [a, b, c] = [corner(0, x), corner(1, y), corner(2, z)];
        if x * y * z > 0.0 { [a, b, c] } else { [a, c, b] }
    };
    signs.map(face).collect()
}

/// An L, as a ring of corners; every corner can be seen from the first.
fn ell() -> Vec<[f64; 2]> {
    vec![[-0.2, -0.2], [-0.2, 1.0], [-1.0, 1.0], [-1.0, -1.0], [1.0, -1.0], [1.0, -0.2]]
}

/// A star about the origin with five points.
fn star() -> Vec<[f64; 2]> {
    let corner = |i: usize| {
        let (angle, radius) = (TAU * i as f64 / 10.0, if i.is_multiple_of(2) { 1.0 } else { 0.45 });
        [radius * angle.cos(), radius * angle.sin()]
    };
    (0..10).map(corner).collect()
}

/// A polygon drawn out along z. Its caps are fans about the first corner, or about the origin for a star.
fn prism(polygon: &[[f64; 2]], size: DVec3) -> Vec<[DVec3; 3]> {
    let at = |i: usize, z: f64| {
        let [x, y] = polygon[i % polygon.len()];
        DVec3::new(x, y, z) * size
    };
    let count = polygon.len();
    let mut triangles = Vec::new();
    for i in 0..count {
        triangles.extend(quad([at(i, -1.0), at(i + 1, -1.0), at(i + 1, 1.0), at(i, 1.0)]));
        for z in [-1.0, 1.0] {
            let hub = if count == 10 { DVec3::Z * z * size } else { at(0, z) };
            let [a, b] = if z > 0.0 { [at(i, z), at(i + 1, z)] } else { [at(i + 1, z), at(i, z)] };
            triangles.push([hub, a, b]);
        }
    }
    triangles.retain(|[a, b, c]| (*b - *a).cross(*c - *a).length() > 1e-9);
    triangles
}

/// A torus of few facets around z.
fn ring(size: DVec3) -> Vec<[DVec3; 3]> {
    const AROUND: usize = 7;
    const ACROSS: usize = 4;
    let at = |i: usize, j: usize| {
        let (turn, roll) = (TAU * (i % AROUND) as f64 / AROUND as f64, TAU * (j % ACROSS) as f64 / ACROSS as f64);
        let radius = 1.0 + 0.4 * roll.cos();
        DVec3::new(radius * turn.cos(), radius * turn.sin(), 0.4 * roll.sin()) * size
    };
    let faces = (0..AROUND).flat_map(|i| (0..ACROSS).map(move |j| (i, j)));
    faces.flat_map(|(i, j)| quad([at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)])).collect()
}
