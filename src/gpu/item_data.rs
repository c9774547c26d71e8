//! Instances as records, and how lenses move them.

use glam::DAffine3;

use super::cut_data::CutWords;
use super::draws::shown_from_local;
use super::records::{ITEM_ALTERNATE, ITEM_TRANSLUCENT, ItemRecord, NONE, StepRecord, rows, words_of};
use super::upload::SceneData;
use crate::plan::{Instance, Plan, Step};
use crate::scene::{MaterialRecord, NO_TEXTURE, Scene, scene_factor};

/// Records of all instances, and their steps.
#[derive(Debug, Clone, Default)]
pub struct ItemData {
    /// A record, its item's masks and its channels, for each instance.
    pub items: Vec<u8>,
    pub steps: Vec<StepRecord>,
}

/// Bytes from one record to the next; they start at multiples of 16 bytes.
pub fn item_stride(words: u32, channels: u32) -> u64 {
    (size_of::<ItemRecord>() as u64 + 4 * u64::from(6 * words + 2 * channels.max(1))).next_multiple_of(16)
}

impl ItemData {
    /// `words`: of a set of lenses; `cuts` and `planes`: of each instance.
    pub fn new(
        scene: &Scene,
        plan: &Plan,
        uploaded: &SceneData,
        words: u32,
        cuts: &[CutWords],
        planes: &[u32],
    ) -> Self {
        let mut data = Self::default();
        for ((instance, cut), planes) in plan.instances.iter().zip(cuts).zip(planes) {
            let item = &plan.items[instance.item];
            let first_step = data.steps.len() as u32;
            data.steps.extend(instance.steps.iter().map(|step| step_record(plan, step)));
            let CutWords { body, caps, group, roles, lids } = *cut;
            let plain = record(scene, plan, instance, uploaded);
            let cut = ItemRecord { first_step, body, caps, group, roles, lids, planes: *planes, ..plain };
            let end = data.items.len() + item_stride(words, plan.channels.len() as u32) as usize;
            data.items.extend_from_slice(bytemuck::bytes_of(&cut));
            let masks = [item.scope, item.object, item.shown_by, item.removed_by, item.movers, item.simplified_by];
            for mask in masks {
                words_of(&mask, words).for_each(|word| data.items.extend_from_slice(&word.to_le_bytes()));
            }
            for name in &plan.channels {
                let factor = scene_factor(name, &scene.models[item.model].nodes[item.node].world_from_local);
                let start = uploaded.primitive(item).0.values.get(name).copied().unwrap_or(NONE);
                data.items.extend_from_slice(bytemuck::cast_slice(&[start, factor.to_bits()]));
            }
            data.items.resize(end, 0);
        }
        data
    }
}

fn step_record(plan: &Plan, step: &Step) -> StepRecord {
    let origin = DAffine3::from_translation(plan.view.origin());
    let [row_x, row_y, row_z] = rows(&(origin.inverse() * step.source_from_shown * origin));
    StepRecord { row_x, row_y, row_z, rank: step.rank as u32, pad: [0; 3] }
}

fn record(scene: &Scene, plan: &Plan, instance: &Instance, uploaded: &SceneData) -> ItemRecord {
    let item = &plan.items[instance.item];
    let (range, _) = uploaded.primitive(item);
    let mut around = shown_from_local(scene, item, instance);
    around.translation += around.matrix3 * range.middle.as_dvec3() - plan.view.origin();
    let [row_x, row_y, row_z] = rows(&around);
    ItemRecord {
        row_x,
        row_y,
        row_z,
        material: item.material as u32,
        first_triangle: item.first_triangle,
        flags: if item.translucent { ITEM_TRANSLUCENT } else { 0 }
            | if item.is_alternate() { ITEM_ALTERNATE } else { 0 },
        first_index: range.first_index,
        first_number: range.first_number,
        base_vertex: range.base_vertex,
        normals: range.normals,
        tangents: range.tangents,
        colors: range.colors,
        uv0: range.uv[0],
        uv1: range.uv[1],
        slots: texture_slots(&scene.materials[item.material]),
        center: (item.center - plan.view.origin()).as_vec3().to_array(),
        first_step: 0,
        step_count: instance.steps.len() as u32,
        body: NONE,
        caps: NONE,
        node: item.node as u32,
        ratio: item.ratio,
        spread: instance.spread as f32,
        planes: NONE,
        group: NONE,
        roles: NONE,
        lids: NONE,
        across: range.across,
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
