//! Which regions occur: found along lines through the lenses, never by listing subsets.
//!
//! A line crosses N convex lenses in at most 2N+1 layers (others in a few more), so it finds every region it passes,
//! however thin.
//! Lines run along three axes through a grid of points in every lens and along view rays through its pixels; the
//! set is deterministic. A region is missed only if it slips between all of them, or if the search, whose work is
//! bounded, ends before the last line; then it says so.

mod descent;
mod probes;

use std::collections::{HashMap, HashSet};

use super::{LensSet, Plan};
use crate::lens::{Form, RayLayers, Volume};
use crate::limits::{MAX_REGIONS, REGION_WORK};
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

/// What a search for regions has found.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RegionSearch {
    /// Sorted by their lens names; the plain scene is not among them.
    pub regions: Vec<Region>,
    /// Why it ended before it had looked everywhere.
    pub ended: Option<Ended>,
}

/// Why a search for regions ended early.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ended {
    /// It had done all the work that it may do.
    Work { lines: usize, of: usize },
    /// It had found as many as it may list.
    Regions(usize),
}

impl std::fmt::Display for Ended {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Ended::Work { lines, of } => {
                write!(
                    f,
                    "the search for regions ended after {lines} of {of} lines through the lenses: there may be more"
                )
            }
            Ended::Regions(found) => {
                write!(f, "the search for regions ended when it had found {found}: there are more")
            }
        }
    }
}

/// Instances in place to which lenses mean the same, where none moves them.
struct Class {
    /// The lenses that apply, and those that hold the whole object.
    scope: LensSet,
    object: LensSet,
    bounds: Vec<Aabb>,
}

/// Rough nanoseconds: of a part of a lens that a ray is held against, of a plane, of a box, of a set that is looked up.
const PART: u64 = 30;
const PLANE: u64 = 2;
const BOX: u64 = 8;
const SET: u64 = 40;

impl Plan {
    /// The regions that occur in space.
    pub fn regions(&self) -> RegionSearch {
        self.search_regions(REGION_WORK)
    }

    /// The same with no more than so much work.
    fn search_regions(&self, most_work: u64) -> RegionSearch {
        let classes = self.classes();
        let groups = self.groups();
        // Where all lenses apply to all items, no item need be there: a region is a part of space.
        let anywhere = classes.len() <= 1;
        let costs = self.costs();
        let mut sets: HashSet<LensSet> = self.items.iter().map(|item| item.object & item.scope).collect();
        // Outside all lenses a rule may act, too.
        sets.insert(LensSet::EMPTY);
        let mut found: HashSet<Region> = HashSet::new();
        let mut layers = RayLayers::default();
        let mut descent = descent::Descent::new(self, &costs, anywhere);
        let (mut work, mut ended) = (0, None);
        let probes = self.probes();
        for (lines, (ray, from, to)) in probes::scattered(&probes).enumerate() {
            let volumes = self.by_pixel.iter().map(|rank| (rank, &self.lenses[rank].volume));
            layers.find(volumes, ray, *from, *to);
            work += costs[self.lenses.len()];
            for class in &classes {
                work += class.note(&layers, ray, *to, anywhere, &mut sets);
            }
            for group in &groups {
                if work + descent.work > most_work {
                    break;
                }
                descent.note(group, &layers, ray, *to, &mut found);
            }
            if work + descent.work > most_work {
                ended = Some(Ended::Work { lines: lines + 1, of: probes.len() });
            } else if found.len() + sets.len() > MAX_REGIONS {
                ended = Some(Ended::Regions(MAX_REGIONS));
            }
            if ended.is_some() {
                break;
            }
        }
        found.extend(sets.into_iter().map(|set| Region { set, stack: self.stack_of(set) }));
        found.remove(&Region::PLAIN);
        let mut regions: Vec<Region> = found.into_iter().collect();
        self.sort_by_names(&mut regions);
        if ended == Some(Ended::Regions(MAX_REGIONS)) {
            regions.truncate(MAX_REGIONS);
        }
        RegionSearch { regions, ended }
    }

    /// Sorts regions by their sorted lens names.
    pub fn sort_by_names(&self, regions: &mut [Region]) {
        let places = self.places_by_name();
        regions.sort_by_cached_key(|region| {
            let mut names: Vec<usize> = region.set.iter().map(|rank| places[rank]).collect();
            names.sort_unstable();
            (names, region.stack)
        });
    }

    /// For each rank the place of its lens among the sorted names.
    fn places_by_name(&self) -> Vec<usize> {
        let mut sorted: Vec<usize> = (0..self.lenses.len()).collect();
        sorted.sort_by_key(|rank| &self.lenses[*rank].name);
        let mut places = vec![0; sorted.len()];
        sorted.iter().enumerate().for_each(|(place, rank)| places[*rank] = place);
        places
    }

    /// For each rank what it costs to cut a ray at all lower lenses; last, at all.
    fn costs(&self) -> Vec<u64> {
        let mut all = 0;
        let own = |rank: usize| if self.by_pixel.contains(rank) { cost(&self.lenses[rank].volume) } else { 0 };
        let sums = (0..self.lenses.len()).map(|rank| {
            all += own(rank);
            all
        });
        std::iter::once(0).chain(sums).map(|sum| sum + SET).collect()
    }

    /// The distinct ways in which lenses are limited to what is drawn and that none of them moves.
    fn classes(&self) -> Vec<Class> {
        let mut classes: Vec<Class> = Vec::new();
        let mut known: HashMap<(LensSet, LensSet), usize> = HashMap::new();
        for instance in &self.instances {
            let item = &self.items[instance.item];
            if !item.movers.is_empty() {
                continue;
            }
            let (scope, object) = (item.scope | item.shown_by, item.object & item.scope);
            let place = *known.entry((scope, object)).or_insert_with(|| {
                classes.push(Class { scope, object, bounds: Vec::new() });
                classes.len() - 1
            });
            classes[place].bounds.push(instance.bounds);
        }
        if self.instances.is_empty() {
            let scope = LensSet::below(self.lenses.len());
            classes.push(Class { scope, object: LensSet::EMPTY, bounds: Vec::new() });
        }
        classes
    }
}

/// What it costs to hold a ray against a volume.
fn cost(volume: &Volume) -> u64 {
    let part = |form: &Form| match form {
        Form::HalfSpaces { planes, .. } => PLANE * planes.len() as u64,
        // A hierarchy: a few dozens of boxes.
        Form::Mesh(_) => 30 * BOX,
        _ => 0,
    };
    volume.parts.iter().map(|solid| PART + part(&solid.form)).sum()
}

impl Class {
    /// Notes what lies along a line where no lens moves anything, and says what that took. One of the class must be near,
    /// unless `anywhere`.
    fn note(&self, layers: &RayLayers, ray: &Ray, to: f64, anywhere: bool, sets: &mut HashSet<LensSet>) -> u64 {
        let mut work = 0;
        for (i, start) in layers.starts.iter().enumerate() {
            work += SET;
            let here = (start.set & self.scope) | self.object;
            if sets.contains(&here) {
                continue;
            }
            let end = layers.starts.get(i + 1).map_or(to, |next| next.depth);
            if anywhere || crosses_any(&self.bounds, ray, start.depth, end, &mut work) {
                sets.insert(here);
            }
        }
        work
    }
}

/// Whether the stretch of a ray meets one of some boxes; adds what it took to `work`.
fn crosses_any(bounds: &[Aabb], ray: &Ray, from: f64, to: f64, work: &mut u64) -> bool {
    let found = bounds.iter().position(|bounds| crosses(bounds, ray, from, to));
    *work += BOX * found.map_or(bounds.len(), |place| place + 1) as u64;
    found.is_some()
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

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use crate::scene::{Material, Mesh, Model, Node, Primitive, Scene, Transform};
    use crate::spec::Spec;

    /// A square of two triangles around the origin, the eye before it.
    fn plan(lenses: &str) -> Plan {
        let [x, y] = [glam::Vec3::X, glam::Vec3::Y];
        let primitive = Primitive {
            positions: vec![-x - y, x - y, x + y, y - x],
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            ..Primitive::default()
        };
        let node = Node {
            name: "square".into(),
            parent: None,
            children: Vec::new(),
            rest: Transform::IDENTITY,
            world_from_local: glam::DAffine3::IDENTITY,
            mesh: Some(0),
            camera: None,
            light: None,
            drawn: true,
            hidden: false,
        };
        let model = Model {
            nodes: vec![node],
            meshes: vec![Mesh { name: "square".into(), primitives: vec![primitive] }],
            materials: vec![Material::default()],
            ..Model::default()
        };
        let text = format!("[scene]\nfile = \"none.glb\"\n[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n{lenses}");
        let spec = Spec::parse(&text, "test.toml", Path::new("")).unwrap_or_else(|error| panic!("{error}"));
        Plan::new(&spec, &Scene::new(vec![model], Vec::new())).unwrap_or_else(|error| panic!("{error}"))
    }

    fn spheres(count: usize, filter: &str) -> String {
        let lens = |i: usize| {
            let (x, r) = (0.02 * i as f64, 0.9 - 0.02 * i as f64);
            format!(
                "[[lens]]\nname = \"l{i}\"\nshape.sphere = {{ center = [{x}, 0, 0], radius = {r} }}\nfilters = [{filter}]\n"
            )
        };
        (0..count).map(lens).collect()
    }

    /// The work of a whole search.
    fn work(plan: &Plan) -> u64 {
        let (mut enough, mut work) = (1u64 << 34, 0);
        while enough > 1 << 12 {
            enough /= 2;
            match plan.search_regions(enough).ended {
                None => work = enough,
                Some(_) => break,
            }
        }
        work
    }

    #[test]
    fn movers_over_each_other_do_not_multiply_the_work() {
        let [four, eight] = [4, 8].map(|count| plan(&spheres(count, "{ magnify = { factor = 1.1 } }")));
        assert_eq!(eight.instances.len(), 256, "the square may be shown in so many ways");
        let [four, eight] = [work(&four), work(&eight)];
        assert!(eight <= 8 * four, "{four} and {eight}");
    }

    #[test]
    fn a_search_that_ends_early_says_so_and_finds_nothing_that_is_not_there() {
        let plan = plan(&spheres(6, "\"invert\""));
        let whole = plan.regions();
        assert_eq!(whole.ended, None);
        let early = plan.search_regions(20_000);
        let Some(Ended::Work { lines, of }) = early.ended else { panic!("it has looked everywhere") };
        assert!(lines > 0 && lines < of, "{lines} of {of}");
        assert!(!early.regions.is_empty() && early.regions.iter().all(|region| whole.regions.contains(region)));
        let text = early.ended.map(|ended| ended.to_string()).unwrap_or_default();
        assert!(text.contains(&format!("{lines} of {of} lines")), "{text}");
    }
}
