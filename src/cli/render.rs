//! `lenspeel render`.

use clap::ValueEnum;

use super::args::RenderArgs;
use super::backend;
use super::stages::Stages;
use crate::InputError;
use crate::frame::Frame;
use crate::output::{write_aov, write_picture, write_whole};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::spec::Spec;

pub fn run(args: &RenderArgs) -> Result<(), InputError> {
    let mut stages = Stages::default();
    let mut spec = stages.time("spec", || Spec::load(&args.spec))?;
    super::targets::check(args)?;
    spec.image.size = args.size.unwrap_or(spec.image.size);
    spec.image.samples = args.samples.unwrap_or(spec.image.samples);
    let scene = stages.time("scene", || Scene::open(&spec))?;
    let plan = stages.time("plan", || Plan::new(&spec, &scene))?;
    for warning in &plan.warnings {
        eprintln!("warning: {warning}");
    }
    let (backend, choice) = stages.time("device", || backend::choose(args.backend))?;
    eprintln!("{choice}");
    let frame = backend.render(&scene, &plan, args.engine, !args.aov.is_empty(), &mut stages)?;
    stages.time("write", || write_all(args, &plan, &frame))?;
    if args.time {
        eprint!("{}", stages.text());
    }
    match &args.stats {
        Some(path) => write_whole(path, stats(args, &plan, &choice, &stages).as_bytes()),
        None => Ok(()),
    }
}

fn write_all(args: &RenderArgs, plan: &Plan, frame: &Frame) -> Result<(), InputError> {
    write_picture(&args.output, frame)?;
    for (aov, path) in &args.aov {
        if let Some(aovs) = &frame.aovs {
            write_aov(path, *aov, plan, aovs)?;
        }
    }
    Ok(())
}

fn stats(args: &RenderArgs, plan: &Plan, choice: &str, stages: &Stages) -> String {
    let engine = args.engine.and_then(|e| e.to_possible_value()).map_or("fused".into(), |e| e.get_name().to_string());
    let (backend, reason) = choice.split_once(": ").unwrap_or((choice, ""));
    let stats = serde_json::json!({
        "backend": backend,
        "reason": reason,
        "engine": (backend == "gpu").then_some(engine),
        "size": plan.view.size,
        "samples": plan.samples,
        "triangles": plan.items.iter().map(|item| u64::from(item.triangles)).sum::<u64>(),
        "items": plan.items.len(),
        "lenses": plan.lenses.len(),
        "contents": plan.contents.len(),
        "seconds": stages.json(),
    });
    serde_json::to_string_pretty(&stats).unwrap_or_default() + "\n"
}
