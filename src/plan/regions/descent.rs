//! Regions along a line where lenses move content: from the top of the order down, the line is cut at the lenses; where
//! one of them moves, the stretch goes on where that lens has its content from. Each stretch goes one way only, so the
//! work grows with the boundaries that are met, not with the ways in which movers may be put together.

use std::collections::{BTreeMap, HashMap, HashSet};

use glam::DAffine3;

use super::{Region, SET, crosses_any};
use crate::lens::RayLayers;
use crate::plan::{Item, LensSet, Plan};
use crate::scene::Aabb;
use crate::view::Ray;

/// Items to which lenses mean the same, and which they move alike.
pub(super) struct Group {
    /// One of them, into [`Plan::items`].
    item: usize,
    /// By rank: from where a mover shows something to where it has it from. None where it shows nothing of them.
    movements: HashMap<usize, DAffine3>,
    /// World bounds as shown, by the ranks of the movers, the highest first.
    bounds: HashMap<Vec<usize>, Vec<Aabb>>,
}

/// The bits of an affine map.
type Bits = [u64; 12];
/// By what items are grouped.
type GroupKey = (LensSet, LensSet, LensSet, LensSet, Vec<(usize, Bits)>);

impl Plan {
    /// The items that lenses may move, in groups.
    pub(super) fn groups(&self) -> Vec<Group> {
        let mut groups: Vec<Group> = Vec::new();
        let mut known: HashMap<GroupKey, usize> = HashMap::new();
        let mut ways: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
        for (number, instance) in self.instances.iter().enumerate() {
            if !self.items[instance.item].movers.is_empty() {
                ways.entry(instance.item).or_default().push(number);
            }
        }
        for (item, ways) in ways {
            let mut movements = HashMap::new();
            for way in &ways {
                if let Some(first) = self.instances[*way].steps.first() {
                    movements.entry(first.rank).or_insert(first.source_from_shown);
                }
            }
            let mut bits: Vec<(usize, Bits)> =
                movements.iter().map(|(rank, map)| (*rank, map.to_cols_array().map(f64::to_bits))).collect();
            bits.sort_unstable();
            let own = &self.items[item];
            let key = (own.scope, own.object, own.shown_by, own.movers, bits);
            let group = *known.entry(key).or_insert_with(|| {
                groups.push(Group { item, movements, bounds: HashMap::new() });
                groups.len() - 1
            });
            for way in ways {
                let instance = &self.instances[way];
                let path = instance.steps.iter().map(|step| step.rank).collect();
                groups[group].bounds.entry(path).or_default().push(instance.bounds);
            }
        }
        groups
    }
}

/// A stretch of a line on its way down the order.
#[derive(Clone)]
struct Stretch {
    from: f64,
    to: f64,
    /// Lenses at this rank and above have been asked.
    rank: usize,
    set: LensSet,
    stack: LensSet,
    hidden: LensSet,
    /// The lens that brought the content in has been passed.
    shown: bool,
}

/// Goes down the order with one line after the other.
pub(super) struct Descent<'a> {
    plan: &'a Plan,
    /// See [`Plan::costs`].
    costs: &'a [u64],
    anywhere: bool,
    /// Of all lines so far.
    pub work: u64,
    path: Vec<usize>,
    /// Layers that are not in use.
    spare: Vec<RayLayers>,
}

impl<'a> Descent<'a> {
    pub fn new(plan: &'a Plan, costs: &'a [u64], anywhere: bool) -> Self {
        Self { plan, costs, anywhere, work: 0, path: Vec::new(), spare: Vec::new() }
    }

    /// Notes what a group has along a line, whose own layers are known.
    pub fn note(&mut self, group: &Group, layers: &RayLayers, line: &Ray, to: f64, found: &mut HashSet<Region>) {
        let nothing = LensSet::EMPTY;
        let whole = Stretch {
            from: layers.starts[0].depth,
            to,
            rank: self.plan.lenses.len(),
            set: nothing,
            stack: nothing,
            hidden: nothing,
            shown: false,
        };
        self.path.clear();
        self.cut(group, layers, line, line, whole, found);
    }

    /// Cuts a stretch at the layers of the lenses below it, and goes on with each piece. `ray`: the line where the content
    /// comes from.
    fn cut(
        &mut self,
        group: &Group,
        layers: &RayLayers,
        line: &Ray,
        ray: &Ray,
        whole: Stretch,
        found: &mut HashSet<Region>,
    ) {
        for (number, start) in layers.starts.iter().enumerate() {
            let end = layers.starts.get(number + 1).map_or(whole.to, |next| next.depth);
            let (from, to) = (start.depth.max(whole.from), end.min(whole.to));
            if from < to {
                self.go_down(group, line, ray, start.set, Stretch { from, to, ..whole.clone() }, found);
            }
        }
    }

    /// Follows a stretch inside `around` down to the lowest lens, or to the next that moves.
    fn go_down(
        &mut self,
        group: &Group,
        line: &Ray,
        ray: &Ray,
        around: LensSet,
        mut stretch: Stretch,
        found: &mut HashSet<Region>,
    ) {
        self.work += SET;
        let (plan, item) = (self.plan, &self.plan.items[group.item]);
        let applying = plan.applying(item, around);
        if self.path.is_empty()
            && let Some(rule) = plan.rule_for(applying & item.scope)
        {
            let region = Region { set: applying & item.scope, stack: LensSet::only(plan.rule_rank(rule)) };
            self.keep(group, line, &stretch, region, found);
            return;
        }
        let mut rest = applying & LensSet::below(stretch.rank);
        while let Some(rank) = rest.top() {
            rest.remove(rank);
            if self.passes(item, rank, &mut stretch) {
                // It is seen elsewhere where the mover shows nothing of it.
                if let Some(movement) = group.movements.get(&rank) {
                    self.path.push(rank);
                    self.follow(group, line, &ray.moved(movement), Stretch { rank, ..stretch }, found);
                    self.path.pop();
                }
                return;
            }
        }
        let region = Region { set: stretch.set, stack: stretch.stack };
        self.keep(group, line, &stretch, region, found);
    }

    /// Takes a lens into account, as [`Plan::walk`] does; true where it moves the item.
    fn passes(&self, item: &Item, rank: usize, stretch: &mut Stretch) -> bool {
        let acts = !stretch.hidden.contains(rank);
        let shows = acts && !stretch.shown && item.shown_by.contains(rank);
        if !shows && !item.scope.contains(rank) {
            return false;
        }
        stretch.set.insert(rank);
        if !acts {
            return false;
        }
        stretch.stack.insert(rank);
        stretch.hidden = stretch.hidden | self.plan.lenses[rank].hides;
        let moves = !stretch.shown && item.movers.contains(rank);
        stretch.shown |= shows;
        moves
    }

    fn follow(&mut self, group: &Group, line: &Ray, ray: &Ray, stretch: Stretch, found: &mut HashSet<Region>) {
        let mut layers = self.spare.pop().unwrap_or_default();
        let lower = (self.plan.by_pixel & LensSet::below(stretch.rank)).iter();
        let volumes = lower.map(|rank| (rank, &self.plan.lenses[rank].volume));
        layers.find(volumes, ray, stretch.from, stretch.to);
        self.work += self.costs[stretch.rank];
        self.cut(group, &layers, line, ray, stretch, found);
        self.spare.push(layers);
    }

    /// Notes a region of a stretch if something of the group is there.
    fn keep(&mut self, group: &Group, line: &Ray, stretch: &Stretch, region: Region, found: &mut HashSet<Region>) {
        self.work += SET;
        if found.contains(&region) {
            return;
        }
        let Some(bounds) = group.bounds.get(&self.path) else { return };
        if self.anywhere || crosses_any(bounds, line, stretch.from, stretch.to, &mut self.work) {
            found.insert(region);
        }
    }
}
