//! What lenses cost: ratios to the same frame without a lens, from one interleaved run.
//!
//! `cargo bench --bench frames` renders a surface of a million triangles at 1280x720, one sample a pixel, on the
//! best adapter there is. Every round renders each case once, in turn, so that a drift of the machine's speed
//! touches all of them; the table gives medians. See `benches/README.md`.

mod support;

use std::time::Instant;

use lenspeel::gpu::{Engine, Headless, RenderOptions, Renderer, choose_named};
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;

use support::{spec, surface};

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
