//! `lenspeel explain` and `lenspeel pick`.

use super::args::{ExplainArgs, ExplainFormat, PickArgs, PickFormat, ViewArgs};
use super::backend::{self, Backend, Session};
use super::stages::Stages;
use super::streams::{Messages, print, print_json, print_text};
use crate::explain::{Explanation, PixelAccount, point_text};
use crate::pick::NamedPick;
use crate::plan::{Account, Plan};
use crate::scene::Scene;
use crate::spec::Spec;
use crate::{InputError, printable};

/// A spec opened as it is to be seen.
struct Opened {
    spec: Spec,
    scene: Scene,
    plan: Plan,
}

impl Opened {
    fn new(args: &ViewArgs) -> Result<Self, InputError> {
        let mut spec = args.spec.load()?;
        spec.image.size = args.size.unwrap_or(spec.image.size);
        // Only pixel centres are looked at.
        spec.image.samples = 1;
        let scene = Scene::open_with(&spec, &args.open.options())?;
        let plan = Plan::new(&spec, &scene)?;
        Ok(Self { spec, scene, plan })
    }

    fn session(&self, args: &ViewArgs, messages: Messages) -> Result<Session<'_>, InputError> {
        let backend = match args.backend {
            Some(choice) => backend::choose(choice)?,
            None => Backend::cpu("it need not be started"),
        };
        // Nothing is said of a choice that nobody made.
        if args.backend.is_some() {
            messages.note(&backend);
        }
        Ok(Session::new(backend, &self.scene, &self.plan, Stages::new(messages)))
    }

    fn check_pixel(&self, [x, y]: [u32; 2]) -> Result<(), InputError> {
        if self.plan.view.has_pixel([x, y]) {
            return Ok(());
        }
        let [width, height] = self.plan.view.size;
        let message = format!("the picture has {width} x {height} pixels, so there is no pixel {x},{y}");
        Err(InputError::new(message).help("columns and rows count from 0 at the top left"))
    }
}

pub fn run(args: &ExplainArgs, messages: Messages) -> Result<(), InputError> {
    let opened = Opened::new(&args.view)?;
    if let Some(pixel) = args.pixel {
        return one_pixel(&opened, pixel, args, messages);
    }
    let Opened { spec, plan, .. } = &opened;
    let account = Account::new(spec, plan);
    let explanation = Explanation::new(spec, plan, &account);
    match args.format {
        ExplainFormat::Dot => print(&explanation.dot()),
        ExplainFormat::Mermaid => print(&explanation.mermaid()),
        ExplainFormat::Text | ExplainFormat::Json => {
            let mut session = opened.session(&args.view, messages)?;
            let aovs = session.maps()?;
            let explanation = explanation.in_view(&aovs, session.in_front()?, session.backend.name());
            match args.format {
                ExplainFormat::Json => print_json(&explanation),
                _ => print_text(&explanation),
            }
        }
    }
}

fn one_pixel(opened: &Opened, pixel: [u32; 2], args: &ExplainArgs, messages: Messages) -> Result<(), InputError> {
    if matches!(args.format, ExplainFormat::Dot | ExplainFormat::Mermaid) {
        let message = "one pixel has no graph of lenses, so `--pixel` cannot be drawn as dot or mermaid";
        return Err(InputError::new(message)
            .help("use `--format text` or `--format json` with `--pixel`, or leave `--pixel` out"));
    }
    opened.check_pixel(pixel)?;
    let Opened { spec, scene, plan } = opened;
    let mut session = opened.session(&args.view, messages)?;
    let report = &session.explain(pixel)?;
    let account = PixelAccount { spec, scene, plan, pixel, report, backend: session.backend.name() };
    match args.format {
        ExplainFormat::Json => print_json(&account),
        _ => print_text(&account),
    }
}

/// What is visible at a pixel.
pub fn pick(args: &PickArgs, messages: Messages) -> Result<(), InputError> {
    let opened = Opened::new(&args.view)?;
    opened.check_pixel(args.pixel)?;
    let Opened { scene, plan, .. } = &opened;
    let picked = opened.session(&args.view, messages)?.pick(args.pixel)?;
    let named = picked.map(|pick| pick.named(scene, plan));
    match args.format {
        PickFormat::Json => print_json(&named),
        PickFormat::Text => print_text(&pick_text(args.pixel, named.as_ref())),
    }
}

fn pick_text([x, y]: [u32; 2], pick: Option<&NamedPick>) -> String {
    let Some(NamedPick { surface, depth, position, place, normal }) = pick else {
        return format!("pixel {x},{y}: nothing is there\n");
    };
    let of = surface
        .alternate
        .map_or_else(|| surface.model.to_string(), |name| format!("{}, alternate {name}", surface.model));
    let stack: Vec<String> = surface.stack.iter().map(ToString::to_string).collect();
    let or_none = |list: String| if list.is_empty() { "none".to_string() } else { list };
    let what = match (&surface.cap, surface.triangle) {
        (Some(maker), _) => ("cap", format!("of {maker}")),
        (None, triangle) => {
            ("triangle", format!("{} of primitive {}", triangle.unwrap_or_default(), surface.primitive))
        }
    };
    let mut rows = vec![
        ("node", format!("{} {}, in {of}", surface.node.index, printable::whole_name(&surface.path.join(" / ")))),
        ("material", format!("{} {}", surface.material.index, printable::whole_name(&surface.material.name))),
        what,
        ("position", point_text(*position)),
        ("depth", format!("{depth:.5}")),
        ("normal", point_text(normal.as_dvec3())),
        ("lenses", or_none(surface.lenses.join(" + "))),
        ("stack", or_none(stack.join(" < "))),
    ];
    if !surface.moved_by.is_empty() {
        rows.insert(4, ("moved", format!("by {} from {}", surface.moved_by.join(", "), point_text(*place))));
    }
    let rows = rows.into_iter().map(|(name, value)| format!("  {name:<8}  {value}\n"));
    format!("pixel {x},{y}\n") + &rows.collect::<String>()
}
