//! `lenspeel render`.

use std::path::{Path, PathBuf};

use clap::ValueEnum;

use super::args::{RenderArgs, ViewChoice};
use super::backend::{self, Backend, Session};
use super::outputs;
use super::stages::Stages;
use super::streams::Messages;
use crate::InputError;
use crate::debug_view::{DebugView, Row};
use crate::frame::Frame;
use crate::legend;
use crate::output::{encode_aov, encode_picture};
use crate::plan::Plan;
use crate::scene::{OpenOptions, Scene};
use crate::spec::Spec;
use crate::words::count_of;

pub fn run(args: &RenderArgs, messages: Messages) -> Result<(), InputError> {
    let mut stages = Stages::new(messages);
    let mut spec = stages.time("spec", || args.spec.load())?;
    outputs::check(args, &spec)?;
    check_row(args, &spec)?;
    spec.image.size = args.size.unwrap_or(spec.image.size);
    spec.image.samples = args.samples.unwrap_or(spec.image.samples);
    // A debug view has a legend of its own.
    spec.image.legend = (spec.image.legend || args.legend) && args.view.is_none();
    // A device takes as long to open as many a scene.
    let (opened, device) = std::thread::scope(|scope| {
        let device = scope.spawn(|| backend::choose(args.backend));
        (open(&spec, &args.open.options(), &mut stages), stages.time("device", || device.join()))
    });
    let (scene, plan) = opened?;
    for warning in &plan.warnings {
        messages.warning(warning);
    }
    if spec.image.legend {
        told_of_legend(&plan, messages);
    }
    let backend = device.unwrap_or_else(|panic| std::panic::resume_unwind(panic))?;
    messages.note(&backend);
    let mut session = Session::new(backend, &scene, &plan, stages);
    let mut frame = session.render(args.engine, !args.aov.is_empty() || args.view.is_some())?;
    if let Some(view) = args.view {
        let drawn = draw_view(view, args.row, &mut session, &plan, &frame)?;
        frame = Frame { aovs: frame.aovs, ..drawn };
    }
    let Session { backend, mut stages, .. } = session;
    let written = stages.time("write", || write_all(args, &plan, &frame))?;
    if args.time {
        messages.answer(&stages.text());
    }
    written.iter().for_each(|path| messages.note(format_args!("wrote {}", outputs::shown(path))));
    let Some(path) = &args.stats else { return Ok(()) };
    outputs::write(path, stats(args, &plan, &backend, &stages).as_bytes())?;
    messages.note(format_args!("wrote {}", outputs::shown(path)));
    Ok(())
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
    session: &mut Session,
    plan: &Plan,
    frame: &Frame,
) -> Result<Frame, InputError> {
    let aovs = frame.aovs.as_ref().ok_or_else(|| InputError::new("a debug view needs the maps of its picture"))?;
    let view = match view {
        ViewChoice::Layers => DebugView::Layers,
        ViewChoice::Regions => DebugView::Regions(session.in_front()?),
        ViewChoice::Order => DebugView::Order(session.in_front()?),
        ViewChoice::DepthIntervals => {
            let y = row.unwrap_or(plan.view.size[1] / 2);
            DebugView::DepthIntervals(Row { y, layers: session.row_layers(y)? })
        }
    };
    Ok(view.draw(plan, frame, aovs))
}

/// Whether the legend shows all that was asked for.
fn told_of_legend(plan: &Plan, messages: Messages) {
    let left_out = legend::left_out(plan);
    if plan.legend.is_empty() {
        messages.note("note: no lens shows false colours or contour lines, so there is no legend");
    } else if left_out > 0 {
        let entries = count_of(left_out, "entry");
        messages.warning(format_args!("the picture has no room for {entries} of its legend"));
    }
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
    Err(InputError::new(format!("the picture has {}, so there is no row {row}", count_of(rows, "row")))
        .help("rows count from 0 at the top"))
}

/// Writes the picture and its maps; where to.
fn write_all(args: &RenderArgs, plan: &Plan, frame: &Frame) -> Result<Vec<PathBuf>, InputError> {
    let mut written = Vec::new();
    let mut write = |path: &Path, bytes: &[u8]| {
        written.push(path.to_path_buf());
        outputs::write(path, bytes)
    };
    write(&args.output, &encode_picture(frame)?)?;
    for (aov, path) in &args.aov {
        let Some(aovs) = &frame.aovs else { break };
        let encoded = encode_aov(*aov, plan, aovs)?;
        write(path, &encoded.map)?;
        if let Some(table) = encoded.table {
            write(&path.with_extension("json"), table.as_bytes())?;
        }
    }
    Ok(written)
}

fn stats(args: &RenderArgs, plan: &Plan, backend: &Backend, stages: &Stages) -> String {
    let engine = args.engine.and_then(|e| e.to_possible_value()).map_or("fused".into(), |e| e.get_name().to_string());
    let stats = serde_json::json!({
        "backend": backend.name(),
        "reason": backend.reason,
        "engine": (backend.name() == "gpu").then_some(engine),
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
