//! `lenspeel explain --pixel`: what one view ray meets, and why.

use serde_json::{Value, json};

use super::{hidden_json, order_json, stack_json};
use crate::cpu::{Fragment, PixelReport, Removed, Renderer};
use crate::plan::{LensSet, Plan, Reasons, filter_name};
use crate::scene::Scene;
use crate::spec::{Filter, Spec};

/// One pixel with all that its account needs.
pub struct PixelAccount<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    reasons: Reasons<'a>,
    pixel: [u32; 2],
    report: PixelReport,
    /// Nearer than the visible fragment.
    removed: Vec<Removed>,
}

impl<'a> PixelAccount<'a> {
    pub fn new(spec: &'a Spec, scene: &'a Scene, plan: &'a Plan, pixel @ [x, y]: [u32; 2]) -> Self {
        let renderer = Renderer::new(scene, plan);
        let report = renderer.explain(x, y);
        let end = report.visible.map_or(f32::INFINITY, |visible| visible.fragment.depth);
        let removed = renderer.removed(x, y, end);
        Self { scene, plan, reasons: Reasons::new(spec, plan), pixel, report, removed }
    }

    pub fn text(&self) -> String {
        let [x, y] = self.pixel;
        let layers = &self.report.layers;
        let mut text = format!("pixel {x},{y}: {} layers\n", layers.count());
        for (i, start) in layers.starts.iter().enumerate() {
            let end = layers.starts.get(i + 1).map_or(self.plan.view.far, |next| next.depth);
            text += &format!("  {:12.5} .. {:12.5}  {}\n", start.depth, end, self.set_text(start.set));
        }
        text += &format!("fragments that survive, nearest first: {}\n", self.report.fragments.len());
        for (fragment, opacity, coverage) in &self.report.fragments {
            let visible = if self.is_visible(fragment) { "  <- visible" } else { "" };
            let more = format!("opacity {opacity:.3}, coverage {coverage:.3}{visible}");
            text += &self.fragment_text(fragment, &more);
        }
        if !self.removed.is_empty() {
            text += &format!("fragments in front that lenses remove, nearest first: {}\n", self.removed.len());
        }
        for removed in &self.removed {
            let by: Vec<String> = removed.by.iter().map(|rank| self.remover_text(rank)).collect();
            text += &self.fragment_text(&removed.fragment, &format!("removed by {}", by.join(", ")));
        }
        text
    }

    pub fn json(&self) -> Value {
        let layers: Vec<Value> = (self.report.layers.starts.iter())
            .map(|start| json!({ "depth": start.depth, "lenses": self.plan.names(start.set) }))
            .collect();
        let survivor = |(fragment, opacity, coverage): &(Fragment, f32, f32)| {
            let mut value = self.fragment_json(fragment);
            value["opacity"] = json!(opacity);
            value["coverage"] = json!(coverage);
            value["visible"] = json!(self.is_visible(fragment));
            value
        };
        let removed = |removed: &Removed| {
            let mut value = self.fragment_json(&removed.fragment);
            let by = removed.by.iter().map(|rank| json!({ "lens": self.actor(rank), "filter": self.remover(rank) }));
            value["removed_by"] = by.collect();
            value
        };
        json!({
            "pixel": self.pixel,
            "layers": layers,
            "fragments": self.report.fragments.iter().map(survivor).collect::<Vec<_>>(),
            "removed": self.removed.iter().map(removed).collect::<Vec<_>>(),
        })
    }

    fn is_visible(&self, fragment: &Fragment) -> bool {
        self.report.visible.is_some_and(|visible| visible.fragment == *fragment)
    }

    fn set_text(&self, set: LensSet) -> String {
        if set.is_empty() { "no lens".into() } else { self.plan.names(set).join(" + ") }
    }

    /// A line for a fragment and one for each reason.
    fn fragment_text(&self, fragment: &Fragment, more: &str) -> String {
        let (node, material) = self.names(fragment.instance);
        let stack: Vec<String> = fragment.region.stack.iter().map(|rank| self.actor(rank)).collect();
        let stack = if stack.is_empty() { "none".into() } else { stack.join(" < ") };
        let (depth, triangle, set) = (fragment.depth, fragment.triangle, self.set_text(fragment.region.set));
        format!("  {depth:12.5}  {node} ({material}), triangle {triangle}: in {set}; stack {stack}; {more}\n")
            + &self.reasons.lines(&fragment.region, "                  ")
    }

    fn fragment_json(&self, fragment: &Fragment) -> Value {
        let (node, material) = self.names(fragment.instance);
        let region = fragment.region;
        json!({
            "depth": fragment.depth,
            "node": node,
            "material": material,
            "triangle": fragment.triangle,
            "lenses": self.plan.names(fragment.region.set),
            "stack": stack_json(self.plan, region),
            "hidden": hidden_json(&self.reasons, &region),
            "order": order_json(&self.reasons, fragment.region.stack),
        })
    }

    fn remover_text(&self, rank: usize) -> String {
        format!("{} ({})", self.actor(rank), self.remover(rank))
    }

    fn actor(&self, rank: usize) -> String {
        match self.plan.rule_of(rank) {
            Some(rule) => format!("rule {rule}"),
            None => self.plan.lenses[rank].name.clone(),
        }
    }

    /// The filter by which a lens takes a fragment away; one that shows something replaces all the rest.
    fn remover(&self, rank: usize) -> &'static str {
        let filters = self.plan.filters_of(rank);
        let by = |wanted: fn(&Filter) -> bool| filters.iter().find(|filter| wanted(filter)).map(filter_name);
        by(|f| matches!(f, Filter::Show(_)))
            .or(by(|f| matches!(f, Filter::Erase { .. })))
            .or(by(Filter::moves))
            .unwrap_or("nothing")
    }

    /// Names of an instance's node and material; numbers where the file gives none.
    fn names(&self, instance: u32) -> (String, String) {
        let item = &self.plan.items[self.plan.instances[instance as usize].item];
        let model = &self.scene.models[item.model];
        let or_number = |name: &str, kind: &str, i: usize| {
            if name.is_empty() { format!("{kind} {i}") } else { name.to_string() }
        };
        let material = item.material - self.scene.material_base[item.model];
        (
            or_number(&model.nodes[item.node].name, "node", item.node),
            or_number(&model.materials[material].name, "material", material),
        )
    }
}
