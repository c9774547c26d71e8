//! `lenspeel explain`.

use serde_json::{Value, json};

use super::args::{ExplainArgs, ExplainFormat};
use crate::InputError;
use crate::cpu::{self, PixelReport};
use crate::plan::{Account, LensSet, Plan, filter_name};
use crate::scene::Scene;
use crate::spec::Spec;

pub fn run(args: &ExplainArgs) -> Result<(), InputError> {
    let spec = Spec::load(&args.spec)?;
    let scene = Scene::open(&spec)?;
    let plan = Plan::new(&spec, &scene)?;
    if let Some([x, y]) = args.pixel {
        let [width, height] = plan.view.size;
        if x >= width || y >= height {
            let message = format!("the picture has {width} x {height} pixels, so there is no pixel {x},{y}");
            return Err(InputError::new(message).help("columns and rows count from 0 at the top left"));
        }
        let report = cpu::Renderer::new(&scene, &plan).explain(x, y);
        super::print(&match args.format {
            ExplainFormat::Json => pretty(&pixel_json(&scene, &plan, [x, y], &report)),
            _ => pixel_text(&scene, &plan, [x, y], &report),
        });
        return Ok(());
    }
    super::print(&match args.format {
        ExplainFormat::Text => Account::new(&spec, &plan).text(&spec, &plan),
        ExplainFormat::Json => pretty(&json(&spec, &plan)),
        ExplainFormat::Dot => dot(&spec, &plan),
        ExplainFormat::Mermaid => mermaid(&spec, &plan),
    });
    Ok(())
}

fn pretty(value: &Value) -> String {
    serde_json::to_string_pretty(value).unwrap_or_default() + "\n"
}

fn json(spec: &Spec, plan: &Plan) -> Value {
    let account = Account::new(spec, plan);
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
            let hidden: Vec<Value> = region
                .hidden(plan)
                .into_iter()
                .map(|(lens, by)| json!({ "lens": plan.lenses[lens].name, "by": plan.lenses[by].name }))
                .collect();
            json!({ "lenses": plan.names(region.set), "stack": stack_json(plan, region.stack), "hidden": hidden })
        })
        .collect();
    let undecided: Vec<Value> =
        account.undecided.iter().map(|u| json!({ "below": u.below, "above": u.above, "remedy": u.remedy })).collect();
    json!({ "order": order, "regions": regions, "undecided": undecided, "warnings": plan.warnings })
}

fn stack_json(plan: &Plan, stack: LensSet) -> Vec<Value> {
    stack
        .iter()
        .flat_map(|rank| {
            let lens = &plan.lenses[rank];
            lens.filters.iter().map(|f| json!({ "lens": lens.name, "filter": filter_name(f) }))
        })
        .collect()
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

fn pixel_text(scene: &Scene, plan: &Plan, [x, y]: [u32; 2], report: &PixelReport) -> String {
    let set = |set: LensSet| if set.is_empty() { "no lens".into() } else { plan.names(set).join(" + ") };
    let mut text = format!("pixel {x},{y}: {} layers\n", report.layers.count());
    for (i, start) in report.layers.starts.iter().enumerate() {
        let end = report.layers.starts.get(i + 1).map_or(plan.view.far, |next| next.depth);
        text += &format!("  {:12.5} .. {:12.5}  {}\n", start.depth, end, set(start.set));
    }
    text += &format!("fragments that survive, nearest first: {}\n", report.fragments.len());
    for (fragment, opacity, coverage) in &report.fragments {
        let (node, material) = names(scene, plan, fragment.item);
        let stack: Vec<String> = fragment.stack.iter().map(|rank| plan.lenses[rank].name.clone()).collect();
        let visible = report.visible.is_some_and(|v| v.fragment == *fragment);
        text += &format!(
            "  {:12.5}  {node} ({material}), triangle {}: in {}; stack {}; opacity {opacity:.3}, coverage {coverage:.3}{}\n",
            fragment.depth,
            fragment.triangle,
            set(fragment.set),
            if stack.is_empty() { "none".into() } else { stack.join(" < ") },
            if visible { "  <- visible" } else { "" },
        );
    }
    text
}

fn pixel_json(scene: &Scene, plan: &Plan, pixel: [u32; 2], report: &PixelReport) -> Value {
    let layers: Vec<Value> =
        report.layers.starts.iter().map(|s| json!({ "depth": s.depth, "lenses": plan.names(s.set) })).collect();
    let fragments: Vec<Value> = report
        .fragments
        .iter()
        .map(|(fragment, opacity, coverage)| {
            let (node, material) = names(scene, plan, fragment.item);
            json!({
                "depth": fragment.depth,
                "node": node,
                "material": material,
                "triangle": fragment.triangle,
                "lenses": plan.names(fragment.set),
                "stack": stack_json(plan, fragment.stack),
                "opacity": opacity,
                "coverage": coverage,
                "visible": report.visible.is_some_and(|v| v.fragment == *fragment),
            })
        })
        .collect();
    json!({ "pixel": pixel, "layers": layers, "fragments": fragments })
}

/// Names of an item's node and material; numbers where the file gives none.
fn names(scene: &Scene, plan: &Plan, item: u32) -> (String, String) {
    let item = &plan.items[item as usize];
    let model = &scene.models[item.model];
    let or_number = |name: &str, kind: &str, i: usize| {
        if name.is_empty() { format!("{kind} {i}") } else { name.to_string() }
    };
    let material = item.material - scene.material_base[item.model];
    (
        or_number(&model.nodes[item.node].name, "node", item.node),
        or_number(&model.materials[material].name, "material", material),
    )
}
