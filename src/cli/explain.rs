//! `lenspeel explain`.

mod pixel;

use serde_json::{Value, json};

use self::pixel::PixelAccount;
use super::args::{ExplainArgs, ExplainFormat};
use crate::InputError;
use crate::plan::{Account, LensSet, Plan, Reasons, Region};
use crate::scene::Scene;
use crate::spec::Spec;

pub fn run(args: &ExplainArgs) -> Result<(), InputError> {
    let spec = Spec::load(&args.spec)?;
    let scene = Scene::open(&spec)?;
    let plan = Plan::new(&spec, &scene)?;
    if let Some(pixel) = args.pixel {
        return one_pixel(&spec, &scene, &plan, pixel, args.format);
    }
    super::print(&match args.format {
        ExplainFormat::Text => Account::new(&spec, &plan).text(&spec, &plan),
        ExplainFormat::Json => pretty(&json(&spec, &plan)),
        ExplainFormat::Dot => dot(&spec, &plan),
        ExplainFormat::Mermaid => mermaid(&spec, &plan),
    });
    Ok(())
}

fn one_pixel(
    spec: &Spec,
    scene: &Scene,
    plan: &Plan,
    [x, y]: [u32; 2],
    format: ExplainFormat,
) -> Result<(), InputError> {
    let [width, height] = plan.view.size;
    if x >= width || y >= height {
        let message = format!("the picture has {width} x {height} pixels, so there is no pixel {x},{y}");
        return Err(InputError::new(message).help("columns and rows count from 0 at the top left"));
    }
    let account = || PixelAccount::new(spec, scene, plan, [x, y]);
    super::print(&match format {
        ExplainFormat::Text => account().text(),
        ExplainFormat::Json => pretty(&account().json()),
        ExplainFormat::Dot | ExplainFormat::Mermaid => {
            return Err(InputError::new(
                "one pixel has no graph of lenses, so `--pixel` cannot be drawn as dot or mermaid",
            )
            .help("use `--format text` or `--format json` with `--pixel`, or leave `--pixel` out"));
        }
    });
    Ok(())
}

fn pretty(value: &Value) -> String {
    serde_json::to_string_pretty(value).unwrap_or_default() + "\n"
}

fn json(spec: &Spec, plan: &Plan) -> Value {
    let (account, reasons) = (Account::new(spec, plan), Reasons::new(spec, plan));
    let order: Vec<Value> = plan
        .lenses
        .iter()
        .enumerate()
        .map(|(rank, lens)| {
            json!({
                "lens": lens.name,
                "line": spec.source.line(spec.lenses[lens.index].name.span.start),
                "filters": lens.filter_names().collect::<Vec<_>>(),
                "overrides": lens.overrides,
                "hides": plan.names(lens.hides),
                "above_previous_because": rank.checked_sub(1).map(|below| account.order[below].to_string()),
            })
        })
        .collect();
    let regions: Vec<Value> = account
        .regions
        .iter()
        .map(|region| {
            json!({
                "lenses": plan.names(region.set),
                "stack": stack_json(plan, *region),
                "hidden": hidden_json(&reasons, region),
                "order": order_json(&reasons, region.stack),
            })
        })
        .collect();
    let undecided: Vec<Value> =
        account.undecided.iter().map(|u| json!({ "below": u.below, "above": u.above, "remedy": u.remedy })).collect();
    json!({ "order": order, "regions": regions, "undecided": undecided, "warnings": plan.warnings })
}

fn stack_json(plan: &Plan, region: Region) -> Vec<Value> {
    crate::output::stack(plan, region).iter().map(crate::output::Entry::json).collect()
}

/// The lenses of a region that do not act there.
fn hidden_json(reasons: &Reasons, region: &Region) -> Vec<Value> {
    let hidden = reasons.hidden(region);
    hidden.map(|h| json!({ "lens": h.lens, "by": h.by, "because": h.because.to_string() })).collect()
}

/// Why each lens of a stack is above the one before it.
fn order_json(reasons: &Reasons, stack: LensSet) -> Vec<Value> {
    let neighbours = reasons.neighbours(stack);
    neighbours.map(|n| json!({ "below": n.below, "above": n.above, "because": n.because.to_string() })).collect()
}

/// Declared edges as `(below, above, label)`.
fn edges(spec: &Spec, plan: &Plan) -> Vec<(String, String, String)> {
    let name = |i: petgraph::graph::NodeIndex| spec.lenses[i.index()].name.value.clone();
    let graph = &plan.graph.graph;
    graph
        .edge_indices()
        .filter_map(|edge| {
            let (below, above) = graph.edge_endpoints(edge)?;
            let declared = &graph[edge];
            let line = spec.source.line(declared.span.start);
            Some((name(below), name(above), format!("{}, line {line}", declared.key.name())))
        })
        .collect()
}

fn dot(spec: &Spec, plan: &Plan) -> String {
    let mut text = String::from("digraph lenses {\n  rankdir = BT;\n  node [shape = box, style = rounded];\n");
    for (rank, lens) in plan.lenses.iter().enumerate() {
        let filters: Vec<&str> = lens.filter_names().collect();
        text += &format!("  \"{}\" [label = \"{}. {}\\n{}\"];\n", lens.name, rank + 1, lens.name, filters.join(", "));
    }
    for lens in spec.lenses.iter().filter(|l| !l.enabled) {
        text += &format!("  \"{}\" [style = dashed];\n", lens.name.value);
    }
    for (below, above, label) in edges(spec, plan) {
        text += &format!("  \"{below}\" -> \"{above}\" [label = \"{label}\"];\n");
    }
    text + "}\n"
}

fn mermaid(spec: &Spec, plan: &Plan) -> String {
    let mut text = String::from("flowchart BT\n");
    for (index, lens) in spec.lenses.iter().enumerate() {
        let name = &lens.name.value;
        match plan.lenses.iter().position(|l| l.index == index) {
            Some(rank) => text += &format!("  l{index}[\"{}. {name}\"]\n", rank + 1),
            None => text += &format!("  l{index}[\"{name} (disabled)\"]\n"),
        }
    }
    let number = |name: &str| spec.lenses.iter().position(|l| l.name.value == name).unwrap_or_default();
    for (below, above, label) in edges(spec, plan) {
        text += &format!("  l{} -->|\"{label}\"| l{}\n", number(&below), number(&above));
    }
    text
}
