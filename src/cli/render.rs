//! `lenspeel render`.

use std::io::IsTerminal;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};

use super::args::RenderArgs;
use crate::InputError;
use crate::cpu;
use crate::frame::Frame;
use crate::output::{write_aov, write_picture, write_whole};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::spec::Spec;

/// Times of the stages in the order in which they ran.
#[derive(Debug, Default)]
struct Stages(Vec<(&'static str, f64)>);

impl Stages {
    fn time<T>(&mut self, name: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.0.push((name, start.elapsed().as_secs_f64()));
        result
    }
}

pub fn run(args: &RenderArgs) -> Result<(), InputError> {
    let mut stages = Stages::default();
    let mut spec = stages.time("spec", || Spec::load(&args.spec))?;
    spec.image.size = args.size.unwrap_or(spec.image.size);
    spec.image.samples = args.samples.unwrap_or(spec.image.samples);
    let scene = stages.time("scene", || Scene::open(&spec))?;
    let plan = stages.time("plan", || Plan::new(&spec, &scene))?;
    let frame = on_cpu(&scene, &plan, !args.aov.is_empty(), &mut stages);
    stages.time("write", || write_all(args, &plan, &frame))?;
    if args.time {
        for (name, seconds) in &stages.0 {
            eprintln!("{name:>10} {:9.1} ms", seconds * 1e3);
        }
    }
    match &args.stats {
        Some(path) => write_whole(path, stats(&plan, &stages).as_bytes()),
        None => Ok(()),
    }
}

fn on_cpu(scene: &Scene, plan: &Plan, aovs: bool, stages: &mut Stages) -> Frame {
    let renderer = stages.time("bvh", || cpu::Renderer::new(scene, plan));
    let pixels = plan.view.size.iter().map(|s| u64::from(*s)).product();
    let bar = progress(pixels);
    let frame = stages.time("render", || renderer.render(aovs, &|done| bar.inc(done)));
    bar.finish_and_clear();
    frame
}

/// A bar on a terminal, nothing elsewhere.
fn progress(pixels: u64) -> ProgressBar {
    if !std::io::stderr().is_terminal() {
        return ProgressBar::hidden();
    }
    let style = ProgressStyle::with_template("{bar:40} {percent:>3} % {eta}").unwrap_or(ProgressStyle::default_bar());
    ProgressBar::new(pixels).with_style(style)
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

fn stats(plan: &Plan, stages: &Stages) -> String {
    let seconds: serde_json::Map<String, serde_json::Value> =
        stages.0.iter().map(|(name, s)| ((*name).to_string(), serde_json::json!(s))).collect();
    let stats = serde_json::json!({
        "size": plan.view.size,
        "samples": plan.samples,
        "triangles": plan.items.iter().map(|item| u64::from(item.triangles)).sum::<u64>(),
        "items": plan.items.len(),
        "lenses": plan.lenses.len(),
        "contents": plan.contents.len(),
        "seconds": seconds,
    });
    serde_json::to_string_pretty(&stats).unwrap_or_default() + "\n"
}
