//! What one frame costs, without reading its picture back.

use std::time::Instant;

use super::headless::smaller;
use super::job::Job;
use super::readback::Readback;
use super::renderer::Renderer;
use super::{Error, Headless, RenderOptions, Window, alloc, caps};
use crate::plan::Plan;
use crate::scene::Scene;

/// The stages that the device runs, in their order.
pub const STAGES: [&str; 3] = ["layers", "visibility", "resolve"];

/// What a frame took, in seconds, summed over its windows.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct FrameCost {
    /// On the wall, of all: upload of the plan, encoding, submission, and waiting for the end.
    pub wall: f64,
    /// On the wall, of the upload of the plan alone.
    pub prepare: f64,
    /// On the device, of each of [`STAGES`], summed over samples; `None` where they were not asked for.
    pub stages: Option<[f64; STAGES.len()]>,
    /// Triangles that were drawn for a sample, each as often as it was drawn.
    pub triangles: Triangles,
}

/// How many triangles a frame draws.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Triangles {
    pub drawn: u64,
    /// Of those, the ones whose fragments ask which lenses act on them.
    pub asking: u64,
}

/// Marks on the device's clock between stages.
struct Marks {
    queries: wgpu::QuerySet,
    /// The stage that ended at each mark; the first one only begins.
    ended: Vec<Option<usize>>,
}

impl Headless {
    /// Whether the device can tell how long its stages take.
    pub fn has_timestamps(&self) -> bool {
        self.device.features().contains(caps::TIMESTAMPS)
    }

    /// Draws a picture of a plan, waits for it, and drops it. Asks the device for the times of its stages if `stages`
    /// says so and [`Self::has_timestamps`].
    ///
    /// It does not ask whether the frame had [`Room`](super::Room) enough, so that it costs what it costs a host that
    /// has settled: the renderer must have rendered the plan before.
    pub fn time_frame(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        options: RenderOptions,
        stages: bool,
    ) -> Result<FrameCost, Error> {
        let stages = stages && self.has_timestamps();
        let mut sum = FrameCost { stages: stages.then_some([0.0; STAGES.len()]), ..FrameCost::default() };
        let mut windows = vec![Window::whole(&plan.view)];
        while let Some(window) = windows.pop() {
            let view = self.target(window.size)?.create_view(&Default::default());
            let start = Instant::now();
            let job = match renderer.prepare(&self.device, scene, plan, window, options) {
                Ok(job) => job,
                Err(error) => {
                    windows.extend(smaller(&window, error)?);
                    continue;
                }
            };
            sum.prepare += start.elapsed().as_secs_f64();
            sum.triangles.add(&job);
            let mut marks = stages.then(|| Marks::new(&self.device, job.samples.len()));
            let times = self.submit(&job, &view, marks.as_mut())?;
            sum.wall += start.elapsed().as_secs_f64();
            if let (Some(marks), Some(times), Some(seconds)) = (&marks, times, &mut sum.stages) {
                let period = f64::from(self.queue.get_timestamp_period()) * 1e-9;
                marks.add(&times.bytes(&self.device)?, period, seconds);
            }
        }
        Ok(sum)
    }

    /// Encodes all stages, submits them, and waits.
    fn submit(
        &self,
        job: &Job,
        view: &wgpu::TextureView,
        mut marks: Option<&mut Marks>,
    ) -> Result<Option<Readback>, Error> {
        let mut encoder = self.encoder();
        let mut mark = |encoder: &mut wgpu::CommandEncoder, ended| {
            if let Some(marks) = marks.as_deref_mut() {
                marks.write(encoder, ended);
            }
        };
        mark(&mut encoder, None);
        for sample in &job.samples {
            job.encode_layers(&mut encoder, sample);
            mark(&mut encoder, Some(0));
            job.encode_visibility(&mut encoder, sample);
            mark(&mut encoder, Some(1));
            job.encode_resolve(&mut encoder, sample, view);
            mark(&mut encoder, Some(2));
        }
        let times = marks.map(|marks| marks.read(&self.device, &mut encoder)).transpose()?;
        self.queue.submit([encoder.finish()]);
        self.wait()?;
        Ok(times)
    }
}

impl Triangles {
    fn add(&mut self, job: &Job) {
        for (draw, _) in &job.draws {
            let count = u64::from(job.passes) * draw.indices.len() as u64 / 3;
            self.drawn += count;
            self.asking += if draw.plain { 0 } else { count };
        }
    }
}

impl Marks {
    fn new(device: &wgpu::Device, samples: usize) -> Self {
        let count = 1 + (STAGES.len() * samples) as u32;
        let descriptor = wgpu::QuerySetDescriptor { label: Some("stages"), ty: wgpu::QueryType::Timestamp, count };
        Self { queries: device.create_query_set(&descriptor), ended: Vec::new() }
    }

    fn write(&mut self, encoder: &mut wgpu::CommandEncoder, ended: Option<usize>) {
        encoder.write_timestamp(&self.queries, self.ended.len() as u32);
        self.ended.push(ended);
    }

    fn read(&self, device: &wgpu::Device, encoder: &mut wgpu::CommandEncoder) -> Result<Readback, Error> {
        let count = self.ended.len() as u32;
        let descriptor = wgpu::BufferDescriptor {
            label: Some("marks"),
            size: 8 * u64::from(count),
            usage: wgpu::BufferUsages::QUERY_RESOLVE | wgpu::BufferUsages::COPY_SRC,
            mapped_at_creation: false,
        };
        let ticks = alloc::buffer(device, "the marks of stages", &descriptor)?;
        encoder.resolve_query_set(&self.queries, 0..count, &ticks, 0);
        Readback::of_buffer(device, encoder, &ticks)
    }

    /// Adds what lies between the marks. `period`: seconds a tick.
    fn add(&self, ticks: &[u8], period: f64, seconds: &mut [f64; STAGES.len()]) {
        let tick = |bytes: &[u8]| bytes.iter().rev().fold(0, |sum, byte| sum << 8 | u64::from(*byte));
        let ticks: Vec<u64> = ticks.chunks_exact(8).map(tick).collect();
        for (pair, ended) in ticks.windows(2).zip(&self.ended[1..]) {
            if let Some(stage) = ended {
                seconds[*stage] += pair[1].saturating_sub(pair[0]) as f64 * period;
            }
        }
    }
}
