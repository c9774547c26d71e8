//! The account as JSON. Fields are added in later versions, never renamed or removed.

use serde::ser::{Serialize, SerializeStruct, Serializer};

use super::{Coverage, Explanation};
use crate::output::Entry;
use crate::plan::{LensSet, Reasons, Region};
use crate::spec::Spec;

/// An object with `order` (lowest first), `view` (null without a picture), `regions`, `untold` (how many more regions occur,
/// none of them in view), `ended` (why the search for regions ended early, or null), `undecided`, `warnings`.
impl Serialize for Explanation<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_struct("Explanation", 7)?;
        object.serialize_field("order", &self.order_json())?;
        object.serialize_field("view", &self.coverage.as_ref().map(view_json))?;
        object.serialize_field("regions", &RegionList(self))?;
        object.serialize_field("untold", &self.untold)?;
        object.serialize_field("ended", &self.account.ended.map(|ended| ended.to_string()))?;
        object.serialize_field("undecided", &self.account.undecided)?;
        object.serialize_field("warnings", &self.plan.warnings)?;
        object.end()
    }
}

/// A lens in the total order.
#[derive(serde::Serialize)]
struct OrderedLens<'a> {
    lens: &'a str,
    /// Of the spec, from 1.
    line: usize,
    filters: Vec<&'static str>,
    overrides: bool,
    /// Sorted; all below for one that overrides.
    hides: Vec<&'a str>,
    /// Null for the lowest.
    above_previous_because: Option<String>,
    /// Null without a picture.
    in_view: Option<InViewJson>,
}

/// What a lens does in a picture.
#[derive(serde::Serialize)]
struct InViewJson {
    /// Where it acts on the visible fragment.
    visible: Share,
    /// Where it acts on something that is seen through.
    seen_through: Share,
    /// Where it takes something away in front of what is visible.
    removes: Share,
}

/// A picture as a whole.
#[derive(serde::Serialize)]
struct ViewJson<'a> {
    size: [u32; 2],
    backend: &'a str,
    /// Outside all lenses, where no rule acts.
    plain: Share,
    nothing: Share,
}

#[derive(serde::Serialize)]
struct Share {
    pixels: u64,
    /// Of the whole picture.
    percent: f64,
}

/// A region that occurs.
#[derive(serde::Serialize)]
struct RegionJson<'a> {
    id: usize,
    /// Sorted.
    lenses: Vec<&'a str>,
    /// Lowest first.
    stack: Vec<Entry>,
    /// Of the rule that acts, from 1; null where lenses act.
    rule_line: Option<usize>,
    hidden: Vec<HiddenJson<'a>>,
    order: Vec<NeighboursJson<'a>>,
    /// Of the picture; null without one.
    #[serde(flatten)]
    share: Option<Share>,
    /// Where something of it is seen through; null without a picture.
    seen_through: Option<Share>,
}

/// A lens of a region that does not act there.
#[derive(serde::Serialize)]
pub(super) struct HiddenJson<'a> {
    lens: &'a str,
    by: &'a str,
    because: String,
}

/// Two neighbours of a stack.
#[derive(serde::Serialize)]
pub(super) struct NeighboursJson<'a> {
    below: &'a str,
    above: &'a str,
    because: String,
}

/// The regions, each made only when it is written: there may be very many.
struct RegionList<'a>(&'a Explanation<'a>);

impl Serialize for RegionList<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let explanation = self.0;
        let plan = explanation.plan;
        let reasons = Reasons::new(explanation.spec, plan);
        serializer.collect_seq(explanation.regions.iter().map(|(id, region)| RegionJson {
            id: *id,
            lenses: plan.names(region.set),
            stack: crate::output::stack(plan, *region),
            rule_line: region.rule(plan).map(|rule| plan.rules[rule].line),
            hidden: hidden_json(&reasons, region),
            order: order_json(&reasons, region.stack),
            share: explanation.coverage.as_ref().map(|coverage| Share::new(coverage, coverage.pixels(region))),
            seen_through: explanation.coverage.as_ref().map(|c| Share::new(c, c.seen_through(region))),
        }))
    }
}

impl Share {
    fn new(coverage: &Coverage, pixels: u64) -> Self {
        Self { pixels, percent: coverage.percent(pixels) }
    }
}

impl Explanation<'_> {
    fn order_json(&self) -> Vec<OrderedLens<'_>> {
        let line = |spec: &Spec, index: usize| spec.source.line(spec.lenses[index].name.span.start);
        let lens = |(rank, lens): (usize, &'_ crate::plan::Lens)| OrderedLens {
            lens: self.plan.lenses[rank].name.as_str(),
            line: line(self.spec, lens.index),
            filters: lens.filter_names().collect(),
            overrides: lens.overrides,
            hides: self.plan.names(lens.hides),
            above_previous_because: rank.checked_sub(1).map(|below| self.account.order[below].to_string()),
            in_view: self.coverage.as_ref().map(|coverage| InViewJson {
                visible: Share::new(coverage, coverage.acts(rank)),
                seen_through: Share::new(coverage, coverage.in_front.seen_through[rank]),
                removes: Share::new(coverage, coverage.in_front.removes[rank]),
            }),
        };
        self.plan.lenses.iter().enumerate().map(lens).collect()
    }
}

fn view_json(coverage: &Coverage) -> ViewJson<'_> {
    ViewJson {
        size: coverage.size,
        backend: &coverage.backend,
        plain: Share::new(coverage, coverage.pixels(&Region::PLAIN)),
        nothing: Share::new(coverage, coverage.nothing),
    }
}

pub(super) fn hidden_json<'a>(reasons: &Reasons<'a>, region: &Region) -> Vec<HiddenJson<'a>> {
    let hidden = reasons.hidden(region);
    hidden.map(|h| HiddenJson { lens: h.lens, by: h.by, because: h.because.to_string() }).collect()
}

/// Why each lens of a stack is above the one before it.
pub(super) fn order_json<'a>(reasons: &Reasons<'a>, stack: LensSet) -> Vec<NeighboursJson<'a>> {
    let neighbours = reasons.neighbours(stack);
    neighbours.map(|n| NeighboursJson { below: n.below, above: n.above, because: n.because.to_string() }).collect()
}
