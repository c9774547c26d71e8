//! Small scenes: boxes, balls and panes in a tree of nodes, and alternates of the same kind.

use std::f64::consts::{PI, TAU};

use glam::{DQuat, DVec3};

use super::{direction, pick, point, single};
use crate::case::{Material, Model, Node, Primitive};
use crate::random::Random;

/// Names that patterns in a case may use, with some wildcards.
pub const NODE_PATTERNS: [&str; 10] = ["box*", "ball*", "pane*", "*-1", "*-2", "group-0", "box-?", "bone*", "b*", "*"];
pub const MATERIAL_PATTERNS: [&str; 5] = ["red", "blue", "*e*", "glass*", "pale"];
const MATERIALS: [&str; 5] = ["red", "blue", "green", "glass-1", "pale"];

/// The scene and up to two alternates.
pub fn models(random: &mut Random) -> Vec<Model> {
    let parts = 3 + random.index(4);
    let scene = model("scene", ["box", "ball", "pane"], parts, random);
    let alternates = random.index(3);
    let alternate = |i: usize, random: &mut Random| {
        let parts = 1 + random.index(3);
        model(["bones", "flesh"][i], ["bone", "ball", "pane"], parts, random)
    };
    std::iter::once(scene).chain((0..alternates).map(|i| alternate(i, random)).collect::<Vec<_>>()).collect()
}

pub fn hidden(random: &mut Random) -> Vec<String> {
    if random.chance(0.2) { vec![pick(random, &["*-2", "pane*", "group-0", "box-0"]).to_string()] } else { Vec::new() }
}

fn model(name: &str, kinds: [&str; 3], parts: usize, random: &mut Random) -> Model {
    let materials = MATERIALS.iter().map(|name| material(name, random)).collect();
    let mut model = Model { name: name.to_owned(), nodes: Vec::new(), materials };
    for i in 0..random.index(2) {
        let mut group = node(format!("group-{i}"), random);
        group.primitives.clear();
        model.nodes.push(group);
    }
    for i in 0..parts {
        let kind = random.index(3);
        let mut node = node(format!("{}-{i}", kinds[kind]), random);
        node.parent = (!model.nodes.is_empty() && random.chance(0.4)).then(|| random.index(model.nodes.len()));
        node.primitives = primitives(kind, random);
        model.nodes.push(node);
    }
    model
}

fn node(name: String, random: &mut Random) -> Node {
    let size = |random: &mut Random| random.between(0.6, 1.5) * if random.chance(0.1) { -1.0 } else { 1.0 };
    let scale = if random.chance(0.3) { DVec3::new(size(random), size(random), size(random)) } else { DVec3::ONE };
    let turn = DQuat::from_axis_angle(direction(random), random.between(0.0, TAU));
    Node {
        name,
        parent: None,
        translation: single(point(random, 0.7)),
        rotation: if random.chance(0.6) { turn.as_quat().as_dquat() } else { DQuat::IDENTITY },
        scale: single(scale),
        primitives: Vec::new(),
    }
}

/// Of a box, a ball or a pane, in one or two primitives.
fn primitives(kind: usize, random: &mut Random) -> Vec<Primitive> {
    let size = DVec3::new(random.between(0.3, 0.9), random.between(0.3, 0.9), random.between(0.3, 0.9));
    let triangles = match kind {
        0 => cuboid(size),
        1 => ball(size),
        _ => quad([
            DVec3::new(-1.0, -1.0, 0.0),
            DVec3::new(1.0, -1.0, 0.0),
            DVec3::ONE.with_z(0.0),
            DVec3::new(-1.0, 1.0, 0.0),
        ])
        .map(|t| t.map(|p| p * 1.5 * size))
        .to_vec(),
    };
    let triangles: Vec<_> = triangles.into_iter().map(|t| t.map(single)).collect();
    let cut = if random.chance(0.3) { triangles.len() / 2 } else { 0 };
    let (first, rest) = triangles.split_at(cut);
    let parts = [first, rest].into_iter().filter(|part| !part.is_empty());
    parts.map(|part| Primitive { material: random.index(MATERIALS.len()), triangles: part.to_vec() }).collect()
}

fn material(name: &str, random: &mut Random) -> Material {
    let alpha = if name.starts_with("glass") || random.chance(0.15) { random.between(0.2, 0.8) } else { 1.0 };
    let channel = |random: &mut Random| f64::from(random.between(0.0, 1.0) as f32);
    Material {
        name: name.to_owned(),
        color: [channel(random), channel(random), channel(random), f64::from(alpha as f32)],
        unlit: random.chance(0.85),
        double_sided: random.chance(0.5),
    }
}

/// Half of a box's sides are `half`.
pub fn cuboid(half: DVec3) -> Vec<[DVec3; 3]> {
    let face = |axis: usize, sign: f64| {
        let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
        let corner = |a: f64, b: f64| {
            let mut p = DVec3::ZERO;
            (p[axis], p[u], p[v]) = (sign, a * sign, b);
            p * half
        };
        quad([corner(-1.0, -1.0), corner(1.0, -1.0), corner(1.0, 1.0), corner(-1.0, 1.0)])
    };
    (0..3).flat_map(|axis| [face(axis, 1.0), face(axis, -1.0)].concat()).collect()
}

pub fn quad([a, b, c, d]: [DVec3; 4]) -> [[DVec3; 3]; 2] {
    [[a, b, c], [a, c, d]]
}

/// A coarse ball about the origin.
fn ball(radii: DVec3) -> Vec<[DVec3; 3]> {
    const AROUND: usize = 6;
    let at = |row: usize, step: usize| {
        let (polar, turn) = (PI * row as f64 / 4.0, TAU * (step % AROUND) as f64 / AROUND as f64);
        DVec3::new(polar.sin() * turn.cos(), polar.sin() * turn.sin(), polar.cos()) * radii
    };
    let mut triangles = Vec::new();
    for step in 0..AROUND {
        let (north, south) = (DVec3::Z * radii, DVec3::NEG_Z * radii);
        triangles.push([north, at(1, step), at(1, step + 1)]);
        triangles.extend(
            (1..3).flat_map(|row| quad([at(row, step), at(row + 1, step), at(row + 1, step + 1), at(row, step + 1)])),
        );
        triangles.push([at(3, step), south, at(3, step + 1)]);
    }
    triangles
}
