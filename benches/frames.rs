//! What lenses cost: ratios to the same frame without a lens, from one interleaved run.
//!
//! `cargo bench --bench frames` renders a surface of a million triangles at 1280x720, one sample a pixel, on the
//! best adapter there is. Every round renders each case once, in turn, so that a drift of the machine's speed
//! touches all of them; the table gives medians. See `benches/README.md`.

use std::path::Path;
use std::time::Instant;

use glam::Vec3;
use lenspeel::gpu::{Engine, Headless, RenderOptions, Renderer, choose_named};
use lenspeel::plan::Plan;
use lenspeel::scene::{Material, Mesh, Model, Node, Primitive, Scene, Transform};
use lenspeel::spec::Spec;

/// Quads along each side of the surface: 2 * 708^2 = 1,002,528 triangles.
const SIDE: usize = 708;
const ROUNDS: usize = 7;

struct Case {
    name: String,
    engine: Engine,
    plan: Plan,
    seconds: Vec<f64>,
}

fn main() {
    let adapter = match choose_named(None) {
        Ok(adapter) => adapter,
        Err(error) => {
            println!("no benchmark: {error}");
            return;
        }
    };
    println!("{}", adapter.reason);
    let device = Headless::new(&adapter).expect("the chosen adapter opens");
    let scene = Scene::new(vec![surface()], Vec::new());
    let mut renderer = device.renderer(&scene).expect("the scene fits the device");
    let mut cases = cases(&scene);
    // One round to compile pipelines and to fill caches.
    for round in 0..=ROUNDS {
        for case in &mut cases {
            let seconds = frame(&device, &mut renderer, &scene, case);
            if round > 0 {
                case.seconds.push(seconds);
            }
        }
    }
    table(&cases);
}

fn frame(device: &Headless, renderer: &mut Renderer, scene: &Scene, case: &Case) -> f64 {
    let options = RenderOptions { engine: case.engine, aovs: false };
    let start = Instant::now();
    device.render_with(renderer, scene, &case.plan, options, &mut None).expect("the frame fits the device");
    start.elapsed().as_secs_f64()
}

fn table(cases: &[Case]) {
    let median = |case: &Case| {
        let mut sorted = case.seconds.clone();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() / 2]
    };
    let plain = median(&cases[0]);
    println!("| case | median ms | ratio to no lens |\n|---|---|---|");
    for case in cases {
        println!("| {} | {:.0} | {:.2} |", case.name, median(case) * 1e3, median(case) / plain);
    }
}

fn cases(scene: &Scene) -> Vec<Case> {
    let mut cases = Vec::new();
    let mut add = |name: &str, engine: Engine, lenses: usize, filters: &str| {
        let spec = spec(lenses, filters);
        let plan = Plan::new(&spec, scene).expect("the specs of the benchmark are valid");
        let engine_name = if engine == Engine::Fused { "fused" } else { "peel" };
        let name = if lenses == 0 { name.to_string() } else { format!("{name}, `{engine_name}`") };
        cases.push(Case { name, engine, plan, seconds: Vec::new() });
    };
    add("no lens", Engine::Fused, 0, "");
    for (filters, name) in [("\"invert\"", "invert"), ("\"erase\"", "erase"), ("\"wireframe\"", "wireframe")] {
        add(&format!("1 lens, {name}"), Engine::Fused, 1, filters);
    }
    add("4 lenses, invert", Engine::Fused, 4, "\"invert\"");
    add("8 lenses, invert", Engine::Fused, 8, "\"invert\"");
    add("1 lens, invert", Engine::Peel, 1, "\"invert\"");
    add("4 lenses, invert", Engine::Peel, 4, "\"invert\"");
    cases
}

/// One sphere that covers 10.2 % of the picture, or several that overlap in a ring.
fn spec(lenses: usize, filters: &str) -> Spec {
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
fn surface() -> Model {
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
