//! Triangles that lie over others in one plane, as shaders read them: words behind those of the lenses. Twin of
//! `coincident.wgsl`.

use super::records::NONE;
use crate::plan::{Instance, Plan};

/// Appends the words of all instances' triangles that share their planes; where those of each instance start, or [`NONE`].
pub fn push_in_planes(plan: &Plan, words: &mut Vec<u32>) -> Vec<u32> {
    plan.instances.iter().map(|instance| push(plan, instance, words)).collect()
}

fn push(plan: &Plan, instance: &Instance, words: &mut Vec<u32>) -> u32 {
    let shared = &plan.coincident.parts[instance.item];
    if shared.is_empty() {
        return NONE;
    }
    let first = words.len() as u32;
    words.push(shared.len() as u32);
    let world_from_shown = instance.shown_from_world.inverse();
    for shared in shared {
        let plane = &plan.coincident.planes[shared.plane as usize];
        // Around the view's origin, as shown.
        let normal = world_from_shown.matrix3.transpose() * plane.normal;
        let offset = plane.offset - plane.normal.dot(world_from_shown.transform_point3(plan.view.origin()));
        words.extend([shared.triangle, shared.rank]);
        words.extend(normal.as_vec3().to_array().map(f32::to_bits));
        words.push((offset as f32).to_bits());
    }
    first
}
