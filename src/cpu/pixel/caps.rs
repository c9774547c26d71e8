//! Caps on the rays of a block: boundaries inside the nodes that an eraser cuts (SEMANTICS 6.6).

use std::sync::Arc;

use super::{BlockRays, OneRay, Tracer, seen_range};
use crate::cpu::block::Block;
use crate::cpu::geometry::Geometry;
use crate::lens::{Boundary, RayLayers};
use crate::pieces::{Around, Role};
use crate::pixel::{Fragment, cap_number};
use crate::plan::{Body, Closing, Instance, LensSet, Member, Plan};
use crate::scene::{Closure, Scene};
use crate::view::{Merging, Ray};

/// The nodes that may be cut, whole: what lenses erase and what lies behind the far plane tells as well where their
/// inside is.
pub struct CutBodies {
    geometry: Geometry,
    /// Of each instance, its place in a body.
    places: Vec<Option<Place>>,
    /// The lenses without which nothing is cut; `None` where something may be anyway.
    cut_by: Option<LensSet>,
}

/// Which member of which body something is, and what its triangles enclose.
struct Place {
    body: u32,
    member: u32,
    closure: Arc<Closure>,
    primitive: usize,
}

/// A ray goes into a member of a body, or out of it.
#[derive(Debug, Clone, Copy)]
pub struct Crossing {
    ray: u32,
    body: u32,
    member: u32,
    depth: f32,
    role: Role,
    turns_left: bool,
}

impl CutBodies {
    /// `None` where no eraser closes anything.
    pub fn new(scene: &Scene, plan: &Plan) -> Option<Self> {
        if plan.bodies.is_empty() {
            return None;
        }
        let mut places: Vec<Option<Place>> = (0..plan.instances.len()).map(|_| None).collect();
        let mut cut_by = LensSet::EMPTY;
        for (number, body) in (0u32..).zip(&plan.bodies) {
            for (member, Member { instance, .. }) in (0u32..).zip(&body.members) {
                let item = &plan.items[plan.instances[*instance].item];
                let closure = scene.models[item.model].closure(item.mesh, item.ratio);
                places[*instance] = Some(Place { body: number, member, closure, primitive: item.primitive });
            }
            cut_by = cut_by | plan.cutters(body);
        }
        let cut_by = (cut_by.minus(plan.by_pixel).is_empty()).then_some(cut_by);
        Some(Self { geometry: Geometry::of_bodies(scene, plan), places, cut_by })
    }
}

impl Tracer<'_> {
    /// Lists the caps on the rays of a block.
    pub(super) fn close(
        &self,
        cut: &CutBodies,
        block: &Block,
        rays: &mut [OneRay],
        bundle: &mut BlockRays,
        crossings: &mut Vec<Crossing>,
        listed: &mut Vec<(u32, Fragment)>,
    ) {
        let Some(range) = seen_range(block, &cut.cut_by, rays) else { return };
        crossings.clear();
        bundle.start(self.sheared(rays), f32::MAX);
        bundle.trace(&cut.geometry, &self.camera, block, &range, |ray, triangle, hit| {
            if let Some(place) = &cut.places[triangle.instance as usize] {
                let Place { body, member, closure, primitive } = place;
                let role = closure.primitives[*primitive].role(triangle.index as usize);
                let (depth, turns_left) = (self.depth(hit.t), hit.turns_left);
                crossings.push(Crossing { ray: ray as u32, body: *body, member: *member, depth, role, turns_left });
            }
            None
        });
        crossings.sort_unstable_by_key(|crossing| (crossing.ray, crossing.body));
        let mut caps: Vec<(f64, Fragment)> = Vec::new();
        let merging = self.plan.view.anchor.merging;
        for met in crossings.chunk_by(|a, b| a.ray == b.ray) {
            let ray = met[0].ray;
            caps.clear();
            for own in met.chunk_by(|a, b| a.body == b.body) {
                let body = &self.plan.bodies[own[0].body as usize];
                self.close_body(body, own, &mut rays[ray as usize], |boundary, cap| caps.push((boundary, cap)));
            }
            // Stable: at one boundary the first body stays first.
            caps.sort_by(|a, b| a.0.total_cmp(&b.0));
            caps.dedup_by(|next, first| !merging.starts_boundary(first.0, next.0));
            listed.extend(caps.iter().map(|(_, cap)| (ray, *cap)));
        }
    }

    /// The caps of one body on a ray, in front of where it surely ends.
    fn close_body(&self, body: &Body, crossings: &[Crossing], one: &mut OneRay, mut found: impl FnMut(f64, Fragment)) {
        let OneRay { ray, layers, moved, opaque, .. } = one;
        let instance = |member: &Member| &self.plan.instances[member.instance];
        // Members are moved alike.
        let steps = &instance(&body.members[0]).steps;
        let layers = moved.all(self.plan, ray, layers, steps);
        for boundary in boundaries((0..=steps.len()).map(&layers), &ray.merging) {
            if opaque.is_some_and(|(opaque, _)| f64::from(opaque.depth) < boundary) {
                continue;
            }
            let set = |steps: usize, behind: bool| {
                if behind { layers(steps).set_at(boundary) } else { layers(steps).set_before(boundary) }
            };
            let closed = |member: &Member| Some((member.instance, self.plan.closing(instance(member), set)?));
            let Some((number, closing)) = around(body, crossings, boundary, &ray.merging).find_map(closed) else {
                continue;
            };
            let cap = Fragment {
                instance: number as u32,
                triangle: cap_number(closing.maker),
                depth: boundary as f32,
                weights: cap_normal(self.plan, &self.plan.instances[number], ray, boundary, &closing),
                region: closing.region,
            };
            found(boundary, cap);
        }
    }
}

/// The depths of all boundaries, each once, nearest first.
fn boundaries<'l>(layers: impl Iterator<Item = &'l RayLayers>, merging: &Merging) -> Vec<f64> {
    let mut depths: Vec<f64> =
        layers.flat_map(|layers| layers.starts.iter().skip(1)).map(|start| start.depth).collect();
    depths.sort_unstable_by(f64::total_cmp);
    depths.dedup_by(|next, first| !merging.starts_boundary(*first, *next));
    depths
}

/// The members of a body that may be closed at a boundary: the first of each group whose pieces enclose it. None where the
/// boundary lies outside.
///
/// Told by what lies behind, so that it makes no difference where the ray starts. A surface in the boundary lies behind it.
fn around<'b>(
    body: &'b Body,
    crossings: &'b [Crossing],
    boundary: f64,
    merging: &Merging,
) -> impl Iterator<Item = &'b Member> + use<'b> {
    let merging = *merging;
    let is_inside = move |counts: &dyn Fn(usize) -> bool| {
        let behind = crossings.iter().filter(|crossing| !merging.starts_boundary(f64::from(crossing.depth), boundary));
        let mut around = Around::default();
        behind
            .filter(|crossing| counts(crossing.member as usize))
            .for_each(|crossing| around.cross(crossing.role, crossing.turns_left));
        around.is_inside()
    };
    let group = |number: usize| body.members[number].group;
    let encloses = move |number: &usize| group(*number) == *number && is_inside(&|other| group(other) == *number);
    let is_in_body = is_inside(&|_| true);
    let numbers = (0..body.members.len()).filter(move |_| is_in_body).filter(encloses);
    numbers.map(|number| &body.members[number])
}

/// The normal of the boundary that is closed, on the viewer's side, as shown.
fn cap_normal(plan: &Plan, instance: &Instance, ray: &Ray, depth: f64, closing: &Closing) -> glam::Vec3 {
    let source_from_shown = instance.source_from_shown(closing.boundary, false);
    let source = ray.moved(&source_from_shown);
    let volume = &plan.lenses[closing.boundary].volume;
    let mut boundaries: Vec<Boundary> = Vec::new();
    volume.boundaries(&source, plan.view.near, plan.view.far, &mut boundaries);
    let away = |boundary: &&Boundary| (boundary.depth - depth).abs();
    let nearest = boundaries.iter().min_by(|a, b| away(a).total_cmp(&away(b)));
    let normal = nearest.map_or(-source.direction, |boundary| volume.normal(&source, boundary));
    let shown = (source_from_shown.matrix3.transpose() * normal).normalize_or(-ray.direction.normalize());
    (if shown.dot(ray.direction) > 0.0 { -shown } else { shown }).as_vec3()
}
