//! Everything on one view ray: layers, hits in order, the visible fragment, the colour.

mod moved;
mod removed;

use glam::{Vec3, Vec4};
use obvhs::ray::Ray as BvhRay;

use super::convert::d3;
use super::geometry::{Geometry, Reach, Triangle};
use super::glass::{self, GlassHit};
use super::intersect::ShearedRay;
use super::shade::{Shaded, Shader};
use crate::appearance as wgsl;
use crate::lens::RayLayers;
use crate::pixel::{Fragment, PixelReport, Survivor};
use crate::plan::{Instance, Item, LensSet, Plan, Region, Verdict};
use crate::scene::Scene;
use crate::view::Ray;

use moved::MovedLayers;

/// Traces rays through one plan.
pub struct Tracer<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    geometry: Vec<Geometry>,
    shader: Shader<'a>,
    reach: Reach,
    /// Lenses whose filters may make a fragment translucent.
    translucent: LensSet,
    /// For each geometry: the lenses without which nothing of it is seen, or `None` where some of it may be seen anyway.
    seen_by: Vec<Option<LensSet>>,
}

/// Buffers that live from ray to ray.
#[derive(Default)]
pub struct Scratch {
    layers: RayLayers,
    moved: MovedLayers,
    fragments: Vec<Fragment>,
    glass: Vec<GlassHit>,
}

/// The nearest fragment that surely ends the ray.
type Opaque = Option<Fragment>;

impl<'a> Tracer<'a> {
    pub fn new(scene: &'a Scene, plan: &'a Plan) -> Self {
        let lenses = LensSet::below(plan.lenses.len());
        let shown = |content: usize| {
            let items = plan.items.iter().filter(|item| item.content == content);
            items.fold(LensSet::EMPTY, |all, item| all | item.shown_by)
        };
        let moving = plan.instances.iter().filter_map(|instance| instance.steps.first());
        let moving = moving.fold(LensSet::EMPTY, |all, step| all | LensSet::only(step.rank));
        // A rule, or a lens that takes whole objects, may show something anywhere.
        let needed =
            |lenses_needed: LensSet| lenses_needed.minus(plan.by_pixel & lenses).is_empty().then_some(lenses_needed);
        let alternates = (1..plan.contents.len()).map(|content| needed(shown(content)));
        Self {
            scene,
            plan,
            geometry: Geometry::build_all(scene, plan),
            shader: Shader::new(scene, plan),
            reach: Reach::new(&plan.view),
            translucent: plan.translucent(),
            seen_by: std::iter::once(None).chain(alternates).chain([needed(moving)]).collect(),
        }
    }

    /// The premultiplied linear colour of a point of the picture (pixels from the top left), without background.
    pub fn color(&self, x: f64, y: f64, ranks: &[usize], scratch: &mut Scratch) -> Vec4 {
        let (ray, pixel) = self.rays(x, y);
        let opaque = self.trace(&ray, ranks, scratch);
        glass::find(self.plan, ranks, &ray, &pixel, &mut scratch.glass);
        scratch.fragments.extend(opaque);
        scratch
            .fragments
            .sort_unstable_by(|a, b| self.key(a).partial_cmp(&self.key(b)).unwrap_or(std::cmp::Ordering::Equal));
        scratch.glass.sort_unstable_by(|a, b| a.depth.total_cmp(&b.depth).then(a.rank.cmp(&b.rank)));
        self.composite(scratch, &pixel)
    }

    fn composite(&self, scratch: &Scratch, pixel: &wgsl::PixelRay) -> Vec4 {
        let mut front = Vec4::ZERO;
        let mut glass = scratch.glass.iter().peekable();
        for fragment in &scratch.fragments {
            while let Some(hit) = glass.next_if(|hit| hit.depth < f64::from(fragment.depth)) {
                front = over(front, hit.color.truncate(), hit.color.w);
            }
            let shaded = self.shader.shade(fragment, pixel);
            let opacity = shaded.opacity * shaded.coverage;
            front = over(front, shaded.color, opacity);
            if opacity >= wgsl::OPAQUE_FROM.0 {
                return front;
            }
        }
        glass.fold(front, |front, hit| over(front, hit.color.truncate(), hit.color.w))
    }

    /// What is at a point of the picture, without what lenses take away.
    pub fn report(&self, x: f64, y: f64, ranks: &[usize], scratch: &mut Scratch) -> PixelReport {
        let (ray, pixel) = self.rays(x, y);
        let opaque = self.trace(&ray, ranks, scratch);
        scratch.fragments.extend(opaque);
        scratch
            .fragments
            .sort_unstable_by(|a, b| self.key(a).partial_cmp(&self.key(b)).unwrap_or(std::cmp::Ordering::Equal));
        let mut report = PixelReport { layers: scratch.layers.starts.clone(), ..PixelReport::default() };
        for fragment in &scratch.fragments {
            let Shaded { opacity, coverage, normal, .. } = self.shader.shade(fragment, &pixel);
            if !report.push(Survivor { fragment: *fragment, opacity, coverage }, normal) {
                break;
            }
        }
        report
    }

    /// Collects the surviving fragments that may be translucent, in front of the nearest that surely is opaque.
    fn trace(&self, ray: &Ray, ranks: &[usize], scratch: &mut Scratch) -> Opaque {
        scratch.fragments.clear();
        scratch.glass.clear();
        scratch.moved.clear();
        let volumes = ranks.iter().map(|rank| (*rank, &self.plan.lenses[*rank].volume));
        scratch.layers.find(volumes, ray, self.plan.view.near, self.plan.view.far);
        let around = scratch.layers.starts.iter().fold(LensSet::EMPTY, |all, start| all | start.set);
        let mut opaque: Opaque = None;
        for (geometry, seen_by) in self.geometry.iter().zip(&self.seen_by) {
            let seen = seen_by.is_none_or(|lenses| !(lenses & around).is_empty());
            if seen && !geometry.triangles.is_empty() {
                self.trace_content(geometry, ray, scratch, &mut opaque);
            }
        }
        if let Some(opaque) = &opaque {
            let end = self.key(opaque);
            scratch.fragments.retain(|f| self.key(f) < end);
        }
        opaque
    }

    fn trace_content(&self, geometry: &Geometry, ray: &Ray, scratch: &mut Scratch, opaque: &mut Opaque) {
        let Reach { start, scale } = self.reach;
        let (near, far) = (self.plan.view.near as f32, self.plan.view.far as f32);
        let traced = |depth: f64| ((depth - start) * scale) as f32;
        let (origin, direction) = self.traced(ray);
        let sheared = ShearedRay::new(origin, direction);
        let mut walk_ray = BvhRay::new(origin.into(), direction.into(), 0.0, traced(self.plan.view.far));
        if let Some(known) = &*opaque {
            walk_ray.tmax = traced(f64::from(known.depth)).next_up();
        }
        let mut visit = |slot: u32, end: &mut f32| {
            let triangle = &geometry.triangles[slot as usize];
            let Some(hit) = sheared.hit(&triangle.corners) else { return };
            let depth = (f64::from(hit.t) / scale + start) as f32;
            if hit.t > *end || depth < near || depth > far || self.is_culled(triangle, direction) {
                return;
            }
            let Some(fragment) = self.classify(ray, triangle, depth, hit.weights, &scratch.layers, &mut scratch.moved)
            else {
                return;
            };
            let translucent = self.item(fragment.instance).translucent;
            if translucent || !(fragment.region.stack & self.translucent).is_empty() {
                scratch.fragments.push(fragment);
            } else if opaque.is_none_or(|known| self.key(&fragment) < self.key(&known)) {
                *opaque = Some(fragment);
                *end = hit.t;
            }
        };
        let mut state = geometry.bvh.new_traversal(walk_ray.direction);
        let mut node;
        use glam::UVec2;
        obvhs::traverse!(geometry.bvh, node, state, node.intersect_ray(&walk_ray, state.oct_inv4), {
            visit(state.primitive_id, &mut walk_ray.tmax);
        });
    }

    /// Origin and direction of a ray in the space of the geometry.
    fn traced(&self, ray: &Ray) -> (Vec3, Vec3) {
        let Reach { start, scale } = self.reach;
        let origin = ((ray.at(start) - self.plan.view.eye) * scale).as_vec3();
        // The BVH takes -0 for a negative direction in one place and for a positive one in another: no -0 here.
        (origin, ray.direction.as_vec3() + Vec3::ZERO)
    }

    /// The fragment with its lenses, unless they take it away.
    fn classify(
        &self,
        ray: &Ray,
        triangle: &Triangle,
        depth: f32,
        weights: Vec3,
        layers: &RayLayers,
        moved: &mut MovedLayers,
    ) -> Option<Fragment> {
        let verdict = self.verdict(ray, triangle.instance, depth, layers, moved);
        let region = Region { set: verdict.set, stack: verdict.stack };
        let Triangle { instance, index, .. } = *triangle;
        verdict.displayed.then_some(Fragment { instance, triangle: index, depth, weights, region })
    }

    fn verdict(&self, ray: &Ray, instance: u32, depth: f32, layers: &RayLayers, moved: &mut MovedLayers) -> Verdict {
        let instance = self.instance(instance);
        let depth = f64::from(depth);
        self.plan.walk(instance, |step| match step.checked_sub(1) {
            None => layers.set_at(depth),
            Some(passed) => moved.below(self.plan, ray, &instance.steps[passed]).set_at(depth),
        })
    }

    fn instance(&self, instance: u32) -> &'a Instance {
        &self.plan.instances[instance as usize]
    }

    fn item(&self, instance: u32) -> &'a Item {
        &self.plan.items[self.instance(instance).item]
    }

    fn is_culled(&self, triangle: &Triangle, direction: Vec3) -> bool {
        if !self.plan.cull_backfaces {
            return false;
        }
        let item = self.item(triangle.instance);
        if self.scene.materials[item.material].double_sided != 0 {
            return false;
        }
        let [a, b, c] = triangle.corners;
        let mirrored = self.scene.models[item.model].nodes[item.node].world_from_local.matrix3.determinant() < 0.0;
        ((b - a).cross(c - a).dot(direction) > 0.0) != mirrored
    }

    /// Nearest first; at equal depths by content, node, primitive and triangle.
    fn key(&self, fragment: &Fragment) -> (f32, u32) {
        (fragment.depth, self.item(fragment.instance).first_triangle + fragment.triangle)
    }

    /// The ray of a point of the picture: in the world for intervals, around the eye for shading.
    fn rays(&self, x: f64, y: f64) -> (Ray, wgsl::PixelRay) {
        let view = &self.plan.view;
        let ray = view.ray(x, y);
        let (right, down) = view.pixel_steps();
        let none = glam::DVec3::ZERO;
        let (origin_steps, direction_steps) =
            if view.is_perspective() { ((none, none), (right, down)) } else { ((right, down), (none, none)) };
        let pixel = wgsl::PixelRay {
            origin: d3(ray.origin - view.eye),
            direction: d3(ray.direction),
            origin_dx: d3(origin_steps.0),
            origin_dy: d3(origin_steps.1),
            direction_dx: d3(direction_steps.0),
            direction_dy: d3(direction_steps.1),
        };
        (ray, pixel)
    }
}

fn over(front: Vec4, back: Vec3, alpha: f32) -> Vec4 {
    super::convert::g4(wgsl::over(super::convert::v4(front), super::convert::v3(back), alpha))
}
