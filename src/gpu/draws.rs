//! The instances of a plan as draw calls: for runs of clusters of an instance's triangles that are seen and alike.

use glam::{DAffine3, DVec2, DVec3};

use super::Window;
use super::clusters::Cluster;
use super::planes::{InPlane, Planes};
use super::upload::SceneData;
use crate::lens::PixelRect;
use crate::plan::{Instance, Item, Lens, LensSet, Plan};
use crate::scene::{Aabb, Scene};
use crate::view::View;

/// Which faces of an item are left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Culling {
    None,
    Back,
    /// Back faces of a node that mirrors: its triangles run the other way round.
    BackMirrored,
}

/// One draw call.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Draw {
    /// Into [`Plan::instances`], and number of its record.
    pub record: u32,
    /// Into the shared indices.
    pub indices: std::ops::Range<u32>,
    pub base_vertex: i32,
    pub culling: Culling,
    /// Pixels of the window outside which nothing of it is seen.
    pub rect: PixelRect,
    /// All of it is there and opaque, between near and far: it needs no fragment logic.
    pub plain: bool,
    /// Some of its triangles have their depths from their planes.
    pub in_planes: bool,
}

pub fn shown_from_local(scene: &Scene, item: &Item, instance: &Instance) -> DAffine3 {
    instance.shown_from_world * scene.models[item.model].nodes[item.node].world_from_local
}

/// What a frame leaves out beside what lies outside its window.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Skip {
    /// What lenses take away wherever it is.
    WhatIsGone,
    /// Nothing: accounts tell of that, too.
    Nothing,
}

/// What becomes of a part of an instance.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fate {
    /// All of it is there and opaque, between near and far.
    Plain,
    /// Nothing of it is there.
    Gone,
    /// Each fragment must ask.
    Asked,
}

/// The draws of what a window may show, in the order that decides ties.
///
/// `planes`: what has its depth from its plane, which each fragment finds.
pub fn draws(
    scene: &Scene,
    plan: &Plan,
    window: &Window,
    uploaded: &SceneData,
    skip: Skip,
    planes: &Planes,
) -> Vec<Draw> {
    let lenses = Lenses::new(plan);
    let mut order: Vec<usize> = (0..plan.instances.len()).collect();
    order.sort_by_key(|instance| plan.items[plan.instances[*instance].item].first_triangle);
    let mut draws: Vec<Draw> = Vec::new();
    for number in order {
        let first_draw = draws.len();
        let instance = &plan.instances[number];
        let item = &plan.items[instance.item];
        let (range, clusters) = uploaded.primitive(item);
        let in_planes = clusters_in_planes(planes.of(number), clusters, uploaded.order(item));
        let shown_from_local = shown_from_local(scene, item, instance);
        let altering = plan.altering(item);
        let showing = lenses.showing(item);
        for (cluster, in_planes) in clusters.iter().zip(in_planes) {
            let bounds = shown_bounds(instance, &shown_from_local, cluster, clusters.len());
            let rect = window.local(&lenses.seen_rect(instance, showing, &bounds));
            if bounds.is_empty() || rect.is_empty() {
                continue;
            }
            let fate = lenses.fate(instance, &altering, &bounds);
            if fate == Fate::Gone && skip == Skip::WhatIsGone {
                continue;
            }
            let first = range.first_index + 3 * cluster.first;
            let draw = Draw {
                record: number as u32,
                indices: first..first + 3 * cluster.count,
                base_vertex: range.base_vertex as i32,
                culling: culling(scene, plan, item),
                rect,
                plain: fate == Fate::Plain && !in_planes && !plan.view.is_wide(),
                in_planes,
            };
            match draws.last_mut() {
                Some(last) if last.goes_on(&draw) => {
                    last.indices.end = draw.indices.end;
                    last.rect = last.rect.union(draw.rect);
                }
                _ => draws.push(draw),
            }
        }
        // A few pipelines an instance rather than as many as runs. What lies over each other in one plane does not depend on
        // what is drawn first.
        draws[first_draw..].sort_by_key(|draw| (!draw.plain, draw.in_planes));
    }
    draws
}

/// Which clusters of an instance have triangles that have their depths from their planes. `order`: the number of each drawn
/// triangle.
fn clusters_in_planes(planes: &[InPlane], clusters: &[Cluster], order: &[u32]) -> Vec<bool> {
    if planes.is_empty() {
        return vec![false; clusters.len()];
    }
    let mut is_in_plane = vec![false; order.len()];
    planes.iter().for_each(|own| is_in_plane[own.triangle as usize] = true);
    let own = |cluster: &Cluster| &order[cluster.first as usize..(cluster.first + cluster.count) as usize];
    clusters.iter().map(|cluster| own(cluster).iter().any(|number| is_in_plane[*number as usize])).collect()
}

/// World bounds of a cluster of an instance; of a moved one only what may be seen there.
fn shown_bounds(instance: &Instance, shown_from_local: &DAffine3, cluster: &Cluster, clusters: usize) -> Aabb {
    if clusters == 1 {
        return instance.bounds;
    }
    let shown = Aabb::from_points(cluster.bounds.corners().map(|p| shown_from_local.transform_point3(p)));
    if instance.is_moved() { shown.intersection(instance.bounds) } else { shown }
}

impl Draw {
    /// Whether another draw only goes on with this one's triangles.
    fn goes_on(&self, next: &Draw) -> bool {
        let is_alike = self.plain == next.plain && self.in_planes == next.in_planes;
        self.record == next.record && is_alike && self.indices.end == next.indices.start
    }
}

/// What the lenses of a plan may do to bounds.
struct Lenses<'a> {
    plan: &'a Plan,
    /// Of each lens that tests every fragment, in the world; the others may act anywhere.
    bounds: Vec<Aabb>,
    /// Lenses and rules that may make something less than opaque.
    translucent: LensSet,
}

impl<'a> Lenses<'a> {
    fn new(plan: &'a Plan) -> Self {
        let bounds = |(rank, lens): (usize, &Lens)| {
            if plan.by_pixel.contains(rank) { lens.volume.bounds() } else { Aabb::EVERYWHERE }
        };
        let bounds = plan.lenses.iter().enumerate().map(bounds).collect();
        Self { plan, bounds, translucent: plan.translucent() }
    }

    /// Whether a lens or rule may act within bounds.
    fn reaches(&self, rank: usize, bounds: &Aabb) -> bool {
        // A rule may hold anywhere.
        self.bounds.get(rank).is_none_or(|own| own.overlaps(bounds))
    }

    /// The lenses without which an item is not seen in place; `None` where it is there anyway.
    fn showing(&self, item: &Item) -> Option<LensSet> {
        if item.is_simplified() {
            return Some(self.plan.simplifying_to(item));
        }
        item.is_alternate().then_some(item.shown_by)
    }

    /// Pixels of the whole picture outside which a part of an instance is not seen: its bounds and, where lenses move
    /// it or bring it in, those lenses.
    fn seen_rect(&self, instance: &Instance, showing: Option<LensSet>, bounds: &Aabb) -> PixelRect {
        let rect = pixel_rect(&self.plan.view, bounds.corners());
        let around = padded(&self.plan.view, bounds);
        let by_lens = |rank: usize| {
            let is_somewhere = self.plan.by_pixel.contains(rank);
            if is_somewhere { self.plan.lenses[rank].rect } else { rect }
        };
        match (instance.steps.first(), showing) {
            (Some(step), _) => rect.intersection(by_lens(step.rank)),
            (None, Some(showing)) => {
                let showing = showing.iter().filter(|rank| self.reaches(*rank, &around));
                rect.intersection(showing.map(by_lens).reduce(PixelRect::union).unwrap_or(PixelRect::EMPTY))
            }
            (None, None) => rect,
        }
    }

    /// `altering`: of its item, see [`Plan::altering`].
    fn fate(&self, instance: &Instance, altering: &LensSet, bounds: &Aabb) -> Fate {
        let (plan, item) = (self.plan, &self.plan.items[instance.item]);
        if instance.is_moved() {
            return Fate::Asked;
        }
        let around = padded(&plan.view, &self.spread(instance, bounds));
        let far = bounds.corners().map(|p| plan.view.depth(p)).into_iter().fold(f64::NEG_INFINITY, f64::max);
        let may_be_plain = !item.translucent && far <= plan.view.far - margin(&plan.view, bounds);
        let is_there_anyway = !item.is_alternate() && !item.is_simplified();
        if is_there_anyway && !altering.iter().any(|rank| self.reaches(rank, &around)) {
            return if may_be_plain { Fate::Plain } else { Fate::Asked };
        }
        let Some(holding) = self.holding(item, &around) else { return Fate::Asked };
        let verdict = plan.walk(instance, |_| holding);
        match verdict.displayed {
            false => Fate::Gone,
            true if may_be_plain && (verdict.stack & self.translucent).is_empty() => Fate::Plain,
            true => Fate::Asked,
        }
    }

    /// Bounds around all places at which a part of an instance asks who acts.
    fn spread(&self, instance: &Instance, bounds: &Aabb) -> Aabb {
        let reach = instance.filling_reach() * self.plan.view.ray(0.0, 0.0).direction.length();
        Aabb { min: bounds.min - reach, max: bounds.max + reach }
    }

    /// The lenses that test every fragment, mean something to an item, and hold all of some bounds; `None` where one may
    /// hold only some of it, or one moves content.
    fn holding(&self, item: &Item, bounds: &Aabb) -> Option<LensSet> {
        let mut holding = LensSet::EMPTY;
        for rank in (self.plan.by_pixel & (item.scope | item.shown_by)).iter().filter(|r| self.reaches(*r, bounds)) {
            match self.plan.lenses[rank].volume.holds_box(bounds) {
                Some(false) => {}
                Some(true) if !item.movers.contains(rank) => holding.insert(rank),
                _ => return None,
            }
        }
        Some(holding)
    }
}

/// How far boundaries that merge, and drawn depths, may be off around bounds: some times what merges, and a share of the
/// depth, along the ray that is longest for its depth.
fn margin(view: &View, bounds: &Aabb) -> f64 {
    let off = |p: DVec3| {
        let depth = view.depth(p);
        (4.0 * view.anchor.merging.at(depth)).max(2e-5 * (depth.abs() + view.anchor.merging.across))
    };
    view.ray(0.0, 0.0).direction.length() * bounds.corners().map(off).into_iter().fold(0.0, f64::max)
}

fn padded(view: &View, bounds: &Aabb) -> Aabb {
    let margin = margin(view, bounds);
    Aabb { min: bounds.min - margin, max: bounds.max + margin }
}

/// Pixels around the projection of points, one more on each side; all where one is not in front of the eye.
fn pixel_rect(view: &View, points: [DVec3; 8]) -> PixelRect {
    let whole = PixelRect { min: [0, 0], max: view.size };
    let (mut min, mut max) = (DVec2::INFINITY, DVec2::NEG_INFINITY);
    for point in points {
        // A point almost at the eye's plane projects to anywhere.
        let Some(p) = view.project(point).filter(|p| p.abs().max_element() < 1e9) else { return whole };
        (min, max) = (min.min(p - 1.0), max.max(p + 1.0));
    }
    let size = DVec2::new(f64::from(view.size[0]), f64::from(view.size[1]));
    let (min, max) = (min.floor().clamp(DVec2::ZERO, size), max.ceil().clamp(DVec2::ZERO, size));
    PixelRect { min: [min.x as u32, min.y as u32], max: [max.x as u32, max.y as u32] }
}

fn culling(scene: &Scene, plan: &Plan, item: &Item) -> Culling {
    if !plan.cull_backfaces || scene.materials[item.material].double_sided != 0 {
        return Culling::None;
    }
    let world = scene.models[item.model].nodes[item.node].world_from_local;
    if world.matrix3.determinant() < 0.0 { Culling::BackMirrored } else { Culling::Back }
}
