//! The items of a plan as records and draw calls.

use glam::{DVec2, DVec3};

use super::Window;
use super::records::{ITEM_ALTERNATE, ITEM_TRANSLUCENT, ItemRecord, words_of};
use super::upload::{Range, SceneData};
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

/// One draw call.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Draw {
    /// Into the plan's items.
    pub item: u32,
    pub range: Range,
    pub culling: Culling,
    /// Pixels of the window outside which nothing of it is seen.
    pub rect: PixelRect,
    /// No fragment of it can be removed, translucent, or beyond near and far: it needs no fragment logic.
    pub plain: bool,
}

/// The draws of what a window may show of a plan, in the order that decides ties.
pub fn draws(scene: &Scene, plan: &Plan, window: &Window, data: &SceneData) -> Vec<Draw> {
    (0u32..)
        .zip(&plan.items)
        .map(|(number, item)| Draw {
            item: number,
            range: data.range(item.model, item.mesh, item.primitive),
            culling: culling(scene, plan, item),
            rect: window.local(&seen_rect(plan, item)),
            plain: is_plain(plan, item),
        })
        .filter(|draw| !draw.rect.is_empty())
        .collect()
}

/// Pixels of the whole picture outside which an item is not seen: its bounds and, for an alternate, the lenses that
/// show it.
fn seen_rect(plan: &Plan, item: &Item) -> PixelRect {
    let bounds = pixel_rect(&plan.view, item.bounds.corners());
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

fn is_plain(plan: &Plan, item: &Item) -> bool {
    if item.is_alternate() || item.translucent {
        return false;
    }
    let depths = item.bounds.corners().map(|p| plan.view.depth(p));
    let far = depths.into_iter().fold(f64::NEG_INFINITY, f64::max);
    // Boundaries that merge, and drawn depths, may be off by such a share of the depth.
    let margin = 2e-5 * depths.into_iter().map(f64::abs).fold(plan.view.far.abs(), f64::max);
    if far > plan.view.far - margin {
        return false;
    }
    let around = Aabb { min: item.bounds.min - margin, max: item.bounds.max + margin };
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

/// The records of a plan's items with their masks, as bytes.
pub fn item_bytes(scene: &Scene, plan: &Plan, data: &SceneData, words: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    for item in &plan.items {
        bytes.extend_from_slice(bytemuck::bytes_of(&record(scene, plan, data, item)));
        for mask in [item.scope, item.object, item.shown_by, item.removed_by] {
            words_of(&mask, words).for_each(|word| bytes.extend_from_slice(&word.to_le_bytes()));
        }
    }
    bytes
}

fn record(scene: &Scene, plan: &Plan, data: &SceneData, item: &Item) -> ItemRecord {
    let world = scene.models[item.model].nodes[item.node].world_from_local;
    let offset = world.translation - plan.view.eye;
    let (m, n) = (world.matrix3.transpose(), world.matrix3.inverse());
    let row = |r: DVec3, w: f64| r.extend(w).as_vec4().to_array();
    let range = data.range(item.model, item.mesh, item.primitive);
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
        first_triangle: item.first_triangle,
        flags: if item.translucent { ITEM_TRANSLUCENT } else { 0 }
            | if item.is_alternate() { ITEM_ALTERNATE } else { 0 },
        first_index: range.first_index,
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
