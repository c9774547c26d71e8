//! What may be cut, as shaders read it: bodies and caps as words behind those of the lenses, and what is drawn of them.

use super::Window;
use super::draws::{Culling, Draw};
use super::records::NONE;
use super::upload::SceneData;
use crate::lens::PixelRect;
use crate::plan::{Body, Item, LensSet, Plan};

/// Where the words of an instance are; [`NONE`]: it is not cut.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CutWords {
    /// The number of members of its body, then for each its instance and whether it is closed by itself.
    pub body: u32,
    /// The number of those who close it, then for each its rank, a `CAP_...` constant, and the colour.
    pub caps: u32,
}

/// Appends the words of all bodies and caps; where those of each instance are.
pub fn push_cuts(plan: &Plan, words: &mut Vec<u32>) -> Vec<CutWords> {
    let mut cuts = vec![CutWords { body: NONE, caps: NONE }; plan.instances.len()];
    for Body { members } in &plan.bodies {
        let body = words.len() as u32;
        words.push(members.len() as u32);
        words.extend(members.iter().flat_map(|member| [member.instance as u32, u32::from(member.closed)]));
        for member in members {
            let item = &plan.items[plan.instances[member.instance].item];
            cuts[member.instance] = CutWords { body, caps: push_caps(item, words) };
        }
    }
    cuts
}

fn push_caps(item: &Item, words: &mut Vec<u32>) -> u32 {
    if item.caps.is_empty() {
        return NONE;
    }
    let first = words.len() as u32;
    words.push(item.caps.len() as u32);
    for (rank, cap) in &item.caps {
        let (kind, color) = cap.look();
        words.extend([*rank as u32, kind]);
        words.extend(color.map(f32::to_bits));
    }
    first
}

/// Draws of all that may be cut, whole: lenses tell where it matters.
pub fn draws(plan: &Plan, window: &Window, uploaded: &SceneData) -> Vec<Draw> {
    let members = plan.bodies.iter().flat_map(|body| body.members.iter().map(move |member| (body, member)));
    let draw = |(body, member): (&Body, &crate::plan::Member)| {
        let rect = window.local(&cut_rect(plan, body));
        let item = &plan.items[plan.instances[member.instance].item];
        let (range, _) = uploaded.primitive(item);
        let indices = range.first_index..range.first_index + 3 * item.triangles;
        let record = member.instance as u32;
        let base_vertex = range.base_vertex as i32;
        (!rect.is_empty()).then_some(Draw { record, indices, base_vertex, culling: Culling::None, rect, plain: false })
    };
    members.filter_map(draw).collect()
}

/// The pixels outside which a body is not cut.
pub fn cut_rect(plan: &Plan, Body { members }: &Body) -> PixelRect {
    let cutters = |member: &crate::plan::Member| {
        let instance = &plan.instances[member.instance];
        // What is moved is cut where it is seen: in the lens that moves it.
        instance.steps.first().map_or(plan.items[instance.item].capped_by(), |step| LensSet::only(step.rank))
    };
    let cutters = members.iter().fold(LensSet::EMPTY, |all, member| all | cutters(member));
    let whole = PixelRect { min: [0, 0], max: plan.view.size };
    // Rules may hold anywhere, and so do lenses that take whole objects.
    let rect = |rank: usize| if plan.by_pixel.contains(rank) { plan.lenses[rank].rect } else { whole };
    cutters.iter().map(rect).reduce(PixelRect::union).unwrap_or(PixelRect::EMPTY)
}
