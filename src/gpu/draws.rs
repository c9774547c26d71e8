//! The instances of a plan as draw calls: one for every chunk of an instance's triangles.

use glam::{DAffine3, DVec2, DVec3};

use super::Window;
use super::upload::{Chunk, Range, SceneData};
use crate::lens::PixelRect;
use crate::plan::{Instance, Item, Plan};
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

/// Consecutive triangles of an instance with a record of their own.
#[derive(Debug, Clone, Copy)]
pub struct Piece<'a> {
    pub item: &'a Item,
    /// Into [`Plan::instances`].
    pub instance: usize,
    pub range: Range,
    /// Of its item's.
    pub first_triangle: u32,
    pub triangles: u32,
    /// World space, as shown.
    bounds: Aabb,
}

impl Piece<'_> {
    pub fn instance<'a>(&self, plan: &'a Plan) -> &'a Instance {
        &plan.instances[self.instance]
    }

    /// The number of its first triangle among all items'.
    pub fn key(&self) -> u32 {
        self.item.first_triangle + self.first_triangle
    }
}

/// One draw call.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Draw {
    /// Number of its piece's record.
    pub record: u32,
    /// Into the shared indices.
    pub indices: std::ops::Range<u32>,
    pub base_vertex: i32,
    pub culling: Culling,
    /// Pixels of the window outside which nothing of it is seen.
    pub rect: PixelRect,
    /// No fragment of it can be removed, translucent, or beyond near and far: it needs no fragment logic.
    pub plain: bool,
}

/// All instances cut into the chunks of their primitives, in the order that decides ties; of those that lenses move
/// only what may be seen there.
pub fn pieces<'a>(scene: &Scene, plan: &'a Plan, data: &SceneData) -> Vec<Piece<'a>> {
    let of_instance = |(number, instance): (usize, &'a Instance)| {
        let item = &plan.items[instance.item];
        let (range, chunks) = data.primitive(item);
        let shown_from_local = shown_from_local(scene, item, instance);
        let whole = chunks.len() == 1;
        let piece = move |chunk: &Chunk| Piece {
            item,
            instance: number,
            range,
            first_triangle: chunk.first_triangle,
            triangles: chunk.triangles,
            bounds: if whole {
                instance.bounds
            } else {
                let shown = Aabb::from_points(chunk.bounds.corners().map(|p| shown_from_local.transform_point3(p)));
                if instance.is_moved() { shown.intersection(instance.bounds) } else { shown }
            },
        };
        chunks.iter().map(piece).filter(|piece| !piece.bounds.is_empty()).collect::<Vec<_>>()
    };
    let mut pieces: Vec<Piece> = plan.instances.iter().enumerate().flat_map(of_instance).collect();
    pieces.sort_by_key(Piece::key);
    pieces
}

pub fn shown_from_local(scene: &Scene, item: &Item, instance: &Instance) -> DAffine3 {
    instance.shown_from_world * scene.models[item.model].nodes[item.node].world_from_local
}

/// The draws of what a window may show.
pub fn draws(scene: &Scene, plan: &Plan, window: &Window, pieces: &[Piece]) -> Vec<Draw> {
    (0u32..)
        .zip(pieces)
        .map(|(record, piece)| {
            let first = piece.range.first_index + 3 * piece.first_triangle;
            Draw {
                record,
                indices: first..first + 3 * piece.triangles,
                base_vertex: piece.range.base_vertex as i32,
                culling: culling(scene, plan, piece.item),
                rect: window.local(&seen_rect(plan, piece)),
                plain: is_plain(plan, piece),
            }
        })
        .filter(|draw| !draw.rect.is_empty())
        .collect()
}

/// Pixels of the whole picture outside which a piece is not seen: its bounds and, where lenses move it or bring it in,
/// those lenses.
fn seen_rect(plan: &Plan, piece: &Piece) -> PixelRect {
    let bounds = pixel_rect(&plan.view, piece.bounds.corners());
    let by_lens = |rank: usize| {
        // Lenses that take whole objects, and rules, act anywhere.
        if plan.by_pixel.contains(rank) { plan.lenses[rank].rect } else { bounds }
    };
    match piece.instance(plan).steps.first() {
        Some(step) => bounds.intersection(by_lens(step.rank)),
        None if piece.item.is_alternate() => {
            let shown = piece.item.shown_by.iter().map(by_lens).reduce(PixelRect::union);
            bounds.intersection(shown.unwrap_or(PixelRect::EMPTY))
        }
        None => bounds,
    }
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

fn is_plain(plan: &Plan, piece: &Piece) -> bool {
    let item = piece.item;
    if item.is_alternate() || item.translucent || piece.instance(plan).is_moved() {
        return false;
    }
    let depths = piece.bounds.corners().map(|p| plan.view.depth(p));
    let far = depths.into_iter().fold(f64::NEG_INFINITY, f64::max);
    // Boundaries that merge, and drawn depths, may be off by such a share of the depth.
    let margin = 2e-5 * depths.into_iter().map(f64::abs).fold(plan.view.far.abs(), f64::max);
    if far > plan.view.far - margin {
        return false;
    }
    let around = Aabb { min: piece.bounds.min - margin, max: piece.bounds.max + margin };
    let changes = |rank: usize| {
        let takes_away = item.removed_by.contains(rank) || item.movers.contains(rank);
        takes_away || (plan.lenses[rank].translucent && item.scope.contains(rank))
    };
    let reaches = |rank: usize| {
        item.object.contains(rank)
            || (plan.by_pixel.contains(rank) && plan.lenses[rank].volume.bounds().overlaps(&around))
    };
    // A rule may hold anywhere.
    let ruled = |rule: usize| plan.rules[rule].translucent || item.removed_by.contains(plan.rule_rank(rule));
    !(0..plan.lenses.len()).any(|rank| changes(rank) && reaches(rank)) && !(0..plan.rules.len()).any(ruled)
}
