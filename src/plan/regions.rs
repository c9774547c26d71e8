//! Which regions occur: found along lines through the lenses, never by listing subsets.
//!
//! A line crosses N convex lenses in at most 2N+1 layers, so it finds every region it passes, however thin.
//! Lines run along three axes through a grid of points in every lens and along view rays through its pixels; the
//! set is deterministic. A region is missed only if it slips between all of them.

use std::collections::BTreeMap;

use glam::DVec3;

use super::{Item, LensSet, Plan, survivors};
use crate::lens::RayLayers;
use crate::scene::Aabb;
use crate::view::Ray;

/// A region that occurs: which lenses, and which of them act.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Region {
    pub set: LensSet,
    pub stack: LensSet,
}

impl Region {
    /// The lenses of the set that are hidden here, each with the lowest survivor that hides it.
    pub fn hidden(&self, plan: &Plan) -> Vec<(usize, usize)> {
        let by = |rank: usize| self.stack.iter().find(|above| plan.lenses[*above].hides.contains(rank));
        self.set.minus(self.stack).iter().filter_map(|rank| Some((rank, by(rank)?))).collect()
    }
}

/// Lines a side of the grid through a lens, for few lenses; fewer each for many, so that the work stays bounded.
const GRID: usize = 24;
const LINES: usize = 40_000;

/// How lenses are limited to items: those that apply, and those that hold the whole object.
type Class = (LensSet, LensSet);

impl Plan {
    /// The regions that occur in space, sorted by their lens names; the plain scene is not among them.
    pub fn regions(&self) -> Vec<Region> {
        let classes = self.classes();
        let mut found: BTreeMap<LensSet, ()> = BTreeMap::new();
        let mut layers = RayLayers::default();
        for (ray, from, to) in self.probes() {
            let volumes = self.by_pixel.iter().map(|rank| (rank, &self.lenses[rank].volume));
            layers.find(volumes, &ray, from, to);
            for (i, start) in layers.starts.iter().enumerate() {
                let end = layers.starts.get(i + 1).map_or(to, |next| next.depth);
                self.note(start.set, &ray, (start.depth, end), &classes, &mut found);
            }
        }
        for item in &self.items {
            found.insert(item.object & item.scope, ());
        }
        found.remove(&LensSet::EMPTY);
        let mut regions: Vec<Region> =
            found.into_keys().map(|set| Region { set, stack: survivors(&self.lenses, set) }).collect();
        let places = self.places_by_name();
        regions.sort_by_cached_key(|region| {
            let mut names: Vec<usize> = region.set.iter().map(|rank| places[rank]).collect();
            names.sort_unstable();
            names
        });
        regions
    }

    /// For each rank the place of its lens among the sorted names.
    fn places_by_name(&self) -> Vec<usize> {
        let mut sorted: Vec<usize> = (0..self.lenses.len()).collect();
        sorted.sort_by_key(|rank| &self.lenses[*rank].name);
        let mut places = vec![0; sorted.len()];
        sorted.iter().enumerate().for_each(|(place, rank)| places[*rank] = place);
        places
    }

    /// The distinct ways in which lenses are limited to items, with the bounds of the items of each.
    fn classes(&self) -> BTreeMap<Class, Vec<Aabb>> {
        let mut classes: BTreeMap<Class, Vec<Aabb>> = BTreeMap::new();
        let class = |item: &Item| (item.scope | item.shown_by, item.object & item.scope);
        self.items.iter().for_each(|item| classes.entry(class(item)).or_default().push(item.bounds));
        classes
    }

    /// Notes what a stretch of a line means to each class. Where all lenses apply to all items, no item need be there:
    /// a region is a part of space. Else one of the class must be near the stretch.
    fn note(
        &self,
        set: LensSet,
        ray: &Ray,
        (from, to): (f64, f64),
        classes: &BTreeMap<Class, Vec<Aabb>>,
        found: &mut BTreeMap<LensSet, ()>,
    ) {
        if classes.len() <= 1 {
            let (scope, object) = classes.keys().next().copied().unwrap_or((set, LensSet::EMPTY));
            found.insert((set & scope) | object, ());
            return;
        }
        for ((scope, object), bounds) in classes {
            let here = (set & *scope) | *object;
            if !found.contains_key(&here) && bounds.iter().any(|b| crosses(b, ray, from, to)) {
                found.insert(here, ());
            }
        }
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
            let ray = Ray { origin, direction: DVec3::AXES[axis] };
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
