//! What the CPU backend's frames cost: the surface of a million triangles at 1280x720, one sample a pixel.
//!
//! `cargo bench --bench cpu` renders each case once a round, in turn, so that a drift of the machine's speed touches
//! all of them; the table gives medians, and the medians of the ratios within each round. See `benches/README.md`.

mod support;

use std::convert::Infallible;
use std::path::Path;
use std::time::Instant;

use lenspeel::bench::{Contender, Sample, interleaved};
use lenspeel::cpu::Renderer;
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;
use support::{TRIANGLES, surface};

const ROUNDS: usize = 11;

fn main() {
    let scene = Scene::new(vec![surface(TRIANGLES)], Vec::new());
    let names = [("no lens", 0), ("1 sphere", 1), ("8 spheres", 8)];
    let plans = names.map(|(_, lenses)| Plan::new(&spec(lenses), &scene).expect("valid"));
    let renderers = plans.each_ref().map(|plan| Renderer::new(&scene, plan).expect("a plan of this scene"));
    let mut contenders: Vec<Contender<Infallible>> = Vec::new();
    for (i, (name, _)) in names.into_iter().enumerate() {
        let renderer = &renderers[i];
        contenders.push(timed(name, move || {
            std::hint::black_box(renderer.render(false, &|_| ()).expect("a frame")).pixels.len()
        }));
    }
    contenders.push(timed(VISIBILITY, || std::hint::black_box(renderers[0].depths()).len()));
    contenders.push(timed("set up", || {
        std::hint::black_box(Renderer::new(&scene, &plans[0]).expect("a plan of this scene"));
        0
    }));
    let Ok(measured) = interleaved(&mut contenders, ROUNDS, |round| eprintln!("round {round} of {ROUNDS}"));
    println!("CPU backend, {} threads; {TRIANGLES} triangles, 1280x720, medians of {ROUNDS} rounds\n", threads());
    println!("| | ms | ratio to no lens | |\n|---|---|---|---|");
    for one in &measured {
        let ratio = one.ratio_to(&measured[0]);
        let rays = if one.name == VISIBILITY {
            format!("{:.1} million rays a second", 1280.0 * 720.0 / one.median() / 1e6)
        } else {
            String::new()
        };
        println!("| {} | {:.0} | {ratio:.2} | {rays} |", one.name, one.median() * 1e3);
    }
}

const VISIBILITY: &str = "primary visibility, no lens";

fn timed<'a>(name: &str, draw: impl Fn() -> usize + 'a) -> Contender<'a, Infallible> {
    Contender::new(name, move || {
        let start = Instant::now();
        draw();
        Ok(Sample::from(start.elapsed().as_secs_f64()))
    })
}

fn threads() -> usize {
    std::thread::available_parallelism().map_or(1, usize::from)
}

/// One sphere that covers 10.2 % of the picture, or several that overlap in a ring.
fn spec(lenses: usize) -> Spec {
    let mut text = String::from(
        "[scene]\nfile = \"surface.glb\"\n[camera]\neye = [0, 1.5, 2.2]\ntarget = [0, 0, 0]\n[image]\nsize = [1280, 720]\nsamples = 1\n",
    );
    for i in 0..lenses {
        let angle = std::f64::consts::TAU * i as f64 / lenses as f64;
        let (x, z, radius) = if lenses == 1 { (0.0, 0.0, 0.52) } else { (0.45 * angle.cos(), 0.35 * angle.sin(), 0.4) };
        text += &format!(
            "[[lens]]\nname = \"l{i}\"\npriority = {i}\nglass = false\nfilters = [\"invert\"]\n\
             shape.sphere = {{ center = [{x:.4}, 0, {z:.4}], radius = {radius} }}\n"
        );
    }
    Spec::parse(&text, "bench.toml", Path::new("")).expect("the specs of the benchmark are valid")
}
