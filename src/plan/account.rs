//! The plan as an account: order, undecided pairs, regions, each with its reasons.

use super::{Plan, Reason, Region, commute};
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
        let undecided = undecided(plan, &regions);
        let order = (1..plan.lenses.len()).map(|rank| plan.reason(spec, rank - 1, rank)).collect();
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
        let mut text = format!("regions that occur: {}\n", self.regions.len());
        for region in &self.regions {
            let stack: Vec<String> = region
                .stack
                .iter()
                .map(|rank| {
                    let lens = &plan.lenses[rank];
                    format!("{} ({})", lens.name, lens.filter_names().collect::<Vec<_>>().join(", "))
                })
                .collect();
            text += &format!("  {}\n      stack: {}\n", plan.names(region.set).join(" + "), stack.join(" < "));
            for (hidden, by) in region.hidden(plan) {
                let how = if plan.lenses[by].overrides { "overrides it" } else { "hides it" };
                let why = plan.reason(spec, hidden, by);
                let (hidden, by) = (&plan.lenses[hidden].name, &plan.lenses[by].name);
                text += &format!("      hidden: {hidden}, for {by} {how} ({why})\n");
            }
            let ranks: Vec<usize> = region.stack.iter().collect();
            for pair in ranks.windows(2) {
                let why = plan.reason(spec, pair[0], pair[1]);
                let (below, above) = (&plan.lenses[pair[0]].name, &plan.lenses[pair[1]].name);
                text += &format!("      {below} < {above}: {why}\n");
            }
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

fn undecided(plan: &Plan, regions: &[Region]) -> Vec<Undecided> {
    let mut pairs = Vec::new();
    for above in 0..plan.lenses.len() {
        for below in 0..above {
            let meet = || regions.iter().any(|r| r.set.contains(below) && r.set.contains(above));
            let (low, high) = (&plan.lenses[below], &plan.lenses[above]);
            if !commute(low, high) && meet() && plan.only_file_order(below, above) {
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
