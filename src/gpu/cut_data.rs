//! What may be cut, as shaders read it: bodies and caps as words behind those of the lenses, and what is drawn of them.

use super::Window;
use super::draws::{Culling, Draw};
use super::records::NONE;
use super::upload::SceneData;
use crate::lens::PixelRect;
use crate::plan::{Body, Item, Member, Plan};

/// What shaders know of an instance that may be cut; [`NONE`]: it is not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CutWords {
    /// Where the words of its body are: the number of members, then for each its instance.
    pub body: u32,
    /// Where those are of what closes it: the number of those who do, then for each its rank, a `CAP_...` constant, and the
    /// colour.
    pub caps: u32,
    /// It is not closed by itself.
    pub is_open: bool,
}

/// Appends the words of all bodies and caps; where those of each instance are.
pub fn push_cuts(plan: &Plan, words: &mut Vec<u32>) -> Vec<CutWords> {
    let mut cuts = vec![CutWords { body: NONE, caps: NONE, is_open: false }; plan.instances.len()];
    for Body { members } in &plan.bodies {
        let body = words.len() as u32;
        words.push(members.len() as u32);
        words.extend(members.iter().map(|member| member.instance as u32));
        for Member { instance, closed } in members {
            let item = &plan.items[plan.instances[*instance].item];
            cuts[*instance] = CutWords { body, caps: push_caps(item, words), is_open: !closed };
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
    let draw = |(body, member): (&Body, &Member)| {
        let rect = window.local(&cut_rect(plan, body));
        let item = &plan.items[plan.instances[member.instance].item];
        let (range, _) = uploaded.primitive(item);
        let indices = range.first_index..range.first_index + 3 * item.triangles;
        let record = member.instance as u32;
        let base_vertex = range.base_vertex as i32;
        let culling = Culling::None;
        let draw = Draw { record, indices, base_vertex, culling, rect, plain: false, in_planes: false };
        (!draw.rect.is_empty()).then_some(draw)
    };
    members.filter_map(draw).collect()
}

/// The pixels outside which a body is not cut.
pub fn cut_rect(plan: &Plan, body: &Body) -> PixelRect {
    let whole = PixelRect { min: [0, 0], max: plan.view.size };
    // Rules may hold anywhere, and so do lenses that take whole objects.
    let rect = |rank: usize| if plan.by_pixel.contains(rank) { plan.lenses[rank].rect } else { whole };
    plan.cutters(body).iter().map(rect).reduce(PixelRect::union).unwrap_or(PixelRect::EMPTY)
}
