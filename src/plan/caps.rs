//! Caps: surfaces that close the solids which an eraser cuts (SEMANTICS 6.6).
//!
//! A cap lies where a view ray comes to a lens boundary inside a closed node that is displayed on one side of it and
//! erased, by an eraser with `cap`, on the other. Whether a point is inside the backend finds from all crossings of
//! the ray with the node; who erases there is said here.

use std::collections::BTreeMap;

use super::{Instance, Item, ItemCap, Lens, LensSet, Plan, Region};
use crate::appearance as wgsl;
use crate::pieces::EdgeCounts;
use crate::scene::{Closure, Scene};
use crate::spec::{At, By, Cap, Filter, Spec};

/// A node as erasers with `cap` cut it: all of it that is shown in one way.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Body {
    /// Its primitives.
    pub members: Vec<Member>,
}

/// A primitive of a body.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Member {
    /// Into [`Plan::instances`].
    pub instance: usize,
    /// The first of the body's members that enclose something only together with it, itself if there is no other.
    pub group: usize,
}

/// What closes an instance at a boundary.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Closing {
    /// The rank of the lens or rule whose `cap` it is.
    pub maker: usize,
    /// The lens whose boundary it is.
    pub boundary: usize,
    /// Behind the boundary.
    pub region: Region,
}

/// The most nodes that a warning names.
const MOST_NAMED: usize = 8;

/// Nodes of which a lens or rule says the same, by model and node.
type Nodes = BTreeMap<(usize, usize), String>;

/// Leaves items only the caps that can be, and says which cannot, and which are not as they should be.
pub(super) fn check(spec: &Spec, scene: &Scene, lenses: &[Lens], items: &mut [Item]) -> Vec<String> {
    // By the lens or rule, and by what is said.
    let mut told: BTreeMap<(usize, Fault), Nodes> = BTreeMap::new();
    for item in items.iter_mut().filter(|item| !item.caps.is_empty()) {
        let scope = item.scope;
        let is_there = |rank: usize, lens: &Lens| lens.by == By::Pixel && scope.contains(rank);
        item.caps.retain(|cap| lenses.get(cap.maker).is_none_or(|lens| is_there(cap.maker, lens)));
        let model = &scene.models[item.model];
        let closure = model.closure(item.mesh, 1.0);
        if let Some(fault) = Fault::of(&closure) {
            // What is moved may be cut anywhere.
            let is_moved = !item.moved_by(lenses).is_empty();
            let misses = |lens: &Lens| !is_moved && lens.volume.holds_box(&item.bounds) == Some(false);
            for cap in item.caps.iter().filter(|cap| !lenses.get(cap.maker).is_some_and(misses)) {
                let name = || with_edges(&model.node_label(item.node), &closure.edges);
                told.entry((cap.maker, fault)).or_default().entry((item.model, item.node)).or_insert_with(name);
            }
        }
        if closure.closed == 0 {
            item.caps.clear();
        }
    }
    for node in items.chunk_by_mut(is_same_node) {
        let is_cut = node.iter().any(|item| !item.caps.is_empty());
        node.iter_mut().for_each(|item| item.is_cut = is_cut);
    }
    let by_object = (0..lenses.len()).filter(|rank| lenses[*rank].by == By::Object);
    let idle = by_object.filter_map(|rank| {
        let (place, name) = cap_of(spec, lenses, rank)?;
        Some(format!("{place}: `cap` of {name} closes nothing: with by = \"object\" it cuts no solid"))
    });
    let told = told.into_iter().filter_map(|((rank, fault), nodes)| {
        let (place, name) = cap_of(spec, lenses, rank)?;
        let more = nodes.len().saturating_sub(MOST_NAMED);
        let more = if more > 0 { format!(", and {more} more nodes") } else { String::new() };
        let names: Vec<String> = nodes.into_values().take(MOST_NAMED).collect();
        Some(format!("{place}: `cap` of {name} {}: {}{more}", fault.words(), names.join(", ")))
    });
    idle.chain(told).collect()
}

/// What is wrong with the mesh of a node that is cut; the worst first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Fault {
    Open,
    OpenInPart,
    Mended,
    Unsorted,
    Turned,
}

impl Fault {
    fn of(closure: &Closure) -> Option<Self> {
        let faults = [
            (closure.closed == 0, Self::Open),
            (closure.open > 0, Self::OpenInPart),
            (closure.mended > 0, Self::Mended),
            (closure.unsorted > 0, Self::Unsorted),
            (closure.edges.turned > 0, Self::Turned),
        ];
        faults.into_iter().find_map(|(is_so, fault)| is_so.then_some(fault))
    }

    fn words(self) -> &'static str {
        match self {
            Self::Open => "leaves open what is not closed",
            Self::OpenInPart => "closes some pieces and leaves open those that are not closed",
            Self::Mended => "takes for whole what has small holes",
            Self::Unsorted => "leaves it open which of very many pieces in each other are holes",
            Self::Turned => "takes for one side what has triangles turned against each other",
        }
    }
}

fn is_same_node(a: &Item, b: &Item) -> bool {
    (a.content, a.node) == (b.content, b.node)
}

/// A node with what may be wrong with its mesh's edges.
fn with_edges(name: &str, edges: &EdgeCounts) -> String {
    let more = [(edges.turned, "turned"), (edges.touching, "self-touching")];
    let more: String = more.iter().filter(|(n, _)| *n > 0).map(|(n, what)| format!(", {n} {what}")).collect();
    format!("{name} ({} of {} edges are open{more})", edges.open, edges.all)
}

/// Where a lens or a rule first has a `cap`, and how messages call it.
fn cap_of(spec: &Spec, lenses: &[Lens], rank: usize) -> Option<(String, String)> {
    let (filters, name) = match lenses.get(rank) {
        Some(lens) => (&spec.lenses[lens.index].filters, format!("lens `{}`", lens.name)),
        None => {
            let rule = &spec.overlaps[rank - lenses.len()];
            (&rule.filters, format!("the {}", super::rules::name(spec, rule)))
        }
    };
    let has_cap = |filter: &&At<Filter>| matches!(filter.value, Filter::Erase { cap: Some(_), .. });
    Some((spec.source.place(filters.iter().find(has_cap)?.span.start), name))
}

/// The nodes that may be cut, in each of the ways in which all of a node is shown; the smallest first: of those that lie
/// in each other the inner ones.
pub(super) fn bodies(scene: &Scene, items: &[Item], instances: &[Instance]) -> Vec<Body> {
    // By the content, the node, the version and the lenses that move it.
    let mut ways: BTreeMap<(usize, usize, u32, Vec<usize>), Body> = BTreeMap::new();
    for (number, instance) in instances.iter().enumerate().filter(|(_, instance)| items[instance.item].is_cut) {
        let item = &items[instance.item];
        let way = instance.steps.iter().map(|step| step.rank).collect();
        let body =
            ways.entry((item.content, item.node, item.ratio.to_bits(), way)).or_insert(Body { members: Vec::new() });
        body.members.push(Member { instance: number, group: 0 });
    }
    let first = |body: &Body| &instances[body.members[0].instance];
    let whole: Vec<Body> = ways.into_values().filter_map(|body| grouped(scene, items, instances, body)).collect();
    let size = |body: &Body| {
        let item = &items[first(body).item];
        let in_place = scene.models[item.model].node_bounds(item.node).size().element_product();
        in_place * first(body).shown_from_world.matrix3.determinant().abs()
    };
    let mut bodies: Vec<(f64, Body)> = whole.into_iter().map(|body| (size(&body), body)).collect();
    bodies.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    bodies.into_iter().map(|(_, body)| body).collect()
}

/// A body with its members by what they enclose together, without those that lack some of that: what a lens shows, moves or
/// simplifies only some primitives of encloses nothing. `None` where nothing is left.
fn grouped(scene: &Scene, items: &[Item], instances: &[Instance], body: Body) -> Option<Body> {
    let item = |member: &Member| &items[instances[member.instance].item];
    let first = item(&body.members[0]);
    let closure = scene.models[first.model].closure(first.mesh, first.ratio);
    let head = |member: &Member| closure.primitives[item(member).primitive].group;
    // Of each group, told by its first primitive, how many there are and how many are here.
    let mut counts: BTreeMap<usize, [usize; 2]> = BTreeMap::new();
    for primitive in closure.primitives.iter().filter(|primitive| !primitive.is_empty()) {
        counts.entry(primitive.group).or_default()[0] += 1;
    }
    body.members.iter().for_each(|member| counts.entry(head(member)).or_default()[1] += 1);
    let is_whole = |member: &Member| counts.get(&head(member)).is_some_and(|[all, here]| all == here);
    let mut members: Vec<Member> = body.members.into_iter().filter(is_whole).collect();
    // Here groups are told by the first member that is of one.
    let mut firsts: BTreeMap<usize, usize> = BTreeMap::new();
    for (number, member) in members.iter_mut().enumerate() {
        member.group = *firsts.entry(head(member)).or_insert(number);
    }
    (!members.is_empty()).then_some(Body { members })
}

impl Item {
    /// What a lens or rule closes this with.
    pub fn cap(&self, maker: usize) -> Option<&ItemCap> {
        self.caps.iter().find(|cap| cap.maker == maker)
    }

    /// The lenses and rules that close it where they cut it.
    pub fn capped_by(&self) -> LensSet {
        self.caps.iter().map(|cap| cap.maker).collect()
    }
}

impl Plan {
    /// The lenses and rules outside which nothing of a body is cut.
    pub fn cutters(&self, body: &Body) -> LensSet {
        let own = |member: &Member| {
            let instance = &self.instances[member.instance];
            // What is moved is cut where it is seen: in the lens that moves it.
            instance.steps.first().map_or(self.items[instance.item].capped_by(), |step| LensSet::only(step.rank))
        };
        body.members.iter().fold(LensSet::EMPTY, |all, member| all | own(member))
    }

    /// The lenses that do not act on the caps of a lens or rule: those below the lens. A rule has no place in the order.
    pub fn below_cap(&self, maker: usize) -> LensSet {
        if maker < self.lenses.len() { LensSet::below(maker) } else { LensSet::EMPTY }
    }

    /// The record, in [`Plan::ops`], of the line around a cap; `None` where it has none.
    pub fn outline(&self, cap: &ItemCap) -> Option<usize> {
        let own = match self.lenses.get(cap.maker) {
            Some(lens) => &lens.ops,
            None => &self.rules[cap.maker - self.lenses.len()].ops,
        };
        own.clone().find(|op| self.ops[*op].is_outline_of(cap.filter))
    }

    /// What closes an instance at a boundary, if anything does.
    ///
    /// `around(n, behind)`: as for [`Plan::walk`], just before the boundary and just behind it.
    pub fn closing(&self, instance: &Instance, mut around: impl FnMut(usize, bool) -> LensSet) -> Option<Closing> {
        let before = self.walk(instance, |steps| around(steps, false));
        let behind = self.walk(instance, |steps| around(steps, true));
        if before.displayed == behind.displayed {
            return None;
        }
        let erased = if behind.displayed { &before } else { &behind };
        let item = &self.items[instance.item];
        let maker = (item.capped_by() & erased.removed_by).top().filter(|_| erased.here)?;
        let mut changed = LensSet::EMPTY;
        for steps in 0..=instance.steps.len() {
            let (before, behind) = (around(steps, false), around(steps, true));
            changed = changed | (instance.asked_after(steps) & (before.minus(behind) | behind.minus(before)));
        }
        let changed = changed & self.by_pixel & (item.scope | item.shown_by);
        let boundary = if changed.contains(maker) { maker } else { changed.top()? };
        // It keeps the look that its maker gives it: lower lenses do not act on it.
        let stack = behind.stack.minus(self.below_cap(maker));
        Some(Closing { maker, boundary, region: Region { set: behind.set, stack } })
    }
}

impl Instance {
    /// The lenses that are asked at the point after so many steps: from the mover of the next step up to that of the last.
    fn asked_after(&self, steps: usize) -> LensSet {
        let below = |step: usize| self.steps.get(step).map(|step| LensSet::below(step.rank));
        let highest = steps.checked_sub(1).and_then(below).unwrap_or(LensSet::below(super::MAX_LENSES));
        highest.minus(below(steps).unwrap_or(LensSet::EMPTY))
    }
}

impl Cap {
    /// A `CAP_...` constant of the shaders, and a colour in linear light.
    pub(crate) fn look(self) -> (u32, [f32; 4]) {
        match self {
            Cap::Own => (wgsl::CAP_OWN.0, [0.0; 4]),
            Cap::Color(color) => (wgsl::CAP_COLOR.0, color.to_linear()),
            Cap::Hatch(color) => (wgsl::CAP_HATCH.0, color.to_linear()),
        }
    }
}
