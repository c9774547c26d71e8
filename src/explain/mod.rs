//! What `lenspeel explain` tells of a spec and of single pixels: as text, as JSON, and as graphs.

mod coverage;
mod graph;
mod json;
mod pixel;
mod text;

pub use coverage::Coverage;
pub use pixel::{PixelAccount, point_text};

use std::collections::HashSet;

use crate::frame::{Aovs, InFront};
use crate::limits::MAX_TOLD;
use crate::output::Actor;
use crate::plan::{Account, Plan, Region};
use crate::spec::Spec;

/// A spec's account, with what a picture shows of it. `Display` gives the text, `Serialize` the JSON.
pub struct Explanation<'a> {
    pub spec: &'a Spec,
    pub plan: &'a Plan,
    pub account: &'a Account,
    /// The regions that are told of, each with its number in region maps.
    pub regions: Vec<(usize, Region)>,
    /// How many more occur: none of them is in view.
    pub untold: usize,
    pub coverage: Option<Coverage>,
}

impl<'a> Explanation<'a> {
    pub fn new(spec: &'a Spec, plan: &'a Plan, account: &'a Account) -> Self {
        Self { spec, plan, account, regions: Vec::new(), untold: 0, coverage: None }.telling(&[])
    }

    /// Adds what a picture of the plan shows: how much of it each region takes, what lies in front of that, and regions that
    /// only the picture found. `backend` is who made it, in a word.
    pub fn in_view(self, aovs: &Aovs, in_front: InFront, backend: &str) -> Self {
        let mut seen: Vec<Region> = in_front.regions.keys().copied().chain(aovs.table.iter().copied()).collect();
        seen.sort_unstable();
        seen.dedup();
        let coverage = Some(Coverage::new(self.plan.view.size, aovs, in_front, backend));
        Self { coverage, ..self }.telling(&seen)
    }

    /// Tells of all regions that are seen, and of so many others that one can read them.
    fn telling(self, seen: &[Region]) -> Self {
        let numbered = crate::output::numbered(self.plan, &self.account.regions, seen);
        let in_view: HashSet<&Region> = seen.iter().collect();
        let all = self.account.regions.iter().chain(seen).filter(|region| **region != Region::PLAIN);
        let all: HashSet<&Region> = all.collect();
        let mut others = 0;
        let is_told = |(_, region): &(usize, Region)| {
            others += usize::from(!in_view.contains(region));
            in_view.contains(region) || others <= MAX_TOLD
        };
        let regions: Vec<(usize, Region)> = numbered.into_iter().filter(is_told).collect();
        Self { untold: all.len() - regions.len(), regions, ..self }
    }
}

/// Who acts at a rank of a stack: a lens by name, or a rule by its line.
fn actor(plan: &Plan, rank: usize) -> String {
    Actor::of(plan, rank).to_string()
}

/// The lenses of a set, or that there are none.
fn lenses(plan: &Plan, region: &Region) -> String {
    if region.set.is_empty() { "no lens".into() } else { plan.names(region.set).join(" + ") }
}
