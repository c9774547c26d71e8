//! Single pixels as the device finds them: all fragments of one, and what is visible at it.

use glam::Vec3;

use super::frame::Place;
use super::readback::Readback;
use super::renderer::Renderer;
use super::{Error, Headless, RenderOptions, Room, Window};
use crate::pick::Pick;
use crate::pixel::{Fragment, PixelReport, Removed, Survivor, cap_maker};
use crate::plan::{LensSet, Plan, Region};
use crate::scene::Scene;

/// Words a fragment ahead of those of its set and its stack, as in `shaders/gpu/explain.wgsl`.
const FIXED_WORDS: usize = 14;

/// A fragment as the device reports it.
struct Found {
    place: Place,
    survivor: Survivor,
    normal: Vec3,
    displayed: bool,
    /// It is seen only if no surface lies close behind it: see [`Plan::verdict`].
    fills: bool,
}

impl Headless {
    /// What the ray through a pixel's centre meets; an empty report outside the picture.
    pub fn explain(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        pixel: [u32; 2],
    ) -> Result<PixelReport, Error> {
        if !plan.view.has_pixel(pixel) {
            return Ok(PixelReport::default());
        }
        let window = Window { min: pixel, size: [1, 1] };
        let layers = self.layers(renderer, scene, plan, window)?.swap_remove(0);
        let mut report = PixelReport { layers, ..PixelReport::default() };
        let mut found = self.fragments(renderer, scene, plan, window)?;
        outdo(plan, &mut found);
        for Found { survivor, normal, .. } in found.iter().filter(|f| f.displayed) {
            if !report.push(*survivor, *normal) {
                break;
            }
        }
        let end = report.visible.map_or(f32::INFINITY, |visible| visible.fragment.depth);
        let removed = found.into_iter().filter(|f| !f.displayed).map(|f| f.survivor.fragment);
        report.removed = removed
            .filter(|fragment| fragment.depth < end)
            .filter_map(|fragment| {
                let by = plan.removers(&plan.instances[fragment.instance as usize], fragment.region.stack)?;
                Some(Removed { fragment, by })
            })
            .collect();
        Ok(report)
    }

    /// What is visible at a pixel, as the maps have it; `None` where nothing is and outside the picture.
    pub fn pick(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        pixel: [u32; 2],
    ) -> Result<Option<Pick>, Error> {
        if !plan.view.has_pixel(pixel) {
            return Ok(None);
        }
        let window = Window { min: pixel, size: [1, 1] };
        let options = RenderOptions { aovs: true, ..RenderOptions::default() };
        let frame = self.render_part(renderer, scene, plan, window, options, &mut None)?;
        Ok(frame.aovs.and_then(|aovs| Pick::from_map(plan, &aovs, 0, pixel)))
    }

    /// All fragments of a window of one pixel, nearest first: the scene is drawn once for each, and once more.
    fn fragments(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        window: Window,
    ) -> Result<Vec<Found>, Error> {
        let mut all: Vec<Found> = Vec::new();
        let mut after = Place::FIRST;
        while let Some(found) = self.next_behind(renderer, scene, plan, window, after)? {
            let is_there = found.displayed && found.survivor.opacity > 0.0;
            let stack = if is_there { found.survivor.fragment.region.stack } else { LensSet::EMPTY };
            after = Place { passed: after.passed | stack, ..found.place };
            all.push(found);
        }
        Ok(all)
    }

    /// The nearest fragment behind a place.
    fn next_behind(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        window: Window,
        after: Place,
    ) -> Result<Option<Found>, Error> {
        loop {
            let job = renderer.prepare_next_behind(&self.device, scene, plan, window, after)?;
            let Some(sample) = job.samples.iter().find(|sample| sample.maps) else { return Ok(None) };
            let bytes = 4 * (FIXED_WORDS as u64 + 2 * u64::from(job.words));
            let pass = renderer.explain_pass(&self.device, &job, bytes)?;
            let mut encoder = self.encoder();
            job.encode_layers(&mut encoder, sample);
            job.encode_visibility(&mut encoder, sample);
            job.encode_explain(&mut encoder, sample, &pass);
            let counts = Readback::of_buffer(&self.device, &mut encoder, &job.needed)?;
            let copy = Readback::of_buffer(&self.device, &mut encoder, &pass.buffer)?;
            self.queue.submit([encoder.finish()]);
            let needed = Room::needed(&counts.bytes(&self.device)?);
            let bytes = copy.bytes(&self.device)?;
            self.check()?;
            if job.room.holds(needed) {
                let words: Vec<u32> =
                    bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
                return Ok((words[0] != 0).then(|| found(plan, &words[..FIXED_WORDS + 2 * job.words as usize])));
            }
            renderer.reserve(needed);
        }
    }
}

/// Leaves of what fills gaps only what ends the ray: as if it lay its spread farther from the eye.
fn outdo(plan: &Plan, found: &mut [Found]) {
    let translucent = plan.translucent();
    let order = |found: &Found| {
        let Fragment { instance, depth, .. } = found.survivor.fragment;
        let behind = if found.fills { plan.instances[instance as usize].spread as f32 } else { 0.0 };
        depth + behind
    };
    let is_opaque = |found: &&Found| {
        let Fragment { instance, region, .. } = found.survivor.fragment;
        let item = &plan.items[plan.instances[instance as usize].item];
        found.displayed && !item.translucent && (region.stack & translucent).is_empty()
    };
    let end = found.iter().filter(is_opaque).map(order).fold(f32::INFINITY, f32::min);
    found.iter_mut().filter(|found| found.fills && order(found) > end).for_each(|found| found.displayed = false);
}

fn found(plan: &Plan, words: &[u32]) -> Found {
    let (fixed, sets) = words.split_at(FIXED_WORDS);
    let [set, stack] = [0, 1].map(|i| LensSet::from_words(&sets[i * sets.len() / 2..][..sets.len() / 2]));
    let float = |at: usize| f32::from_bits(fixed[at]);
    let instance = fixed[1];
    let first_triangle = plan.items[plan.instances[instance as usize].item].first_triangle;
    let triangle = if cap_maker(fixed[3]).is_some() { fixed[3] } else { fixed[2] - first_triangle };
    let fragment = Fragment {
        instance,
        triangle,
        depth: float(4),
        weights: Vec3::new(float(8), float(9), float(10)),
        region: Region { set, stack },
    };
    Found {
        place: Place { depth: fragment.depth, key: fixed[2], item: instance, passed: LensSet::EMPTY },
        survivor: Survivor { fragment, opacity: float(6), coverage: float(7) },
        normal: Vec3::new(float(11), float(12), float(13)),
        displayed: fixed[5] != 0,
        fills: fixed[5] == 2,
    }
}
