//! The items of a plan as records and draw calls.

use glam::DVec3;

use super::records::{ITEM_ALTERNATE, ITEM_TRANSLUCENT, ItemRecord, words_of};
use super::upload::{Range, SceneData};
use crate::plan::{Item, Plan};
use crate::scene::{MaterialRecord, NO_TEXTURE, Scene};

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
    /// No fragment of it can be removed, translucent, or beyond near and far: it needs no fragment logic.
    pub plain: bool,
}

/// The draws of a plan in the order that decides ties.
pub fn draws(scene: &Scene, plan: &Plan, data: &SceneData) -> Vec<Draw> {
    (0u32..)
        .zip(&plan.items)
        .map(|(number, item)| Draw {
            item: number,
            range: data.range(item.model, item.mesh, item.primitive),
            culling: culling(scene, plan, item),
            plain: is_plain(plan, item),
        })
        .collect()
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
    let far = item.bounds.corners().into_iter().map(|p| plan.view.depth(p)).fold(f64::NEG_INFINITY, f64::max);
    // A little less, for the rounding of the drawn depths.
    if far > plan.view.far - 1e-5 * plan.view.far.abs() {
        return false;
    }
    let changes = |rank: usize| {
        let lens = &plan.lenses[rank];
        item.removed_by.contains(rank) || (lens.translucent && item.scope.contains(rank))
    };
    let reaches = |rank: usize| {
        item.object.contains(rank)
            || (plan.by_pixel.contains(rank) && plan.lenses[rank].volume.bounds().overlaps(&item.bounds))
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
