//! What one view ray meets, and why.

use std::fmt::{self, Display, Formatter};

use glam::DVec3;
use serde::Serialize;

use super::json::{HiddenJson, NeighboursJson, hidden_json, order_json};
use super::{actor, lenses};
use crate::output::{Actor, Entry};
use crate::pick::{NamedSurface, places};
use crate::pixel::{Fragment, PixelReport, Removed, Survivor, cap_maker};
use crate::plan::{LensSet, Plan, Reasons, Region, filter_name};
use crate::printable;
use crate::scene::{Scene, Selections};
use crate::spec::{By, Filter, Matches, Spec};
use crate::words::count_of;

/// A pixel's report with all that its account needs. `Display` gives the text, `Serialize` the JSON.
pub struct PixelAccount<'a> {
    pub spec: &'a Spec,
    pub scene: &'a Scene,
    pub plan: &'a Plan,
    /// Column and row.
    pub pixel: [u32; 2],
    pub report: &'a PixelReport,
    /// Whose report it is, in a word.
    pub backend: &'a str,
}

impl Display for PixelAccount<'_> {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        let Self { plan, pixel: [x, y], report, backend, .. } = self;
        let [width, height] = plan.view.size;
        writeln!(f, "pixel {x},{y} of {width} x {height} ({backend}): {}", count_of(report.layers.len(), "layer"))?;
        writeln!(f, "  {:>12}    {:>12}  lenses around the ray", "from depth", "to")?;
        for (start, end) in self.stretches() {
            let region = Region { set: start.set, stack: plan.stack_of(start.set) };
            let [from, to] = [start.depth, end].map(|depth| plan.view.from_eye(depth));
            write!(f, "  {from:12.5} .. {to:12.5}  {}", lenses(plan, &region))?;
            if region == Region::PLAIN { writeln!(f)? } else { writeln!(f, "; stack {}", self.stack_text(&region))? }
        }
        let reasons = Reasons::new(self.spec, plan);
        writeln!(f, "fragments that survive, nearest first: {}", report.fragments.len())?;
        for survivor in &report.fragments {
            let Survivor { fragment, opacity, coverage } = survivor;
            let visible = if self.is_visible(fragment) { "  <- visible" } else { "" };
            let more = format!("; opacity {opacity:.3}, coverage {coverage:.3}{visible}");
            self.write_fragment(fragment, &more, "", &reasons, f)?;
        }
        if !report.removed.is_empty() {
            writeln!(f, "fragments in front that lenses remove, nearest first: {}", report.removed.len())?;
        }
        for removed in &report.removed {
            let remover = |rank| format!("{} ({})", actor(plan, rank), self.remover(rank));
            let by: Vec<String> = removed.by.iter().map(remover).collect();
            self.write_fragment(&removed.fragment, "", &format!("; removed by {}", by.join(", ")), &reasons, f)?;
        }
        Ok(())
    }
}

impl PixelAccount<'_> {
    /// The layers, each with the depth at which it ends.
    fn stretches(&self) -> impl Iterator<Item = (crate::lens::LayerStart, f64)> {
        let starts = &self.report.layers;
        let ends = starts.iter().skip(1).map(|start| start.depth).chain([self.plan.view.far]);
        starts.iter().copied().zip(ends)
    }

    fn is_visible(&self, fragment: &Fragment) -> bool {
        self.report.visible.is_some_and(|visible| visible.fragment == *fragment)
    }

    fn stack_text(&self, region: &Region) -> String {
        let stack: Vec<String> = region.stack.iter().map(|rank| actor(self.plan, rank)).collect();
        if stack.is_empty() { "none".into() } else { stack.join(" < ") }
    }

    /// A line for the surface, one for its lenses, one for where it is moved from, and one for each reason.
    fn write_fragment(
        &self,
        fragment: &Fragment,
        more: &str,
        removed: &str,
        reasons: &Reasons,
        f: &mut Formatter<'_>,
    ) -> fmt::Result {
        const INDENT: &str = "                ";
        let Fragment { instance, triangle, region, .. } = *fragment;
        let depth = self.plan.view.from_eye(f64::from(fragment.depth));
        let surface = NamedSurface::new(self.scene, self.plan, instance, triangle, region);
        let [node, material] = [&surface.node.name, &surface.material.name].map(|name| printable::whole_name(name));
        let what = match cap_maker(triangle) {
            Some(maker) => format!("cap of {}", actor(self.plan, maker)),
            None => format!("triangle {triangle}"),
        };
        writeln!(f, "  {depth:12.5}  {node} ({material}), {what}{more}")?;
        writeln!(f, "{INDENT}in {}; stack {}{removed}", lenses(self.plan, &region), self.stack_text(&region))?;
        if !surface.moved_by.is_empty() {
            let place = places(self.plan, self.pixel, instance, depth).1;
            writeln!(f, "{INDENT}moved by {} from {}", surface.moved_by.join(", "), point_text(place))?;
        }
        if let Some(maker) = cap_maker(triangle) {
            let below = region.set & self.plan.below_cap(maker);
            if !below.is_empty() {
                let by = actor(self.plan, maker);
                writeln!(f, "{INDENT}a cap keeps the look of {by}: not on it {}", self.plan.names(below).join(", "))?;
            }
        }
        for NotThere { lens, because } in self.not_there(fragment) {
            writeln!(f, "{INDENT}not in {lens}: {because}")?;
        }
        f.write_str(&reasons.lines(&region, INDENT))
    }

    /// The lenses that are around the ray at a fragment, but not there for it, and why.
    fn not_there(&self, fragment: &Fragment) -> Vec<NotThere<'_>> {
        let item = &self.plan.items[self.plan.instances[fragment.instance as usize].item];
        let depth = f64::from(fragment.depth);
        let around = self.report.layers.iter().rev().find(|start| start.depth <= depth);
        let around = around.map_or(LensSet::EMPTY, |start| start.set).minus(fragment.region.set);
        let known = Selections::default();
        let because = |rank: usize| {
            let lens = &self.spec.lenses[self.plan.lenses[rank].index];
            let place = |matches: &Matches| {
                let first = matches.nodes.iter().chain(&matches.materials).map(|p| p.span.start).min();
                self.spec.source.spot(first.unwrap_or_default())
            };
            if !item.scope.contains(rank) && !item.shown_by.contains(rank) {
                return Some(match item.subject(self.scene, &known).is_in(&lens.except) {
                    true => format!("its `except` in {} names this node or material", place(&lens.except)),
                    false => {
                        format!("its `only` in {} names neither this node nor its material", place(&lens.only))
                    }
                });
            }
            let by_object = lens.by == By::Object && !item.object.contains(rank);
            by_object.then(|| "it takes whole objects, and this one's centre is outside".into())
        };
        let lenses = around.iter().filter_map(|rank| Some((self.plan.lenses.get(rank)?, because(rank)?)));
        lenses.map(|(lens, because)| NotThere { lens: &lens.name, because }).collect()
    }

    /// The filter by which a lens takes a fragment away; one that shows something replaces all the rest.
    fn remover(&self, rank: usize) -> &'static str {
        let filters = self.plan.filters_of(rank);
        let by = |wanted: fn(&Filter) -> bool| filters.iter().find(|filter| wanted(filter)).map(filter_name);
        by(|f| matches!(f, Filter::Show(_)))
            .or(by(|f| matches!(f, Filter::Erase { .. })))
            .or(by(|f| matches!(f, Filter::Lod { .. })))
            .or(by(Filter::moves))
            .unwrap_or("nothing")
    }

    fn remover_entry(&self, rank: usize) -> Entry {
        Entry { by: Actor::of(self.plan, rank), filter: self.remover(rank) }
    }

    fn fragment_json<'a>(&'a self, fragment: &Fragment, reasons: &Reasons<'a>) -> FragmentJson<'a> {
        let Fragment { instance, triangle, region, .. } = *fragment;
        let depth = self.plan.view.from_eye(f64::from(fragment.depth));
        let (position, place) = places(self.plan, self.pixel, instance, depth);
        FragmentJson {
            surface: NamedSurface::new(self.scene, self.plan, instance, triangle, region),
            depth: depth as f32,
            position,
            place,
            rule_line: region.rule(self.plan).map(|rule| self.plan.rules[rule].line),
            hidden: hidden_json(reasons, &region),
            order: order_json(reasons, region.stack),
            not_in: self.not_there(fragment),
        }
    }
}

/// As text, with as many digits as a depth has.
pub fn point_text(p: DVec3) -> String {
    format!("({:.5} {:.5} {:.5})", p.x, p.y, p.z)
}

#[derive(Serialize)]
struct PixelJson<'a> {
    pixel: [u32; 2],
    size: [u32; 2],
    backend: &'a str,
    layers: Vec<LayerJson<'a>>,
    /// Those that survive, nearest first.
    fragments: Vec<SurvivorJson<'a>>,
    /// In front of the visible one, nearest first.
    removed: Vec<RemovedJson<'a>>,
}

#[derive(Serialize)]
struct LayerJson<'a> {
    /// Where it starts and ends.
    depth: f64,
    end: f64,
    lenses: Vec<&'a str>,
    /// Of a surface to which all its lenses apply.
    stack: Vec<Entry>,
}

#[derive(Serialize)]
struct FragmentJson<'a> {
    #[serde(flatten)]
    surface: NamedSurface<'a>,
    depth: f32,
    /// Where it is shown.
    position: DVec3,
    /// Where it stands in the scene.
    place: DVec3,
    rule_line: Option<usize>,
    hidden: Vec<HiddenJson<'a>>,
    order: Vec<NeighboursJson<'a>>,
    /// Lenses around the ray that are not there for it.
    not_in: Vec<NotThere<'a>>,
}

/// A lens that is around the ray but not there for a fragment.
#[derive(Serialize)]
struct NotThere<'a> {
    lens: &'a str,
    because: String,
}

#[derive(Serialize)]
struct SurvivorJson<'a> {
    #[serde(flatten)]
    fragment: FragmentJson<'a>,
    opacity: f32,
    coverage: f32,
    visible: bool,
}

#[derive(Serialize)]
struct RemovedJson<'a> {
    #[serde(flatten)]
    fragment: FragmentJson<'a>,
    removed_by: Vec<Entry>,
}

impl Serialize for PixelAccount<'_> {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let reasons = Reasons::new(self.spec, self.plan);
        let layer = |(start, end): (crate::lens::LayerStart, f64)| LayerJson {
            depth: self.plan.view.from_eye(start.depth),
            end: self.plan.view.from_eye(end),
            lenses: self.plan.names(start.set),
            stack: crate::output::stack(self.plan, Region { set: start.set, stack: self.plan.stack_of(start.set) }),
        };
        let survivor = |survivor: &Survivor| SurvivorJson {
            fragment: self.fragment_json(&survivor.fragment, &reasons),
            opacity: survivor.opacity,
            coverage: survivor.coverage,
            visible: self.is_visible(&survivor.fragment),
        };
        let removed = |removed: &Removed| RemovedJson {
            fragment: self.fragment_json(&removed.fragment, &reasons),
            removed_by: removed.by.iter().map(|rank| self.remover_entry(rank)).collect(),
        };
        PixelJson {
            pixel: self.pixel,
            size: self.plan.view.size,
            backend: self.backend,
            layers: self.stretches().map(layer).collect(),
            fragments: self.report.fragments.iter().map(survivor).collect(),
            removed: self.report.removed.iter().map(removed).collect(),
        }
        .serialize(serializer)
    }
}
