//! What `lenspeel explain` tells of a spec and of single pixels: as text, as JSON, and as graphs.

mod coverage;
mod graph;
mod json;
mod pixel;
mod text;

pub use coverage::Coverage;
pub use pixel::{PixelAccount, point_text};

use crate::frame::{Aovs, InFront};
use crate::output::Actor;
use crate::plan::{Account, Plan, Region};
use crate::spec::Spec;

/// A spec's account, with what a picture shows of it. `Display` gives the text, `Serialize` the JSON.
pub struct Explanation<'a> {
    pub spec: &'a Spec,
    pub plan: &'a Plan,
    pub account: &'a Account,
    /// The regions that occur, each with its number in region maps.
    pub regions: Vec<(usize, Region)>,
    pub coverage: Option<Coverage>,
}

impl<'a> Explanation<'a> {
    pub fn new(spec: &'a Spec, plan: &'a Plan, account: &'a Account) -> Self {
        let regions = crate::output::numbered(plan, account.regions.iter());
        Self { spec, plan, account, regions, coverage: None }
    }

    /// Adds what a picture of the plan shows: how much of it each region takes, what lies in front of that, and regions that
    /// only the picture found. `backend` is who made it, in a word.
    pub fn in_view(self, aovs: &Aovs, in_front: InFront, backend: &str) -> Self {
        let found = self.account.regions.iter().chain(&aovs.table).chain(in_front.regions.keys());
        let regions = crate::output::numbered(self.plan, found);
        let coverage = Some(Coverage::new(self.plan.view.size, aovs, in_front, backend));
        Self { regions, coverage, ..self }
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
