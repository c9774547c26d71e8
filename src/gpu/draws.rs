//! The items of a plan as records and draw calls: one of each for every chunk of an item's triangles.

use glam::{DVec2, DVec3};

use super::Window;
use super::records::{ITEM_ALTERNATE, ITEM_TRANSLUCENT, ItemRecord, words_of};
use super::upload::{Chunk, Range, SceneData};
use crate::lens::PixelRect;
use crate::plan::{Item, Plan};
use crate::scene::{Aabb, MaterialRecord, NO_TEXTURE, Scene};
use crate::view::View;

/// Which faces of an item are left out.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Culling {
    None,
    Back,
    /// Back faces of a node that mirrors: its triangles run the other way round.
    BackMirrored,
}

/// Consecutive triangles of an item with a record of their own.
#[derive(Debug, Clone, Copy)]
pub struct Part<'a> {
    item: &'a Item,
    range: Range,
    first_triangle: u32,
    triangles: u32,
    /// World space.
    bounds: Aabb,
}

/// One draw call.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Draw {
    /// Number of its part's record.
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

/// All items cut into the chunks of their primitives, in the order that decides ties.
pub fn parts<'a>(scene: &Scene, plan: &'a Plan, data: &SceneData) -> Vec<Part<'a>> {
    let of_item = |item: &'a Item| {
        let (range, chunks) = data.primitive(item);
        let world = scene.models[item.model].nodes[item.node].world_from_local;
        let whole = chunks.len() == 1;
        let part = move |chunk: &Chunk| Part {
            item,
            range,
            first_triangle: chunk.first_triangle,
            triangles: chunk.triangles,
            bounds: if whole {
                item.bounds
            } else {
                Aabb::from_points(chunk.bounds.corners().map(|p| world.transform_point3(p)))
            },
        };
        chunks.iter().map(part).collect::<Vec<_>>()
    };
    plan.items.iter().flat_map(of_item).collect()
}

/// The draws of what a window may show.
pub fn draws(scene: &Scene, plan: &Plan, window: &Window, parts: &[Part]) -> Vec<Draw> {
    (0u32..)
        .zip(parts)
        .map(|(record, part)| {
            let first = part.range.first_index + 3 * part.first_triangle;
            Draw {
                record,
                indices: first..first + 3 * part.triangles,
                base_vertex: part.range.base_vertex as i32,
                culling: culling(scene, plan, part.item),
                rect: window.local(&seen_rect(plan, part)),
                plain: is_plain(plan, part),
            }
        })
        .filter(|draw| !draw.rect.is_empty())
        .collect()
}

/// Pixels of the whole picture outside which a part is not seen: its bounds and, for an alternate, the lenses that
/// show it.
fn seen_rect(plan: &Plan, part: &Part) -> PixelRect {
    let item = part.item;
    let bounds = pixel_rect(&plan.view, part.bounds.corners());
    if !item.is_alternate() || item.shown_by.iter().any(|rank| item.object.contains(rank)) {
        return bounds;
    }
    let shown = item.shown_by.iter().filter(|rank| plan.by_pixel.contains(*rank)).map(|rank| plan.lenses[rank].rect);
    let shown = shown.filter(|rect| !rect.is_empty()).reduce(|a, b| PixelRect {
        min: [a.min[0].min(b.min[0]), a.min[1].min(b.min[1])],
        max: [a.max[0].max(b.max[0]), a.max[1].max(b.max[1])],
    });
    shown.map_or(PixelRect::EMPTY, |shown| PixelRect {
        min: [bounds.min[0].max(shown.min[0]), bounds.min[1].max(shown.min[1])],
        max: [bounds.max[0].min(shown.max[0]), bounds.max[1].min(shown.max[1])],
    })
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

fn is_plain(plan: &Plan, part: &Part) -> bool {
    let item = part.item;
    if item.is_alternate() || item.translucent {
        return false;
    }
    let depths = part.bounds.corners().map(|p| plan.view.depth(p));
    let far = depths.into_iter().fold(f64::NEG_INFINITY, f64::max);
    // Boundaries that merge, and drawn depths, may be off by such a share of the depth.
    let margin = 2e-5 * depths.into_iter().map(f64::abs).fold(plan.view.far.abs(), f64::max);
    if far > plan.view.far - margin {
        return false;
    }
    let around = Aabb { min: part.bounds.min - margin, max: part.bounds.max + margin };
    let changes = |rank: usize| {
        let lens = &plan.lenses[rank];
        item.removed_by.contains(rank) || (lens.translucent && item.scope.contains(rank))
    };
    let reaches = |rank: usize| {
        item.object.contains(rank)
            || (plan.by_pixel.contains(rank) && plan.lenses[rank].volume.bounds().overlaps(&around))
    };
    !(0..plan.lenses.len()).any(|rank| changes(rank) && reaches(rank))
}

/// The records of the parts, each with its item's masks, as bytes.
pub fn record_bytes(scene: &Scene, plan: &Plan, parts: &[Part], words: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    for part in parts {
        let item = part.item;
        bytes.extend_from_slice(bytemuck::bytes_of(&record(scene, plan, part)));
        for mask in [item.scope, item.object, item.shown_by, item.removed_by] {
            words_of(&mask, words).for_each(|word| bytes.extend_from_slice(&word.to_le_bytes()));
        }
    }
    bytes
}

fn record(scene: &Scene, plan: &Plan, part: &Part) -> ItemRecord {
    let Part { item, range, .. } = *part;
    let world = scene.models[item.model].nodes[item.node].world_from_local;
    let offset = world.translation - plan.view.eye;
    let (m, n) = (world.matrix3.transpose(), world.matrix3.inverse());
    let row = |r: DVec3, w: f64| r.extend(w).as_vec4().to_array();
    ItemRecord {
        row_x: row(m.x_axis, offset.x),
        row_y: row(m.y_axis, offset.y),
        row_z: row(m.z_axis, offset.z),
        // The rows of the inverse transposed are the columns of the inverse.
        normal_x: row(n.x_axis, 0.0),
        normal_y: row(n.y_axis, 0.0),
        normal_z: row(n.z_axis, 0.0),
        material: item.material as u32,
        node: item.node as u32 + 1,
        first_triangle: item.first_triangle + part.first_triangle,
        flags: if item.translucent { ITEM_TRANSLUCENT } else { 0 }
            | if item.is_alternate() { ITEM_ALTERNATE } else { 0 },
        first_index: range.first_index + 3 * part.first_triangle,
        base_vertex: range.base_vertex,
        normals: range.normals,
        tangents: range.tangents,
        colors: range.colors,
        uv0: range.uv[0],
        uv1: range.uv[1],
        slots: texture_slots(&scene.materials[item.material]),
    }
}

/// Which texture slots of a material are in use, in the order of the shaders' `SLOT_...`.
fn texture_slots(material: &MaterialRecord) -> u32 {
    let slots = [
        &material.base_color_texture,
        &material.metallic_roughness_texture,
        &material.normal_texture,
        &material.occlusion_texture,
        &material.emissive_texture,
    ];
    (0..slots.len()).filter(|i| slots[*i].texture != NO_TEXTURE).map(|i| 1 << i).sum()
}
