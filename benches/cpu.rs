//! What the CPU backend's frames cost: the surface of a million triangles at 1280x720, one sample a pixel.
//!
//! `cargo bench --bench cpu` renders each case once a round, in turn, so that a drift of the machine's speed touches
//! all of them; the table gives medians. See `benches/README.md`.

mod support;

use std::path::Path;
use std::time::Instant;

use lenspeel::cpu::Renderer;
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;
use support::surface;

const ROUNDS: usize = 7;

fn main() {
    let scene = Scene::new(vec![surface()], Vec::new());
    let names = [("no lens", 0, ""), ("1 lens, invert", 1, "\"invert\""), ("8 lenses, invert", 8, "\"invert\"")];
    let plans: Vec<Plan> = names.iter().map(|n| Plan::new(&spec(n.1, n.2), &scene).expect("valid")).collect();
    let mut set_up = vec![Vec::new(); plans.len()];
    let mut frames = vec![Vec::new(); plans.len()];
    for _ in 0..ROUNDS {
        for (i, plan) in plans.iter().enumerate() {
            let start = Instant::now();
            let renderer = Renderer::new(&scene, plan);
            set_up[i].push(start.elapsed().as_secs_f64());
            let start = Instant::now();
            std::hint::black_box(renderer.render(false, &|_| ()));
            frames[i].push(start.elapsed().as_secs_f64());
        }
    }
    let median = |v: &[f64]| {
        let mut v = v.to_vec();
        v.sort_by(f64::total_cmp);
        v[v.len() / 2] * 1e3
    };
    for (i, name) in names.iter().enumerate() {
        println!("{}: set up {:.0} ms, frame {:.0} ms", name.0, median(&set_up[i]), median(&frames[i]));
    }
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
