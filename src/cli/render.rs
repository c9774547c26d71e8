//! `lenspeel render`.

use clap::ValueEnum;

use super::args::{RenderArgs, ViewChoice};
use super::backend::{self, Backend};
use super::stages::Stages;
use crate::InputError;
use crate::debug_view::{self, DebugView, Row};
use crate::frame::Frame;
use crate::output::{write_aov, write_picture, write_whole};
use crate::plan::Plan;
use crate::scene::{OpenOptions, Scene};
use crate::spec::Spec;

pub fn run(args: &RenderArgs) -> Result<(), InputError> {
    let mut stages = Stages::default();
    let mut spec = stages.time("spec", || Spec::load(&args.spec))?;
    super::targets::check(args)?;
    check_row(args, &spec)?;
    spec.image.size = args.size.unwrap_or(spec.image.size);
    spec.image.samples = args.samples.unwrap_or(spec.image.samples);
    // A device takes as long to open as many a scene.
    let (opened, device) = std::thread::scope(|scope| {
        let device = scope.spawn(|| backend::choose(args.backend));
        (open(&spec, &args.open.options(), &mut stages), stages.time("device", || device.join()))
    });
    let (scene, plan) = opened?;
    for warning in &plan.warnings {
        eprintln!("warning: {warning}");
    }
    let (backend, choice) = device.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
    eprintln!("{choice}");
    let aovs = !args.aov.is_empty() || args.view.is_some();
    let mut frame = backend.render(&scene, &plan, args.engine, aovs, &mut stages)?;
    if let Some(view) = args.view {
        let drawn = draw_view(view, args.row, &backend, &scene, &plan, &frame)?;
        frame = Frame { aovs: frame.aovs, ..drawn };
    }
    stages.time("write", || write_all(args, &plan, &frame))?;
    if args.time {
        eprint!("{}", stages.text());
    }
    match &args.stats {
        Some(path) => write_whole(path, stats(args, &plan, backend.name(), &choice, &stages).as_bytes()),
        None => Ok(()),
    }
}

fn open(spec: &Spec, options: &OpenOptions, stages: &mut Stages) -> Result<(Scene, Plan), InputError> {
    let scene = stages.time("scene", || Scene::open_with(spec, options))?;
    let plan = stages.time("plan", || Plan::new(spec, &scene))?;
    Ok((scene, plan))
}

/// The debug view of a picture.
fn draw_view(
    view: ViewChoice,
    row: Option<u32>,
    backend: &Backend,
    scene: &Scene,
    plan: &Plan,
    frame: &Frame,
) -> Result<Frame, InputError> {
    let aovs = frame.aovs.as_ref().ok_or_else(|| InputError::new("a debug view needs the maps of its picture"))?;
    let view = match view {
        ViewChoice::Layers => DebugView::Layers,
        ViewChoice::Regions => DebugView::Regions,
        ViewChoice::Order => DebugView::Order,
        ViewChoice::DepthIntervals => {
            let y = row.unwrap_or(plan.view.size[1] / 2);
            let layers = backend.row_layers(scene, plan, y)?;
            return Ok(debug_view::draw_section(plan, frame, aovs, &Row { y, layers }));
        }
    };
    Ok(debug_view::draw(view, plan, frame, aovs, &backend::in_front(scene, plan)?))
}

fn check_row(args: &RenderArgs, spec: &Spec) -> Result<(), InputError> {
    let Some(row) = args.row else { return Ok(()) };
    if args.view != Some(ViewChoice::DepthIntervals) {
        return Err(InputError::new("`--row` chooses what `--view depth-intervals` shows, and no other view has rows"));
    }
    let rows = args.size.unwrap_or(spec.image.size)[1];
    if row < rows {
        return Ok(());
    }
    Err(InputError::new(format!("the picture has {rows} rows, so there is no row {row}"))
        .help("rows count from 0 at the top"))
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

fn stats(args: &RenderArgs, plan: &Plan, backend: &str, choice: &str, stages: &Stages) -> String {
    let engine = args.engine.and_then(|e| e.to_possible_value()).map_or("fused".into(), |e| e.get_name().to_string());
    let reason = choice.split_once(": ").map_or("", |(_, reason)| reason);
    let stats = serde_json::json!({
        "backend": backend,
        "reason": reason,
        "engine": (backend == "gpu").then_some(engine),
        "size": plan.view.size,
        "samples": plan.samples,
        "triangles": plan.items.iter().filter(|item| !item.is_simplified()).map(|item| u64::from(item.triangles)).sum::<u64>(),
        "items": plan.items.len(),
        "lenses": plan.lenses.len(),
        "contents": plan.contents.len(),
        "seconds": stages.json(),
    });
    serde_json::to_string_pretty(&stats).unwrap_or_default() + "\n"
}
