//! The region AOV: which region each pixel's visible fragment lies in, and what acts there.

use std::collections::{HashMap, HashSet};

use serde::Serialize;

use crate::InputError;
use crate::frame::Aovs;
use crate::plan::{Plan, Region, filter_name};

/// Stands in a region map where there is no fragment.
pub const NOTHING: u16 = u16::MAX;

/// The most regions that a map numbers.
const MOST_NUMBERS: usize = NOTHING as usize - 1;

/// A region that a picture or a search found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct FoundRegion {
    /// From 1; 0 is outside all lenses.
    pub id: u16,
    pub region: Region,
    /// Names, sorted.
    pub lenses: Vec<String>,
    /// Lowest first.
    pub stack: Vec<Entry>,
}

/// A filter that acts in a region; as JSON with `lens` or `rule` beside `filter`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Entry {
    #[serde(flatten)]
    pub by: Actor,
    pub filter: &'static str,
}

/// Whose filter it is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "lowercase")]
pub enum Actor {
    Lens(String),
    Rule(NamedRule),
}

/// A rule: JSON has its number, people are told where it stands.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct NamedRule {
    /// Among the `[[overlap]]` of the file, from 0.
    pub number: usize,
    /// See [`Rule::name`](crate::plan::Rule::name).
    pub name: String,
}

impl Serialize for NamedRule {
    fn serialize<S: serde::Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        self.number.serialize(serializer)
    }
}

/// Region numbers for each pixel and what they mean.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RegionMap {
    pub ids: Vec<u16>,
    /// By id. The plain scene is not among them, but where a rule acts outside all lenses, region 0 is.
    pub regions: Vec<FoundRegion>,
}

impl RegionMap {
    /// Numbers the regions of a picture and, as far as there are numbers, those that `known` adds; an error where 16 bits do
    /// not tell apart what the picture shows.
    pub fn new(plan: &Plan, known: &[Region], aovs: &Aovs) -> Result<Self, InputError> {
        let numbered = numbered(plan, known, &aovs.table);
        if numbered.len() > MOST_NUMBERS {
            let message =
                format!("the picture shows {} regions, and a region map tells {MOST_NUMBERS} apart", numbered.len());
            return Err(InputError::new(message).help("leave out `--aov region`"));
        }
        let found = |(id, region): (usize, Region)| FoundRegion {
            id: id as u16,
            region,
            lenses: plan.names(region.set).into_iter().map(String::from).collect(),
            stack: stack(plan, region),
        };
        let regions: Vec<FoundRegion> = numbered.into_iter().map(found).collect();
        let number: HashMap<Region, u16> = regions.iter().map(|r| (r.region, r.id)).collect();
        let of_table: Vec<u16> = aovs.table.iter().map(|r| number.get(r).copied().unwrap_or(0)).collect();
        let id = |index: &u32| of_table.get(*index as usize).copied().unwrap_or(NOTHING);
        Ok(Self { ids: aovs.regions.iter().map(id).collect(), regions })
    }

    /// The table beside the map.
    pub fn json(&self) -> serde_json::Value {
        self.regions
            .iter()
            .map(|region| {
                serde_json::json!({
                    "id": region.id,
                    "lenses": region.lenses,
                    "stack": region.stack.iter().map(Entry::json).collect::<Vec<_>>(),
                })
            })
            .collect()
    }
}

impl Actor {
    /// Who stands at a rank of stacks.
    pub fn of(plan: &Plan, rank: usize) -> Self {
        match plan.rule_of(rank) {
            Some(number) => Actor::Rule(NamedRule { number, name: plan.rules[number].name.clone() }),
            None => Actor::Lens(plan.lenses[rank].name.clone()),
        }
    }
}

impl std::fmt::Display for Actor {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Actor::Lens(name) | Actor::Rule(NamedRule { name, .. }) => f.write_str(name),
        }
    }
}

impl Entry {
    pub fn json(&self) -> serde_json::Value {
        serde_json::json!(self)
    }
}

impl std::fmt::Display for Entry {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.by {
            Actor::Lens(name) => write!(f, "{name}.{}", self.filter),
            Actor::Rule(_) => write!(f, "{} of the {}", self.filter, self.by),
        }
    }
}

/// Regions in the order of their sorted lens names, numbered from 1; 0 is outside all lenses, and only there where a
/// rule acts. Where `known`, which a search has found, and `seen`, which a picture shows, are more together than a map
/// has numbers for, only what is seen is numbered.
pub fn numbered(plan: &Plan, known: &[Region], seen: &[Region]) -> Vec<(usize, Region)> {
    let distinct = |regions: &mut dyn Iterator<Item = &Region>| -> HashSet<Region> {
        regions.copied().filter(|region| *region != Region::PLAIN).collect()
    };
    let mut regions = distinct(&mut known.iter().chain(seen));
    if regions.len() > MOST_NUMBERS {
        regions = distinct(&mut seen.iter());
    }
    let mut regions: Vec<Region> = regions.into_iter().collect();
    plan.sort_by_names(&mut regions);
    let outside = usize::from(regions.first().is_some_and(|region| region.set.is_empty()));
    regions.into_iter().enumerate().map(|(place, region)| (place + 1 - outside, region)).collect()
}

/// Every filter that acts in a region, content filters too, lowest first.
pub fn stack(plan: &Plan, region: Region) -> Vec<Entry> {
    let of_rank = |rank: usize| {
        let by = Actor::of(plan, rank);
        plan.filters_of(rank).iter().map(move |f| Entry { by: by.clone(), filter: filter_name(f) })
    };
    region.stack.iter().flat_map(of_rank).collect()
}
