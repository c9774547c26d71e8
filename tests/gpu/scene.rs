//! A small scene made in code: a floor, a wavy sheet with colours and texture coordinates, and panes one behind the other.

use glam::{DAffine3, DVec3, Vec2, Vec3, Vec4};
use lenspeel::plan::Plan;
use lenspeel::scene::{AlphaMode, Material, Mesh, Model, Node, Primitive, Scene, Transform};
use lenspeel::spec::Spec;

/// How many half-transparent panes hang in the scene.
pub const PANES: usize = 12;

/// The scene and a plan for `lenses` (TOML) over it.
pub fn planned(size: [u32; 2], samples: u32, camera: &str, lenses: &str) -> (Scene, Plan) {
    let mut scene = Scene::new(vec![model()], vec![]);
    let plan = plan_of(&mut scene, size, samples, camera, lenses);
    (scene, plan)
}

/// A plan for `lenses` (TOML) over a scene that there is already.
pub fn plan_of(scene: &mut Scene, size: [u32; 2], samples: u32, camera: &str, lenses: &str) -> Plan {
    let text = format!(
        "[scene]\nfile = \"made-in-code.glb\"\n[camera]\n{camera}\n[image]\nsize = [{}, {}]\nsamples = {samples}\n{lenses}",
        size[0], size[1]
    );
    let spec = Spec::parse(&text, "spec of a test", "".as_ref()).expect("the test's spec is right");
    scene.prepare_filters(&spec).expect("the test's filters are right");
    Plan::new(&spec, scene).expect("the test's plan is right")
}

pub const PERSPECTIVE: &str = "eye = [2.1, 1.6, 2.7]\ntarget = [0, 0.1, 0]\nfov_y = 40";
pub const ORTHOGRAPHIC: &str = "eye = [2.1, 1.6, 2.7]\ntarget = [0, 0.1, 0]\northographic_height = 2.6";

fn model() -> Model {
    let mut model = Model { name: "made in code".into(), ..Model::default() };
    model.materials = vec![
        Material { name: "sheet".into(), metallic: 0.1, roughness: 0.4, ..Material::default() },
        Material {
            name: "pane".into(),
            base_color: [0.2, 0.6, 0.9, 0.3],
            alpha_mode: AlphaMode::Blend,
            metallic: 0.0,
            ..Material::default()
        },
    ];
    add(&mut model, "sheet", sheet(), DVec3::ZERO, 0);
    for i in 0..PANES {
        add(&mut model, "pane", pane(), DVec3::new(0.35, 0.0, -0.9 + 0.15 * i as f64), 1);
    }
    model
}

fn add(model: &mut Model, name: &str, mut primitive: Primitive, at: DVec3, material: usize) {
    primitive.material = material;
    let place = DAffine3::from_translation(at);
    model.nodes.push(Node {
        name: name.into(),
        parent: None,
        children: vec![],
        rest: Transform::Matrix(place),
        world_from_local: place,
        mesh: Some(model.meshes.len()),
        camera: None,
        light: None,
        drawn: true,
        hidden: false,
    });
    model.meshes.push(Mesh { name: name.into(), primitives: vec![primitive] });
}

/// A wavy sheet of 70 by 70 cells: more triangles than one call draws.
fn sheet() -> Primitive {
    const CELLS: u32 = 70;
    let mut primitive = Primitive::default();
    let (mut uv, mut colors) = (Vec::new(), Vec::new());
    for z in 0..=CELLS {
        for x in 0..=CELLS {
            let (u, v) = (x as f32 / CELLS as f32, z as f32 / CELLS as f32);
            let height = 0.2 * (9.0 * u).sin() * (7.0 * v).cos();
            primitive.positions.push(Vec3::new(2.0 * u - 1.0, height, 2.0 * v - 1.0));
            uv.push(Vec2::new(u, v));
            colors.push(Vec4::new(u, 0.5, v, 1.0));
        }
    }
    for z in 0..CELLS {
        for x in 0..CELLS {
            let i = z * (CELLS + 1) + x;
            primitive.triangles.extend([[i, i + CELLS + 1, i + 1], [i + 1, i + CELLS + 1, i + CELLS + 2]]);
        }
    }
    primitive.uv[0] = Some(uv);
    primitive.colors = Some(colors);
    primitive
}

/// An upright square.
fn pane() -> Primitive {
    let corner = |x: f32, y: f32| Vec3::new(x, y, 0.0);
    Primitive {
        positions: vec![corner(-0.3, -0.2), corner(0.3, -0.2), corner(0.3, 0.5), corner(-0.3, 0.5)],
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        ..Primitive::default()
    }
}
