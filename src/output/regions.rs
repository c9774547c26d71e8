//! The region AOV: which region each pixel's visible fragment lies in, and what acts there.

use std::collections::BTreeSet;

use crate::InputError;
use crate::frame::Aovs;
use crate::plan::{LensSet, Plan, filter_name, survivors};

/// Stands in a region map where there is no fragment.
pub const NOTHING: u16 = u16::MAX;

/// A region that a picture found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundRegion {
    /// From 1; 0 is the plain scene.
    pub id: u16,
    pub set: LensSet,
    /// Names, sorted.
    pub lenses: Vec<String>,
    /// Lens and filter, lowest first.
    pub stack: Vec<(String, &'static str)>,
}

/// Region numbers for each pixel and what they mean.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RegionMap {
    pub ids: Vec<u16>,
    pub regions: Vec<FoundRegion>,
}

impl RegionMap {
    /// Numbers the regions of a picture in the order of their sorted lens names; an error where 16 bits do not
    /// tell them apart.
    pub fn new(plan: &Plan, aovs: &Aovs) -> Result<Self, InputError> {
        let found: BTreeSet<LensSet> = aovs.sets.iter().flatten().copied().filter(|s| !s.is_empty()).collect();
        if found.len() >= usize::from(NOTHING) {
            let message =
                format!("the picture has {} regions, and a region map tells {} apart", found.len(), NOTHING - 1);
            return Err(InputError::new(message).help("leave out `--aov region`"));
        }
        let mut named: Vec<(Vec<&str>, LensSet)> = found.into_iter().map(|set| (plan.names(set), set)).collect();
        named.sort();
        let regions: Vec<FoundRegion> = (1u16..)
            .zip(named)
            .map(|(id, (names, set))| FoundRegion {
                id,
                set,
                lenses: names.into_iter().map(String::from).collect(),
                stack: stack(plan, set),
            })
            .collect();
        let number: std::collections::HashMap<LensSet, u16> = regions.iter().map(|r| (r.set, r.id)).collect();
        let id = |set: &Option<LensSet>| match set {
            None => NOTHING,
            Some(set) => number.get(set).copied().unwrap_or(0),
        };
        Ok(Self { ids: aovs.sets.iter().map(id).collect(), regions })
    }

    /// The table beside the map.
    pub fn json(&self) -> serde_json::Value {
        let entry = |(lens, filter): &(String, &str)| serde_json::json!({ "lens": lens, "filter": filter });
        self.regions
            .iter()
            .map(|region| {
                serde_json::json!({
                    "id": region.id,
                    "lenses": region.lenses,
                    "stack": region.stack.iter().map(entry).collect::<Vec<_>>(),
                })
            })
            .collect()
    }
}

/// Every filter that acts in a region, content filters too, lowest first.
pub fn stack(plan: &Plan, set: LensSet) -> Vec<(String, &'static str)> {
    let acting = survivors(&plan.lenses, set);
    let of_lens = |rank: usize| {
        let lens = &plan.lenses[rank];
        lens.filters.iter().map(|f| (lens.name.clone(), filter_name(f)))
    };
    acting.iter().flat_map(of_lens).collect()
}
