//! What may be cut, as shaders read it: bodies and caps as words behind those of the lenses, and what is drawn of them.

use std::collections::BTreeMap;

use glam::{DAffine3, Vec3};

use super::Window;
use super::draws::{Culling, Draw};
use super::records::{NONE, rows};
use super::upload::SceneData;
use crate::lens::PixelRect;
use crate::pieces::Role;
use crate::plan::{Body, Item, Member, OwnSurface, Plan};
use crate::scene::{Enclosing, Scene};

/// What shaders know of an instance that may be cut; [`NONE`]: it is not.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct CutWords {
    /// Where the words of its body are: the number of members, then for each its instance, then where the body's surface
    /// is for caps that show its own colours (see [`push_own`]), or [`NONE`].
    pub body: u32,
    /// Where those are of what closes it: the number of those who do, then for each its rank, a `CAP_...` constant, the
    /// colour, and which of the plan's filters draws the line around it, or [`NONE`].
    pub caps: u32,
    /// The instance that is the first of its group.
    pub group: u32,
    /// Where the roles of its primitive's triangles are, four a word; [`NONE`]: all are [`Role::PLAIN`].
    pub roles: u32,
    /// Where its lids are: three corners and the role of each.
    pub lids: u32,
}

impl CutWords {
    const NONE: Self = Self { body: NONE, caps: NONE, group: NONE, roles: NONE, lids: NONE };
}

/// Appends the words of all bodies and caps; where those of each instance are.
pub fn push_cuts(scene: &Scene, plan: &Plan, uploaded: &SceneData, words: &mut Vec<u32>) -> Vec<CutWords> {
    let mut cuts = vec![CutWords::NONE; plan.instances.len()];
    // Of each version of each primitive once.
    let mut known: BTreeMap<(usize, usize, usize, u32), [u32; 2]> = BTreeMap::new();
    for whole in &plan.bodies {
        let own = push_own(scene, plan, whole, uploaded, words);
        let Body { members } = whole;
        let body = words.len() as u32;
        words.push(members.len() as u32);
        words.extend(members.iter().map(|member| member.instance as u32));
        words.push(own);
        for Member { instance, group } in members {
            let item = &plan.items[plan.instances[*instance].item];
            let place = (item.model, item.mesh, item.primitive, item.ratio.to_bits());
            let [roles, lids] = *known
                .entry(place)
                .or_insert_with(|| push_roles(scene, item, uploaded.primitive(item).0.middle, words));
            let group = members[*group].instance as u32;
            cuts[*instance] = CutWords { body, caps: push_caps(plan, item, words), group, roles, lids };
        }
    }
    cuts
}

/// Appends the surface on which caps find their nearest points: the rows of the map into its cube from the space around
/// the view's origin, the number of its nodes, these, and of each triangle its corners, its instance and its place among the drawn.
fn push_own(scene: &Scene, plan: &Plan, body: &Body, uploaded: &SceneData, words: &mut Vec<u32>) -> u32 {
    let Some(own) = OwnSurface::new(scene, plan, body) else { return NONE };
    let at = words.len() as u32;
    let from_origin = own.cube_from_world * DAffine3::from_translation(plan.view.origin());
    words.extend(rows(&from_origin).as_flattened().iter().map(|x| x.to_bits()));
    words.push(own.tree.nodes.len() as u32);
    words.extend_from_slice(bytemuck::cast_slice(&own.tree.nodes));
    let item = |member: &Member| &plan.items[plan.instances[member.instance].item];
    let places: Vec<Vec<u32>> = body.members.iter().map(|member| uploaded.drawn_places(item(member))).collect();
    for (number, face) in (0u32..).zip(&own.faces) {
        let corners = own.tree.corners(number);
        words.extend(corners.iter().flat_map(|p| p.as_vec3().to_array()).map(f32::to_bits));
        let member = face.member as usize;
        words.extend([body.members[member].instance as u32, places[member][face.triangle as usize]]);
    }
    at
}

/// Appends what an item's triangles and lids enclose; where. `middle`: what its positions are relative to.
fn push_roles(scene: &Scene, item: &Item, middle: Vec3, words: &mut Vec<u32>) -> [u32; 2] {
    let closure = scene.models[item.model].closure(item.mesh, item.ratio);
    let Enclosing { roles, lids, .. } = &closure.primitives[item.primitive];
    let mut at = [NONE; 2];
    if !roles.is_empty() {
        at[0] = words.len() as u32;
        let word = |four: &[Role]| four.iter().rev().fold(0, |word, role| word << 8 | u32::from(role.bits()));
        words.extend(roles.chunks(4).map(word));
    }
    if !lids.is_empty() {
        at[1] = words.len() as u32;
        for (corners, role) in lids {
            words.extend(corners.iter().flat_map(|p| (*p - middle).to_array()).map(f32::to_bits));
            words.push(u32::from(role.bits()));
        }
    }
    at
}

fn push_caps(plan: &Plan, item: &Item, words: &mut Vec<u32>) -> u32 {
    if item.caps.is_empty() {
        return NONE;
    }
    let first = words.len() as u32;
    words.push(item.caps.len() as u32);
    for cap in &item.caps {
        let (kind, color) = cap.look.look();
        words.extend([cap.maker as u32, kind]);
        words.extend(color.map(f32::to_bits));
        words.push(plan.outline(cap).map_or(NONE, |op| op as u32));
    }
    first
}

/// Draws of all that may be cut, whole: lenses tell where it matters.
pub fn draws(plan: &Plan, window: &Window, uploaded: &SceneData) -> Vec<Draw> {
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
    members(plan).filter_map(draw).collect()
}

/// Lids of an instance to be drawn.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct LidDraw {
    pub record: u32,
    pub vertices: u32,
    pub rect: PixelRect,
}

/// Draws of all that closes holes over.
pub fn lid_draws(scene: &Scene, plan: &Plan, window: &Window) -> Vec<LidDraw> {
    let draw = |(body, member): (&Body, &Member)| {
        let rect = window.local(&cut_rect(plan, body));
        let item = &plan.items[plan.instances[member.instance].item];
        let closure = scene.models[item.model].closure(item.mesh, item.ratio);
        let vertices = 3 * closure.primitives[item.primitive].lids.len() as u32;
        (!rect.is_empty() && vertices > 0).then_some(LidDraw { record: member.instance as u32, vertices, rect })
    };
    members(plan).filter_map(draw).collect()
}

fn members(plan: &Plan) -> impl Iterator<Item = (&Body, &Member)> {
    plan.bodies.iter().flat_map(|body| body.members.iter().map(move |member| (body, member)))
}

/// The pixels outside which a body is not cut.
pub fn cut_rect(plan: &Plan, body: &Body) -> PixelRect {
    let whole = PixelRect { min: [0, 0], max: plan.view.size };
    // Rules may hold anywhere, and so do lenses that take whole objects.
    let rect = |rank: usize| if plan.by_pixel.contains(rank) { plan.lenses[rank].rect } else { whole };
    plan.cutters(body).iter().map(rect).reduce(PixelRect::union).unwrap_or(PixelRect::EMPTY)
}
