//! Which regions occur: found along lines through the lenses, never by listing subsets.
//!
//! A line crosses N convex lenses in at most 2N+1 layers (others in a few more), so it finds every region it passes,
//! however thin.
//! Lines run along three axes through a grid of points in every lens and along view rays through its pixels; the
//! set is deterministic. A region is missed only if it slips between all of them.

use std::collections::{HashMap, HashSet};

use glam::DVec3;

use super::{Instance, LensSet, Plan, Step};
use crate::lens::RayLayers;
use crate::scene::Aabb;
use crate::view::Ray;

/// A region that occurs: which lenses, and which of them act, or which rule.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct Region {
    pub set: LensSet,
    pub stack: LensSet,
}

impl Region {
    /// Outside all lenses, where no rule acts.
    pub const PLAIN: Region = Region { set: LensSet::EMPTY, stack: LensSet::EMPTY };

    /// The overlap rule that acts here.
    pub fn rule(&self, plan: &Plan) -> Option<usize> {
        self.stack.top().and_then(|rank| plan.rule_of(rank))
    }

    /// The lenses of the set that are hidden here, each with the lowest survivor that hides it.
    pub fn hidden(&self, plan: &Plan) -> Vec<(usize, usize)> {
        if self.rule(plan).is_some() {
            return Vec::new();
        }
        let by = |rank: usize| self.stack.iter().find(|above| plan.lenses[*above].hides.contains(rank));
        self.set.minus(self.stack).iter().filter_map(|rank| Some((rank, by(rank)?))).collect()
    }
}

/// Lines a side of the grid through a lens, for few lenses; fewer each for many, so that the work stays bounded.
const GRID: usize = 24;
const LINES: usize = 40_000;

/// Instances to which lenses mean the same.
struct Class {
    /// The lenses that apply, and those that hold the whole object.
    scope: LensSet,
    object: LensSet,
    /// One of them, where lenses move it.
    moved: Option<usize>,
    bounds: Vec<Aabb>,
}

impl Plan {
    /// The regions that occur in space, sorted by their lens names; the plain scene is not among them.
    pub fn regions(&self) -> Vec<Region> {
        let classes = self.classes();
        // Where all lenses apply to all items, no item need be there: a region is a part of space.
        let anywhere = classes.iter().filter(|class| class.moved.is_none()).count() <= 1;
        let mut sets: HashSet<LensSet> = HashSet::new();
        let mut found: HashSet<Region> = HashSet::new();
        let mut layers = RayLayers::default();
        for (ray, from, to) in self.probes() {
            let volumes = self.by_pixel.iter().map(|rank| (rank, &self.lenses[rank].volume));
            layers.find(volumes, &ray, from, to);
            for class in &classes {
                match class.moved {
                    None => class.note(&layers, &ray, to, anywhere, &mut sets),
                    Some(instance) => {
                        let near = |from, to| anywhere || class.bounds.iter().any(|b| crosses(b, &ray, from, to));
                        self.note_moved(&self.instances[instance], &layers, &ray, to, &near, &mut found);
                    }
                }
            }
        }
        for item in &self.items {
            sets.insert(item.object & item.scope);
        }
        // Outside all lenses a rule may act, too.
        sets.insert(LensSet::EMPTY);
        found.extend(sets.into_iter().map(|set| Region { set, stack: self.stack_of(set) }));
        found.remove(&Region::PLAIN);
        let mut regions: Vec<Region> = found.into_iter().collect();
        let places = self.places_by_name();
        regions.sort_by_cached_key(|region| {
            let mut names: Vec<usize> = region.set.iter().map(|rank| places[rank]).collect();
            names.sort_unstable();
            (names, region.stack)
        });
        regions
    }

    /// Notes what an instance meets along a line where lenses move it.
    fn note_moved(
        &self,
        instance: &Instance,
        here: &RayLayers,
        ray: &Ray,
        to: f64,
        near: &dyn Fn(f64, f64) -> bool,
        found: &mut HashSet<Region>,
    ) {
        let from = here.starts[0].depth;
        let below = |step: &Step| {
            let mut layers = RayLayers::default();
            let ranks = (self.by_pixel & LensSet::below(step.rank)).iter();
            let volumes = ranks.map(|rank| (rank, &self.lenses[rank].volume));
            layers.find(volumes, &ray.moved(&step.source_from_shown), from, to);
            layers
        };
        let levels: Vec<RayLayers> = instance.steps.iter().map(below).collect();
        let all = || std::iter::once(here).chain(&levels);
        let mut cuts: Vec<f64> = all().flat_map(|layers| layers.starts.iter().map(|start| start.depth)).collect();
        cuts.push(to);
        cuts.sort_unstable_by(f64::total_cmp);
        for pair in cuts.windows(2).filter(|pair| pair[0] < pair[1] && near(pair[0], pair[1])) {
            let middle = 0.5 * (pair[0] + pair[1]);
            let verdict = self.walk(instance, |step| all().nth(step).map_or(LensSet::EMPTY, |l| l.set_at(middle)));
            if verdict.here {
                found.insert(Region { set: verdict.set, stack: verdict.stack });
            }
        }
    }

    /// For each rank the place of its lens among the sorted names.
    fn places_by_name(&self) -> Vec<usize> {
        let mut sorted: Vec<usize> = (0..self.lenses.len()).collect();
        sorted.sort_by_key(|rank| &self.lenses[*rank].name);
        let mut places = vec![0; sorted.len()];
        sorted.iter().enumerate().for_each(|(place, rank)| places[*rank] = place);
        places
    }

    /// The distinct ways in which lenses are limited to what is drawn and move it.
    fn classes(&self) -> Vec<Class> {
        let mut classes: Vec<Class> = Vec::new();
        let mut known: HashMap<(LensSet, LensSet, Option<usize>), usize> = HashMap::new();
        for (index, instance) in self.instances.iter().enumerate() {
            let item = &self.items[instance.item];
            let (scope, object) = (item.scope | item.shown_by, item.object & item.scope);
            let moved = (!item.movers.is_empty()).then(|| {
                let same = |other: &&Class| {
                    let moved = other.moved.map(|moved| &self.instances[moved]);
                    other.scope == scope && other.object == object && moved.is_some_and(|m| m.steps == instance.steps)
                };
                classes.iter().find(same).and_then(|class| class.moved).unwrap_or(index)
            });
            let place = *known.entry((scope, object, moved)).or_insert_with(|| {
                classes.push(Class { scope, object, moved, bounds: Vec::new() });
                classes.len() - 1
            });
            classes[place].bounds.push(instance.bounds);
        }
        if classes.is_empty() {
            let scope = LensSet::below(self.lenses.len());
            classes.push(Class { scope, object: LensSet::EMPTY, moved: None, bounds: Vec::new() });
        }
        classes
    }

    /// Lines to look along, each with the stretch that counts.
    fn probes(&self) -> Vec<(Ray, f64, f64)> {
        let per_lens = (LINES / (4 * self.lenses.len().max(1))).max(9);
        let grid = GRID.min((per_lens as f64).sqrt() as usize).max(3);
        let mut probes = Vec::new();
        for rank in self.by_pixel.iter() {
            let lens = &self.lenses[rank];
            let bounds = lens.volume.bounds();
            if !bounds.is_empty() && bounds.size().is_finite() {
                axis_probes(&bounds, grid, &mut probes);
            }
            let (min, max) = (lens.rect.min.map(f64::from), lens.rect.max.map(f64::from));
            for (u, v) in grid_points(grid) {
                let ray = self.view.ray(min[0] + (max[0] - min[0]) * u, min[1] + (max[1] - min[1]) * v);
                probes.push((ray, self.view.near, self.view.far));
            }
        }
        probes
    }
}

impl Class {
    /// Notes what lies along a line where no lens moves anything. One of the class must be near, unless `anywhere`.
    fn note(&self, layers: &RayLayers, ray: &Ray, to: f64, anywhere: bool, sets: &mut HashSet<LensSet>) {
        for (i, start) in layers.starts.iter().enumerate() {
            let here = (start.set & self.scope) | self.object;
            if sets.contains(&here) {
                continue;
            }
            let end = layers.starts.get(i + 1).map_or(to, |next| next.depth);
            if anywhere || self.bounds.iter().any(|b| crosses(b, ray, start.depth, end)) {
                sets.insert(here);
            }
        }
    }
}

/// Middles of the cells of a grid, shifted a little so that they fall on no symmetry.
fn grid_points(grid: usize) -> impl Iterator<Item = (f64, f64)> {
    let at = move |i: usize, shift: f64| (i as f64 + shift) / grid as f64;
    (0..grid).flat_map(move |i| (0..grid).map(move |j| (at(i, 0.4937), at(j, 0.5071))))
}

fn axis_probes(bounds: &Aabb, grid: usize, probes: &mut Vec<(Ray, f64, f64)>) {
    let size = bounds.size();
    for axis in 0..3 {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        for (u, v) in grid_points(grid) {
            let mut origin = bounds.min;
            origin[a] += u * size[a];
            origin[b] += v * size[b];
            let ray = Ray::new(origin, DVec3::AXES[axis]);
            probes.push((ray, -1e-3 * size[axis], 1.001 * size[axis]));
        }
    }
}

/// Whether the stretch of a ray meets a box.
fn crosses(bounds: &Aabb, ray: &Ray, from: f64, to: f64) -> bool {
    let (mut from, mut to) = (from, to);
    for axis in 0..3 {
        let (o, d) = (ray.origin[axis], ray.direction[axis]);
        if d == 0.0 {
            if o < bounds.min[axis] || o > bounds.max[axis] {
                return false;
            }
            continue;
        }
        let (a, b) = ((bounds.min[axis] - o) / d, (bounds.max[axis] - o) / d);
        from = from.max(a.min(b));
        to = to.min(a.max(b));
    }
    from <= to
}
