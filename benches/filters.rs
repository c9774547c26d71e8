//! What each filter costs: frames of a lens over about a third of the picture with that filter, against the same lens with
//! none, on both backends.
//!
//! `cargo bench --bench filters`; behind `--`, a word keeps the filters that hold it. See `benches/README.md`.

#[allow(dead_code, reason = "other benchmarks use the rest")]
mod support;

use std::cell::RefCell;
use std::path::Path;
use std::time::Instant;

use lenspeel::bench::{Contender, Sample, interleaved};
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;
use lenspeel::spec::catalogue::FILTERS;
use lenspeel::{cpu, gpu};

const TRIANGLES: usize = 250_000;
const ROUNDS: usize = 7;
const NONE: &str = "none";

fn main() -> Result<(), String> {
    let word = std::env::args().skip(1).find(|word| !word.starts_with('-')).unwrap_or_default();
    let names: Vec<&str> = std::iter::once(NONE)
        .chain(FILTERS.iter().filter(|row| row.name.contains(&word)).map(|row| row.name))
        .collect();
    let specs: Vec<Spec> = names.iter().map(|name| spec(name)).collect();
    let mut scene = Scene::new(vec![support::surface(TRIANGLES), other()], vec!["other".into()]);
    heat(&mut scene);
    for spec in &specs {
        scene.prepare_filters(spec).map_err(|error| error.to_string())?;
    }
    let plans: Vec<Plan> = specs
        .iter()
        .map(|spec| Plan::new(spec, &scene))
        .collect::<Result<_, _>>()
        .map_err(|error| error.to_string())?;
    let adapter = gpu::choose_named(None).map_err(|error| error.to_string())?;
    let device = gpu::Headless::new(&adapter).map_err(|error| error.to_string())?;
    let renderer = RefCell::new(device.renderer(&scene).map_err(|error| error.to_string())?);
    let on_cpu: Vec<cpu::Renderer> =
        plans.iter().map(|plan| cpu::Renderer::new(&scene, plan).expect("a plan of this scene")).collect();
    let mut contenders = Vec::new();
    for (plan, name) in plans.iter().zip(&names) {
        contenders.push(on_gpu(&device, &renderer, &scene, plan, name));
    }
    for (renderer, name) in on_cpu.iter().zip(&names) {
        contenders.push(Contender::new(*name, move || {
            let start = Instant::now();
            std::hint::black_box(renderer.render(false, &|_| ()).expect("a frame"));
            Ok(Sample::from(start.elapsed().as_secs_f64()))
        }));
    }
    let measured = interleaved(&mut contenders, ROUNDS, |round| eprintln!("round {round} of {ROUNDS}"))?;
    let (gpus, cpus) = measured.split_at(names.len());
    println!("{}; {TRIANGLES} triangles, 640x360, medians of {ROUNDS} rounds\n", adapter.reason);
    println!("| filter | GPU | CPU |\n|---|---|---|");
    println!("| {NONE}, ms | {:.0} | {:.0} |", 1e3 * gpus[0].median(), 1e3 * cpus[0].median());
    for (gpu, cpu) in gpus.iter().zip(cpus).skip(1) {
        println!("| `{}` | {:.2} | {:.2} |", gpu.name, gpu.ratio_to(&gpus[0]), cpu.ratio_to(&cpus[0]));
    }
    Ok(())
}

/// Frames of a plan. The first is a whole picture, which compiles shaders and makes the room that the others need.
fn on_gpu<'a>(
    device: &'a gpu::Headless,
    renderer: &'a RefCell<gpu::Renderer>,
    scene: &'a Scene,
    plan: &'a Plan,
    name: &str,
) -> Contender<'a, String> {
    let options = gpu::RenderOptions::default();
    let mut is_settled = false;
    Contender::new(name, move || {
        let mut renderer = renderer.borrow_mut();
        if !is_settled {
            device.render_with(&mut renderer, scene, plan, options, &mut None).map_err(|error| error.to_string())?;
            is_settled = true;
        }
        let cost = device.time_frame(&mut renderer, scene, plan, options, false).map_err(|error| error.to_string())?;
        Ok(Sample::from(cost.wall))
    })
}

/// One sphere with a filter as its defaults have it.
fn spec(name: &str) -> Spec {
    let filter = match name {
        NONE => String::new(),
        "show" => "{ show = { alternate = \"other\" } }".into(),
        "texture" => "{ texture = { file = \"lens-specs/textures/checker.png\", uv = \"box\", scale = 4 } }".into(),
        "attribute" => "{ attribute = { name = \"_HEAT\" } }".into(),
        "material" => "{ material = { color = \"teal\" } }".into(),
        "wgsl" => "{ wgsl = { file = \"lens-specs/wgsl/stripes.wgsl\" } }".into(),
        _ => format!("\"{name}\""),
    };
    let text = format!(
        "[scene]\nfile = \"surface.glb\"\nalternates = {{ other = \"other.glb\" }}\n[camera]\neye = [0, 1.5, 2.2]\n\
         target = [0, 0, 0]\n[image]\nsize = [640, 360]\nsamples = 1\n[[lens]]\nname = \"a\"\nglass = false\n\
         filters = [{filter}]\nshape.sphere = {{ center = [0, 0, 0], radius = 0.9 }}\n"
    );
    Spec::parse(&text, "bench.toml", Path::new("")).expect("the specs of the benchmark are valid")
}

/// The same surface, a little lower.
fn other() -> lenspeel::scene::Model {
    let mut model = support::surface(TRIANGLES);
    model.nodes[0].world_from_local.translation.y = -0.1;
    model
}

/// A number for each vertex of the first model.
fn heat(scene: &mut Scene) {
    let primitive = &mut scene.models[0].meshes[0].primitives[0];
    let values = primitive.positions.iter().map(|p| p.x + p.z).collect();
    primitive.values.insert("_HEAT".into(), values);
}
