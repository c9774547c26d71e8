//! Everything on the view rays of a block: layers, hits in order, the visible fragment, the colour.

mod caps;
mod coincident;
mod contact;
mod moved;
mod removed;

use std::sync::atomic::Ordering;

use glam::{Vec2, Vec3, Vec4};

use super::block::{Block, BlockRays, Camera};
use super::convert::{d3, v2};
use super::geometry::{self, Geometry, Triangle};
use super::glass::GlassHits;
use super::intersect::ShearedRay;
use super::shade::{Shaded, Shader};
use crate::appearance as wgsl;
use crate::frame::InFront;
use crate::lens::{PixelRect, RayLayers};
use crate::pixel::{Fragment, PixelReport, Survivor, Visible, cap_maker};
use crate::plan::{Instance, Item, LensSet, Plan, Region, Verdict};
use crate::scene::Scene;
use crate::view::{Merging, Ray};

use caps::{Crossing, CutBodies};
use moved::MovedLayers;

/// Traces rays through one plan.
pub struct Tracer<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    geometry: Vec<Geometry>,
    /// Where some eraser closes what it cuts.
    cut: Option<CutBodies>,
    shader: Shader<'a>,
    camera: Camera,
    /// At which rays are traced.
    scale: f64,
    /// Lenses whose filters may make a fragment translucent.
    translucent: LensSet,
    /// For each instance: the lenses and rules without which all of it is there and opaque; `None` where it may be
    /// neither, anyway.
    altered_by: Vec<Option<LensSet>>,
    /// Rules, and lenses that take whole objects: they may act anywhere.
    anywhere: LensSet,
    /// For each geometry: the lenses without which nothing of it is seen, or `None` where some of it may be seen anyway.
    seen_by: Vec<Option<LensSet>>,
}

/// A block of rays with what they met, and buffers that live from block to block.
#[derive(Default)]
pub struct Scratch {
    bundle: BlockRays,
    rays: Vec<OneRay>,
    /// Fragments that may be translucent, in front of the opaque one of their ray, and the rays' numbers: by ray, nearest
    /// first.
    listed: Vec<(u32, Fragment)>,
    crossings: Vec<Crossing>,
    glass: GlassHits,
    /// What lenses take away: the rays' numbers, the depth, and who does; only noted where it is there.
    removed: Option<Vec<(u32, f32, LensSet)>>,
}

/// One ray of a block.
#[derive(Default)]
struct OneRay {
    ray: Ray,
    /// The point of the picture, in pixels.
    at: Vec2,
    layers: RayLayers,
    moved: MovedLayers,
    /// The fragment that surely ends the ray, and how far behind its depth it gives way to others.
    opaque: Option<(Fragment, f32)>,
}

impl Scratch {
    /// One that notes what lenses take away.
    pub fn noting() -> Self {
        Self { removed: Some(Vec::new()), ..Self::default() }
    }

    /// Where a ray of the block traced last surely ends.
    pub fn depth(&self, sample: usize) -> f32 {
        self.rays[sample].opaque.map_or(f32::INFINITY, |(fragment, _)| fragment.depth)
    }
}

impl<'a> Tracer<'a> {
    pub fn new(scene: &'a Scene, plan: &'a Plan) -> Self {
        let lenses = LensSet::below(plan.lenses.len());
        let shown = |content: usize| {
            let items = plan.items.iter().filter(|item| item.content == content);
            items.fold(LensSet::EMPTY, |all, item| all | item.shown_by)
        };
        let moving = plan.instances.iter().filter_map(|instance| instance.steps.first());
        let moving = moving.fold(LensSet::EMPTY, |all, step| all | LensSet::only(step.rank));
        let anywhere = (lenses | plan.rule_ranks()).minus(plan.by_pixel);
        let needed = |lenses: LensSet| (lenses & anywhere).is_empty().then_some(lenses);
        let alternates = (1..plan.contents.len()).map(|content| needed(shown(content)));
        let simplified = plan.items.iter().filter(|item| item.is_simplified());
        let simplifying = simplified.fold(LensSet::EMPTY, |all, item| all | plan.simplifying_to(item));
        let altered_by = |instance: &Instance| {
            let item = &plan.items[instance.item];
            let always = item.is_alternate() || item.is_simplified() || item.translucent || instance.is_moved();
            (!always).then(|| plan.altering(item))
        };
        Self {
            scene,
            plan,
            geometry: Geometry::build_all(scene, plan),
            cut: CutBodies::new(scene, plan),
            shader: Shader::new(scene, plan),
            camera: Camera::new(&plan.view),
            scale: geometry::scale(&plan.view),
            translucent: plan.translucent(),
            altered_by: plan.instances.iter().map(altered_by).collect(),
            anywhere,
            seen_by: std::iter::once(None).chain(alternates).chain([needed(simplifying), needed(moving)]).collect(),
        }
    }

    /// Counts the work of the user's own filters anew.
    pub fn start_picture(&self) {
        self.shader.spent.store(0, Ordering::Relaxed);
    }

    /// Loop iterations that the user's own filters have taken for the picture.
    pub fn filter_iterations(&self) -> u64 {
        self.shader.spent.load(Ordering::Relaxed)
    }

    /// Meets the rays of a block with everything. `ranks`: the lenses that may touch it.
    pub fn trace(&self, block: &Block, ranks: &[usize], scratch: &mut Scratch) {
        let Scratch { bundle, rays, listed, crossings, removed, .. } = scratch;
        listed.clear();
        removed.iter_mut().for_each(Vec::clear);
        rays.resize_with(rays.len().max(block.len()), OneRay::default);
        for (number, one) in rays[..block.len()].iter_mut().enumerate() {
            self.start(block, number, ranks, one);
        }
        bundle.start(self.sheared(&rays[..block.len()]), self.parameter(self.plan.view.far));
        let lenses = self.anywhere | ranks.iter().copied().collect();
        for (geometry, seen_by) in self.geometry.iter().zip(&self.seen_by) {
            let Some(range) = seen_range(block, seen_by, rays).filter(|_| !geometry.triangles.is_empty()) else {
                continue;
            };
            bundle.trace(geometry, &self.camera, block, &range, |number, triangle, hit| {
                let one = &mut rays[number];
                let depth = self.depth_of(triangle, hit, &one.ray);
                let (near, far) = (self.plan.view.near as f32, self.plan.view.far as f32);
                if depth < near || depth > far || self.is_culled(triangle, &one.ray) {
                    return None;
                }
                let Triangle { instance, index, .. } = *triangle;
                let mut fragment =
                    Fragment { instance, triangle: index, depth, weights: hit.weights, region: Region::PLAIN };
                let mut behind = 0.0;
                if !self.is_plain(instance, lenses) {
                    let verdict = self.verdict(&one.ray, instance, depth, &one.layers, &mut one.moved);
                    if !verdict.displayed {
                        let told = verdict.here || !self.instance(instance).is_moved();
                        if let Some(removed) = removed.as_mut().filter(|_| told) {
                            removed.push((number as u32, depth, verdict.removed_by));
                        }
                        return None;
                    }
                    fragment.region = Region { set: verdict.set, stack: verdict.stack };
                    if self.may_be_translucent(self.instance(instance), verdict.stack) {
                        listed.push((number as u32, fragment));
                        return None;
                    }
                    if verdict.fills {
                        behind = self.instance(instance).spread as f32;
                    }
                }
                let order = |(fragment, behind): (Fragment, f32)| {
                    let (depth, number) = self.key(&fragment);
                    (depth + behind, number)
                };
                let is_nearer = one.opaque.is_none_or(|known| order((fragment, behind)) < order(known));
                is_nearer.then(|| {
                    one.opaque = Some((fragment, behind));
                    if behind > 0.0 {
                        self.parameter(f64::from(depth + behind))
                    } else {
                        self.end_behind(triangle, hit.t)
                    }
                })
            });
        }
        if let Some(cut) = &self.cut {
            self.close(cut, block, &mut rays[..block.len()], bundle, crossings, listed);
        }
        self.finish(&mut rays[..block.len()], lenses, listed);
    }

    fn sheared<'r>(&self, rays: &'r [OneRay]) -> impl Iterator<Item = ShearedRay> + use<'_, 'r, 'a> {
        rays.iter().map(|one| self.traced(&one.ray))
    }

    /// Cuts a ray into layers.
    fn start(&self, block: &Block, number: usize, ranks: &[usize], one: &mut OneRay) {
        let (x, y) = block.point(number);
        let view = &self.plan.view;
        one.ray = view.ray(x, y);
        one.at = Vec2::new(x as f32, y as f32);
        one.moved.clear();
        one.opaque = None;
        let volumes = ranks.iter().map(|rank| (*rank, &self.plan.lenses[*rank].volume));
        one.layers.find(volumes, &one.ray, view.near, view.far);
    }

    /// Whether all of an instance is there and opaque where no other lenses and rules may act.
    fn is_plain(&self, instance: u32, lenses: LensSet) -> bool {
        self.altered_by[instance as usize].is_some_and(|altering| (altering & lenses).is_empty())
    }

    /// Says who acts on the opaque fragments that did not ask, and leaves of the others those that can be seen, in order.
    fn finish(&self, rays: &mut [OneRay], lenses: LensSet, listed: &mut Vec<(u32, Fragment)>) {
        for one in rays.iter_mut() {
            if let Some((fragment, _)) = one.opaque.as_mut().filter(|(own, _)| self.is_plain(own.instance, lenses)) {
                let verdict = self.verdict(&one.ray, fragment.instance, fragment.depth, &one.layers, &mut one.moved);
                fragment.region = Region { set: verdict.set, stack: verdict.stack };
            }
        }
        listed.retain(|(ray, fragment)| {
            rays[*ray as usize].opaque.is_none_or(|(opaque, _)| self.key(fragment) < self.key(&opaque))
        });
        listed.sort_unstable_by(|(a, f), (b, g)| {
            a.cmp(b).then(self.key(f).partial_cmp(&self.key(g)).unwrap_or(std::cmp::Ordering::Equal))
        });
    }

    /// The premultiplied linear colour of a sample of the block traced last, without background. `ranks` as there.
    pub fn color(&self, sample: usize, ranks: &[usize], scratch: &mut Scratch) -> Vec4 {
        self.composite(sample, ranks, scratch, |_, _| ())
    }

    /// The same, and what is visible at the sample.
    pub fn seen(&self, sample: usize, ranks: &[usize], scratch: &mut Scratch) -> (Vec4, Option<Visible>) {
        let (mut visible, mut goes_on) = (None, true);
        let color = self.composite(sample, ranks, scratch, |survivor, normal| {
            goes_on = goes_on && survivor.see(normal, &mut visible);
        });
        (color, visible)
    }

    /// `meet` is told of each fragment, nearest first, and of its normal.
    fn composite(
        &self,
        sample: usize,
        ranks: &[usize],
        scratch: &mut Scratch,
        mut meet: impl FnMut(Survivor, Vec3),
    ) -> Vec4 {
        let Scratch { rays, listed, glass: surfaces, .. } = scratch;
        let one = &rays[sample];
        let ray = &one.ray;
        let pixel = &self.pixel_ray(ray, one.at);
        surfaces.find(self.plan, ranks, ray, pixel);
        let mut front = Vec4::ZERO;
        let mut passed = LensSet::EMPTY;
        let mut glass = surfaces.hits.iter().peekable();
        for fragment in fragments(sample, one, listed) {
            while let Some(hit) = glass.next_if(|hit| is_in_front(hit.depth, fragment, &ray.merging)) {
                front = over(front, hit.color.truncate(), hit.color.w);
            }
            let Shaded { color, opacity, coverage, normal } = self.shader.shade(fragment, pixel, passed);
            if opacity > 0.0 {
                passed = passed | fragment.region.stack;
            }
            meet(Survivor { fragment: *fragment, opacity, coverage }, normal);
            let opacity = opacity * coverage;
            let color = self.with_contact_lines(color, fragment, &surfaces.contacts, ray, pixel);
            front = over(front, color, opacity);
            if opacity >= wgsl::OPAQUE_FROM.0 {
                return front;
            }
        }
        glass.fold(front, |front, hit| over(front, hit.color.truncate(), hit.color.w))
    }

    /// What is at a sample of the block traced last, without what lenses take away.
    pub fn report(&self, sample: usize, scratch: &Scratch) -> PixelReport {
        let one = &scratch.rays[sample];
        let pixel = self.pixel_ray(&one.ray, one.at);
        let mut report = PixelReport { layers: one.layers.starts.clone(), ..PixelReport::default() };
        let mut passed = LensSet::EMPTY;
        for fragment in fragments(sample, one, &scratch.listed) {
            let Shaded { opacity, coverage, normal, .. } = self.shader.shade(fragment, &pixel, passed);
            if opacity > 0.0 {
                passed = passed | fragment.region.stack;
            }
            if !report.push(Survivor { fragment: *fragment, opacity, coverage }, normal) {
                break;
            }
        }
        report
    }

    /// Counts what lies in front of what is visible at each sample of the block traced last, in a [`Scratch::noting`];
    /// `nearest` is told of each sample's nearest surface.
    pub fn count_in_front(
        &self,
        samples: usize,
        scratch: &Scratch,
        counts: &mut InFront,
        nearest: &mut Vec<Option<Region>>,
    ) {
        let mut removers = vec![LensSet::EMPTY; samples];
        let reports: Vec<PixelReport> = (0..samples).map(|sample| self.report(sample, scratch)).collect();
        for (ray, depth, by) in scratch.removed.iter().flatten() {
            let end = reports[*ray as usize].visible.map_or(f32::INFINITY, |visible| visible.fragment.depth);
            if *depth < end {
                removers[*ray as usize] = removers[*ray as usize] | *by;
            }
        }
        for (sample, (report, removers)) in reports.iter().zip(removers).enumerate() {
            let is_visible = |s: &&Survivor| report.visible.is_some_and(|visible| visible.fragment == s.fragment);
            let mut regions: Vec<Region> =
                report.fragments.iter().filter(|s| !is_visible(s)).map(|s| s.fragment.region).collect();
            regions.sort_unstable();
            regions.dedup();
            counts.count(removers, &regions);
            nearest.push(fragments(sample, &scratch.rays[sample], &scratch.listed).next().map(|f| f.region));
        }
    }

    /// From a ray's parameter in the space of the geometry to a depth, and back.
    fn depth(&self, parameter: f32) -> f32 {
        (f64::from(parameter) / self.scale) as f32
    }

    fn parameter(&self, depth: f64) -> f32 {
        (depth * self.scale) as f32
    }

    /// A ray in the space of the geometry.
    fn traced(&self, ray: &Ray) -> ShearedRay {
        ShearedRay::new((ray.origin - self.plan.view.origin()) * self.scale, ray.direction)
    }

    fn verdict(&self, ray: &Ray, instance: u32, depth: f32, layers: &RayLayers, moved: &mut MovedLayers) -> Verdict {
        let instance = self.instance(instance);
        let depth = f64::from(depth);
        let verdict = self.plan.verdict(instance, depth, |step, depth| match step.checked_sub(1) {
            None => layers.set_at(depth),
            Some(passed) => moved.below(self.plan, ray, &instance.steps[passed]).set_at(depth),
        });
        // What is seen through does not fill in: it would be seen twice.
        let gives_up = verdict.fills && self.may_be_translucent(instance, verdict.stack);
        if gives_up { Verdict { displayed: false, fills: false, ..verdict } } else { verdict }
    }

    fn may_be_translucent(&self, instance: &Instance, stack: LensSet) -> bool {
        self.plan.items[instance.item].translucent || !(stack & self.translucent).is_empty()
    }

    fn instance(&self, instance: u32) -> &'a Instance {
        &self.plan.instances[instance as usize]
    }

    fn item(&self, instance: u32) -> &'a Item {
        &self.plan.items[self.instance(instance).item]
    }

    fn is_culled(&self, triangle: &Triangle, ray: &Ray) -> bool {
        if !self.plan.cull_backfaces {
            return false;
        }
        let item = self.item(triangle.instance);
        if self.scene.materials[item.material].double_sided != 0 {
            return false;
        }
        let [a, b, c] = triangle.corners;
        let mirrored = self.scene.models[item.model].nodes[item.node].world_from_local.matrix3.determinant() < 0.0;
        let [a, b, c] = [a, b, c].map(|p| p.as_dvec3());
        ((b - a).cross(c - a).dot(ray.direction) > 0.0) != mirrored
    }

    /// Nearest first; at equal depths by content, node, primitive and triangle, where a cap comes first.
    fn key(&self, fragment: &Fragment) -> (f32, u32) {
        let number = if cap_maker(fragment.triangle).is_some() { 0 } else { fragment.triangle };
        (fragment.depth, self.item(fragment.instance).first_triangle + number)
    }

    /// A ray around the view's origin, for shading; `at`: the point of the picture, in pixels.
    fn pixel_ray(&self, ray: &Ray, at: Vec2) -> wgsl::PixelRay {
        let view = &self.plan.view;
        let (right, down) = view.pixel_steps();
        let [origin, direction] = view.shares();
        wgsl::PixelRay {
            origin: d3(ray.origin - view.origin()),
            direction: d3(ray.direction),
            origin_dx: d3(right * origin),
            origin_dy: d3(down * origin),
            direction_dx: d3(right * direction),
            direction_dy: d3(down * direction),
            pixel: v2(at),
        }
    }
}

/// The fragments of a ray that can be seen, nearest first.
fn fragments<'f>(sample: usize, one: &'f OneRay, listed: &'f [(u32, Fragment)]) -> impl Iterator<Item = &'f Fragment> {
    let first = listed.partition_point(|(ray, _)| (*ray as usize) < sample);
    let own = listed[first..].iter().take_while(move |(ray, _)| *ray as usize == sample);
    own.map(|(_, fragment)| fragment).chain(one.opaque.iter().map(|(fragment, _)| fragment))
}

/// The samples of a block that may see a geometry; `None` where none does.
fn seen_range(block: &Block, seen_by: &Option<LensSet>, rays: &[OneRay]) -> Option<PixelRect> {
    let Some(lenses) = seen_by else { return Some(block.all()) };
    let sees = |one: &OneRay| one.layers.starts.iter().any(|layer| !(layer.set & *lenses).is_empty());
    let seeing = (0..block.len()).filter(|number| sees(&rays[*number])).map(|number| block.place(number));
    seeing.map(|[x, y]| PixelRect { min: [x, y], max: [x + 1, y + 1] }).reduce(PixelRect::union)
}

/// Whether a lens surface is in front of a fragment. A cap lies in one, and covers it whatever rounding makes of that.
fn is_in_front(glass: f64, fragment: &Fragment, merging: &Merging) -> bool {
    let depth = f64::from(fragment.depth);
    if cap_maker(fragment.triangle).is_some() { merging.starts_boundary(glass, depth) } else { glass < depth }
}

fn over(front: Vec4, back: Vec3, alpha: f32) -> Vec4 {
    super::convert::g4(wgsl::over(super::convert::v4(front), super::convert::v3(back), alpha))
}
