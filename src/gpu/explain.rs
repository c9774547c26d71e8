//! Single pixels as the device finds them: all fragments of one, and what is visible at it.

use glam::Vec3;

use super::readback::Readback;
use super::renderer::Renderer;
use super::targets::FRAGMENT_BYTES;
use super::upload::check_size;
use super::{Error, Headless, RenderOptions, Room, Window};
use crate::pick::Pick;
use crate::pixel::{Fragment, PixelReport, Removed, Survivor};
use crate::plan::{LensSet, Plan, Region};
use crate::scene::Scene;

/// Words a fragment ahead of those of its set and its stack; `REPORT_WORDS` of `shaders/gpu/explain.wgsl`.
const FIXED_WORDS: usize = 12;

/// A fragment as the device reports it.
struct Found {
    survivor: Survivor,
    normal: Vec3,
    displayed: bool,
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
        let found = self.fragments(renderer, scene, plan, pixel)?;
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

    /// All fragments of a pixel, nearest first.
    fn fragments(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        pixel: [u32; 2],
    ) -> Result<Vec<Found>, Error> {
        let window = around(plan, pixel);
        let number = window.place(pixel) as u32;
        loop {
            let job = renderer.prepare_listing(&self.device, scene, plan, window, number)?;
            let Some(sample) = job.samples.iter().find(|sample| sample.maps) else { return Ok(Vec::new()) };
            let mut encoder = self.encoder();
            job.encode_layers(&mut encoder, sample);
            job.encode_visibility(&mut encoder, sample);
            let counts = Readback::of_buffer(&self.device, &mut encoder, &job.needed);
            self.queue.submit([encoder.finish()]);
            let needed = Room::needed(&counts.bytes(&self.device)?);
            self.check()?;
            if !job.room.holds(needed) {
                check_size(renderer.largest_buffer(), "the fragments of a pixel", needed.fragments * FRAGMENT_BYTES)?;
                renderer.reserve(needed);
                continue;
            }
            if needed.fragments == 0 {
                return Ok(Vec::new());
            }
            let stride = FIXED_WORDS + 2 * job.words as usize;
            let report = renderer.explain_pass(&self.device, &job, 4 * stride as u64 * needed.fragments)?;
            let mut encoder = self.encoder();
            job.encode_explain(&mut encoder, sample, &report);
            let copy = Readback::of_buffer(&self.device, &mut encoder, &report.buffer);
            self.queue.submit([encoder.finish()]);
            let bytes = copy.bytes(&self.device)?;
            self.check()?;
            let words: Vec<u32> = bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
            return Ok(words.chunks_exact(stride).map(|words| found(plan, words)).collect());
        }
    }
}

/// The window whose fragments are drawn for one pixel's: some pixels more, for llvmpipe leaves out triangles that cover
/// all of a smaller target when their fragments only write to storage.
fn around(plan: &Plan, pixel: [u32; 2]) -> Window {
    const SIDE: u32 = 32;
    let min = pixel.map(|at| at - at % SIDE);
    Window { min, size: [0, 1].map(|axis| SIDE.min(plan.view.size[axis] - min[axis])) }
}

fn found(plan: &Plan, words: &[u32]) -> Found {
    let (fixed, sets) = words.split_at(FIXED_WORDS);
    let [set, stack] = [0, 1].map(|i| LensSet::from_words(&sets[i * sets.len() / 2..][..sets.len() / 2]));
    let float = |at: usize| f32::from_bits(fixed[at]);
    let instance = fixed[0];
    let fragment = Fragment {
        instance,
        triangle: fixed[1] - plan.items[plan.instances[instance as usize].item].first_triangle,
        depth: float(2),
        weights: Vec3::new(float(6), float(7), float(8)),
        region: Region { set, stack },
    };
    Found {
        survivor: Survivor { fragment, opacity: float(4), coverage: float(5) },
        normal: Vec3::new(float(9), float(10), float(11)),
        displayed: fixed[3] != 0,
    }
}
