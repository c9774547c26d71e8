//! The plan as an account: order, undecided pairs, regions, each with its reasons.

use super::{Ended, LensSet, Plan, Reason, Reasons, Region, RegionSearch, commute};
use crate::spec::Spec;

/// Two lenses whose order matters and that only the order of the file separates.
#[derive(Debug, Clone, PartialEq, Eq, serde::Serialize)]
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
    /// Why the search for regions ended before it had looked everywhere.
    pub ended: Option<Ended>,
    pub undecided: Vec<Undecided>,
    /// For each lens but the lowest: why it is above the one before it.
    pub order: Vec<Reason>,
}

impl Account {
    pub fn new(spec: &Spec, plan: &Plan) -> Self {
        let RegionSearch { regions, ended } = plan.regions();
        let reasons = Reasons::new(spec, plan);
        let undecided = undecided(plan, &regions, &reasons);
        let order = (1..plan.lenses.len()).map(|rank| reasons.between(rank - 1, rank).as_ref().clone()).collect();
        Self { regions, ended, undecided, order }
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
