//! Solids made in code: balls and boxes, whole, turned inside out, or with a hole.

use glam::{DAffine3, DVec3, Vec3};
use lenspeel::lens::MeshForm;
use lenspeel::plan::Plan;
use lenspeel::scene::{Material, Mesh, Model, Node, Primitive, Scene, Transform};
use lenspeel::spec::{Shape, Spec};

use crate::open::Opened;

/// Names of the materials that there are; a primitive has the first if nothing else is said.
const MATERIALS: [&str; 2] = ["first", "second"];

/// A node with the primitives of its mesh.
pub type Part = (&'static str, Vec<Primitive>);

/// The node that lenses may take for their shape; it is not drawn.
pub const LENS: &str = "lens";

/// A scene of such nodes, and a plan over it of a square picture with a camera and lenses (TOML).
pub fn planned(parts: Vec<Part>, side: u32, camera: &str, lenses: &str) -> Opened {
    let text = format!(
        "[scene]\nfile = \"made-in-code.glb\"\n[camera]\n{camera}\n[image]\nsize = [{side}, {side}]\nsamples = 1\n{lenses}"
    );
    let spec = Spec::parse(&text, "spec.toml", "".as_ref()).expect("the test's spec is right");
    let mut model = Model { name: "made in code".into(), ..Model::default() };
    model.materials = MATERIALS.map(|name| Material { name: name.into(), ..Material::default() }).to_vec();
    for (name, primitives) in parts {
        model.nodes.push(Node {
            name: name.into(),
            parent: None,
            children: vec![],
            rest: Transform::Matrix(DAffine3::IDENTITY),
            world_from_local: DAffine3::IDENTITY,
            mesh: Some(model.meshes.len()),
            camera: None,
            light: None,
            drawn: name != LENS,
            hidden: false,
        });
        model.meshes.push(Mesh { name: name.into(), primitives });
    }
    let mut scene = Scene::new(vec![model], vec![]);
    for shape in spec.lenses.iter().flat_map(|lens| lens.shape.parts()) {
        if let Shape::Mesh(mesh) = &shape.value {
            let model = &scene.models[0];
            let node = model.nodes.iter().position(|node| node.name == LENS);
            let form = MeshForm::new(model, node, mesh.convex).expect("the test's mesh is closed");
            scene.lens_meshes.insert(mesh, form);
        }
    }
    let plan = Plan::new(&spec, &scene).expect("the test's plan is right");
    Opened { scene, plan }
}

/// A ball about the origin, of so many meridians and half as many parallels.
pub fn ball(radius: f64, meridians: u32) -> Primitive {
    let parallels = meridians / 2;
    let at = |i: u32, j: u32| {
        let (u, v) = (f64::from(i % meridians) / f64::from(meridians), f64::from(j) / f64::from(parallels));
        let (along, down) = ((u * std::f64::consts::TAU).sin_cos(), (v * std::f64::consts::PI).sin_cos());
        // The poles are one place each.
        let width = if j == 0 || j == parallels { 0.0 } else { down.0 };
        (radius * DVec3::new(width * along.1, down.1, width * along.0)).as_vec3()
    };
    let mut ball = Primitive::default();
    for (i, j) in (0..meridians).flat_map(|i| (0..parallels).map(move |j| (i, j))) {
        let [a, b, c, d] = [at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)];
        [[a, b, c], [a, c, d]].iter().for_each(|triangle| push(&mut ball, triangle));
    }
    ball
}

/// A box about a point, of so much to each side.
pub fn cuboid(center: Vec3, half: Vec3) -> Primitive {
    let mut cuboid = Primitive::default();
    for axis in 0..3 {
        for sign in [-1.0, 1.0] {
            let (mut out, mut u, mut v) = (Vec3::ZERO, Vec3::ZERO, Vec3::ZERO);
            (out[axis], u[(axis + 1) % 3], v[(axis + 2) % 3]) = (sign, sign, 1.0);
            let at = |a: f32, b: f32| center + half * (out + u * a + v * b);
            let [a, b, c, d] = [at(-1.0, -1.0), at(1.0, -1.0), at(1.0, 1.0), at(-1.0, 1.0)];
            [[a, b, c], [a, c, d]].iter().for_each(|triangle| push(&mut cuboid, triangle));
        }
    }
    cuboid
}

/// A flat sheet of four corners.
pub fn sheet(corners: [[f32; 3]; 4]) -> Primitive {
    let [a, b, c, d] = corners.map(Vec3::from_array);
    let mut sheet = Primitive::default();
    [[a, b, c], [a, c, d]].iter().for_each(|triangle| push(&mut sheet, triangle));
    sheet
}

/// The same, with corners of each triangle that differ in their last digits from its neighbours'.
pub fn with_seam(mut primitive: Primitive) -> Primitive {
    let shift = |(i, p): (usize, &mut Vec3)| *p += Vec3::splat((i % 5) as f32 * 1e-7);
    primitive.positions.iter_mut().enumerate().for_each(shift);
    primitive
}

/// Turned inside out: the wall of a hole.
pub fn turned(mut primitive: Primitive) -> Primitive {
    primitive.triangles.iter_mut().for_each(|triangle| triangle.swap(0, 1));
    primitive
}

/// With the second material.
pub fn second(primitive: Primitive) -> Primitive {
    Primitive { material: 1, ..primitive }
}

/// The triangles of a surface before one of them, and those from it on.
pub fn halves(whole: Primitive, at: usize) -> [Primitive; 2] {
    let (first, rest) = whole.triangles.split_at(at);
    [first, rest].map(|triangles| Primitive { triangles: triangles.to_vec(), ..whole.clone() })
}

/// Two surfaces as one primitive.
pub fn with(mut first: Primitive, second: Primitive) -> Primitive {
    let before = first.positions.len() as u32;
    first.positions.extend(second.positions);
    first.triangles.extend(second.triangles.iter().map(|triangle| triangle.map(|corner| corner + before)));
    first
}

fn push(primitive: &mut Primitive, corners: &[Vec3; 3]) {
    let first = primitive.positions.len() as u32;
    primitive.positions.extend(corners);
    primitive.triangles.push([first, first + 1, first + 2]);
}
