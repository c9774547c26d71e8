//! The plan as an account: order, undecided pairs, regions, each with its reasons.

use super::{LensSet, Plan, Reason, Reasons, Region, commute};
use crate::spec::Spec;

/// Two lenses whose order matters and that only the order of the file separates.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Undecided {
    pub below: String,
    pub above: String,
    /// What to add, and to which lens.
    pub remedy: String,
}

/// All that `explain` and `check` tell about a spec, worked out once.
#[derive(Debug, Clone)]
pub struct Account {
    pub regions: Vec<Region>,
    pub undecided: Vec<Undecided>,
    /// For each lens but the lowest: why it is above the one before it.
    pub order: Vec<Reason>,
}

impl Account {
    pub fn new(spec: &Spec, plan: &Plan) -> Self {
        let regions = plan.regions();
        let reasons = Reasons::new(spec, plan);
        let undecided = undecided(plan, &regions, &reasons);
        let order = (1..plan.lenses.len()).map(|rank| reasons.between(rank - 1, rank).as_ref().clone()).collect();
        Self { regions, undecided, order }
    }

    /// The account as text, with the lines of the spec.
    pub fn text(&self, spec: &Spec, plan: &Plan) -> String {
        let mut text = String::from("order, lowest first\n");
        for (rank, lens) in plan.lenses.iter().enumerate() {
            let line = spec.source.line(spec.lenses[lens.index].name.span.start);
            let filters: Vec<&str> = lens.filter_names().collect();
            text += &format!("  {}. {} (line {line}): {}", rank + 1, lens.name, filters.join(", "));
            if lens.overrides {
                text += "; overrides all below";
            } else if !lens.hides.is_empty() {
                text += &format!("; hides {}", plan.names(lens.hides).join(", "));
            }
            text += "\n";
            if rank > 0 {
                text += &format!("       above {}: {}\n", plan.lenses[rank - 1].name, self.order[rank - 1]);
            }
        }
        if plan.lenses.is_empty() {
            text += "  no lens is enabled\n";
        }
        text += &self.regions_text(spec, plan);
        text += &self.undecided_text();
        for warning in &plan.warnings {
            text += &format!("warning: {warning}\n");
        }
        text
    }

    fn regions_text(&self, spec: &Spec, plan: &Plan) -> String {
        let reasons = Reasons::new(spec, plan);
        let mut text = format!("regions that occur: {}\n", self.regions.len());
        let name = |rank: usize| match plan.rule_of(rank) {
            Some(rule) => format!("rule in line {}", spec.source.line(spec.overlaps[rule].when.span.start)),
            None => plan.lenses[rank].name.clone(),
        };
        let acting = |rank| format!("{} ({})", name(rank), plan.filter_names(rank).collect::<Vec<_>>().join(", "));
        let acting: Vec<String> = (0..plan.lenses.len() + plan.rules.len()).map(acting).collect();
        for region in &self.regions {
            let stack: Vec<&str> = region.stack.iter().map(|rank| acting[rank].as_str()).collect();
            let lenses = if region.set.is_empty() { "no lens".into() } else { plan.names(region.set).join(" + ") };
            text += &format!("  {lenses}\n      stack: {}\n", stack.join(" < "));
            text += &reasons.lines(region, "      ");
        }
        text
    }

    /// One paragraph a pair, or nothing.
    pub fn undecided_text(&self) -> String {
        self.undecided
            .iter()
            .map(|u| {
                format!("undecided: only the order of the file puts {} below {}: {}\n", u.below, u.above, u.remedy)
            })
            .collect()
    }
}

fn undecided(plan: &Plan, regions: &[Region], reasons: &Reasons) -> Vec<Undecided> {
    let mut pairs = Vec::new();
    for (above, met) in met_below(plan.lenses.len(), regions).into_iter().enumerate() {
        for below in met.iter() {
            let (low, high) = (&plan.lenses[below], &plan.lenses[above]);
            if !commute(low, high) && reasons.only_file_order(below, above) {
                pairs.push(Undecided {
                    below: low.name.clone(),
                    above: high.name.clone(),
                    remedy: format!("add `over = [\"{}\"]` to lens `{}`", low.name, high.name),
                });
            }
        }
    }
    pairs
}

/// For each rank the lower ranks that it shares some region with.
fn met_below(lenses: usize, regions: &[Region]) -> Vec<LensSet> {
    let mut met = vec![LensSet::EMPTY; lenses];
    for region in regions {
        region.set.iter().for_each(|rank| met[rank] = met[rank] | (region.set & LensSet::below(rank)));
    }
    met
}
