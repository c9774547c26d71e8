//! What a lens costs on the GPU: one million triangles at 1280x720, one sample, with and without one lens that covers
//! about a tenth of the picture. Prints the best of several interleaved rounds as a Markdown table.

use std::time::Instant;

use glam::{DAffine3, Vec3};
use lenspeel::gpu::{self, Engine, Headless, RenderOptions, Renderer};
use lenspeel::plan::Plan;
use lenspeel::scene::{Material, Mesh, Model, Node, Primitive, Scene};
use lenspeel::spec::Spec;

/// Cells along a side of the terrain; two triangles each.
const CELLS: u32 = 708;
const ROUNDS: usize = 5;
const HEAD: &str = "[scene]\nfile = \"made-in-code.glb\"\n[camera]\neye = [1.0, 1.4, 1.6]\ntarget = [0, 0, 0]\nfov_y = 60\n\
    [image]\nsize = [1280, 720]\nsamples = 1\n";
const CASES: [(&str, Option<&str>); 5] = [
    ("no lens", None),
    ("tint", Some("{ tint = { color = \"red\" } }")),
    ("normals", Some("\"normals\"")),
    ("wireframe", Some("\"wireframe\"")),
    ("erase", Some("\"erase\"")),
];

fn main() {
    let device = gpu::choose_named(None).and_then(|choice| Headless::new(&choice));
    let device = match device {
        Ok(device) => device,
        Err(error) => return println!("nothing to measure: {error}"),
    };
    println!("{}\n", device.reason);
    let scene = Scene::new(vec![terrain()], vec![]);
    let plans = CASES.map(|(_, filter)| plan(&scene, filter));
    let mut renderer = device.renderer(&scene).expect("the scene fits");
    println!("| lens | fused | | peel | |\n|---|---|---|---|---|");
    let [fused, peel] =
        [Engine::Fused, Engine::Peel].map(|engine| measure(&device, &mut renderer, &scene, &plans, engine));
    for (i, (name, _)) in CASES.iter().enumerate() {
        let cells = [&fused, &peel].map(|times| format!("{:.0} ms | {:.2}", times[i] * 1e3, times[i] / times[0]));
        println!("| {name} | {} | {} |", cells[0], cells[1]);
    }
}

/// Seconds of the fastest round for each plan.
fn measure(device: &Headless, renderer: &mut Renderer, scene: &Scene, plans: &[Plan], engine: Engine) -> Vec<f64> {
    let mut best = vec![f64::INFINITY; plans.len()];
    for _ in 0..ROUNDS {
        for (plan, best) in plans.iter().zip(&mut best) {
            let start = Instant::now();
            let options = RenderOptions { engine, aovs: false };
            device.render_with(renderer, scene, plan, options, &mut None).expect("the picture fits");
            *best = best.min(start.elapsed().as_secs_f64());
        }
    }
    best
}

fn plan(scene: &Scene, filter: Option<&str>) -> Plan {
    let lens = filter.map_or(String::new(), |filter| {
        let shape = "shape.sphere = { center = [0, 0.1, 0], radius = 0.38 }";
        format!("[[lens]]\nname = \"lens\"\n{shape}\nfilters = [{filter}]\n")
    });
    let spec = Spec::parse(&format!("{HEAD}{lens}"), "spec of the benchmark", "".as_ref()).expect("the spec is right");
    Plan::new(&spec, scene).expect("the plan is right")
}

fn terrain() -> Model {
    let at = |x: u32, z: u32| {
        let (u, v) = (x as f32 / CELLS as f32 * 2.0 - 1.0, z as f32 / CELLS as f32 * 2.0 - 1.0);
        let hills = 0.15 * (7.0 * u).sin() * (5.0 * v).cos();
        Vec3::new(u, hills + 0.02 * (60.0 * u).sin() * (50.0 * v).sin(), v)
    };
    let positions = (0..=CELLS).flat_map(|z| (0..=CELLS).map(move |x| at(x, z))).collect();
    let triangles = (0..CELLS)
        .flat_map(|z| (0..CELLS).map(move |x| z * (CELLS + 1) + x))
        .flat_map(|i| [[i, i + CELLS + 1, i + 1], [i + 1, i + CELLS + 1, i + CELLS + 2]])
        .collect();
    let primitive = Primitive { positions, triangles, ..Primitive::default() };
    let node = Node {
        name: "terrain".into(),
        parent: None,
        children: vec![],
        world_from_local: DAffine3::IDENTITY,
        mesh: Some(0),
        camera: None,
        light: None,
        drawn: true,
    };
    Model {
        name: "made in code".into(),
        nodes: vec![node],
        meshes: vec![Mesh { name: "terrain".into(), primitives: vec![primitive] }],
        materials: vec![Material { metallic: 0.0, roughness: 0.7, ..Material::default() }],
        ..Model::default()
    }
}
