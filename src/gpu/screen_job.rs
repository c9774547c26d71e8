//! The filters of the screen as passes over a window.

use super::pipelines::ScreenPipelines;
use super::targets::ScreenTargets;
use super::{Error, Window, alloc, bindings};
use crate::plan::Plan;

/// Passes that filter each sample of a window, between its resolve and the picture.
#[derive(Debug)]
pub struct ScreenJob {
    pipelines: ScreenPipelines,
    group: wgpu::BindGroup,
    steps: Vec<Step>,
}

/// A filter's work.
#[derive(Debug)]
struct Step {
    /// Of its passes, in this order.
    pipelines: Vec<wgpu::ComputePipeline>,
    /// Where its record stands.
    record: u32,
    /// Pixels of a line that an invocation of a filter that takes means reads; `None`: each invocation sees to a pixel.
    stretch: Option<u32>,
}

/// What a step's shaders are told: the filter, the rank of its lens, and nothing twice.
type StepRecord = [u32; 4];

impl ScreenJob {
    pub fn new(
        device: &wgpu::Device,
        plan: &Plan,
        pipelines: ScreenPipelines,
        layout: &wgpu::BindGroupLayout,
        targets: &ScreenTargets,
        accumulated: &wgpu::Buffer,
    ) -> Result<Self, Error> {
        let stride =
            (size_of::<StepRecord>() as u32).next_multiple_of(device.limits().min_storage_buffer_offset_alignment);
        let (mut records, mut steps) = (Vec::new(), Vec::new());
        for step in &plan.screen {
            let op = &plan.ops[step.op];
            let (pipelines, stretch) =
                if op.draws_lines() { (&pipelines.lines, None) } else { (&pipelines.means, Some(op.mean_side())) };
            steps.push(Step { pipelines: pipelines.clone(), record: records.len() as u32, stretch });
            let record: StepRecord = [step.op as u32, step.rank as u32, 0, 0];
            records.extend_from_slice(bytemuck::bytes_of(&record));
            records.resize(records.len().next_multiple_of(stride as usize), 0);
        }
        let records =
            alloc::filled_buffer(device, "the plan's filters of the screen", &records, wgpu::BufferUsages::STORAGE)?;
        let record = wgpu::BufferBinding {
            buffer: &records,
            offset: 0,
            size: wgpu::BufferSize::new(size_of::<StepRecord>() as u64),
        };
        let group = bindings::group(
            device,
            "screen",
            layout,
            &[
                targets.samples.as_entire_binding(),
                targets.rows.as_entire_binding(),
                targets.marks.as_entire_binding(),
                wgpu::BindingResource::Buffer(record),
                accumulated.as_entire_binding(),
            ],
        );
        Ok(Self { pipelines, group, steps })
    }

    /// Filters the sample that the resolve has written, and draws the picture of all samples up to it. `offset`: of its
    /// record among the plan's frames.
    pub fn encode(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        plan: &wgpu::BindGroup,
        offset: u32,
        window: &Window,
        target: &wgpu::TextureView,
    ) {
        let [width, height] = window.size;
        for Step { pipelines, record, stretch } in &self.steps {
            for (number, pipeline) in pipelines.iter().enumerate() {
                let [across, down] = match stretch {
                    None => [width.div_ceil(8), height.div_ceil(8)],
                    // Squares of pixels may begin before the window and end behind it.
                    Some(pixels) if number == 0 => [width / pixels + 2, height.div_ceil(64)],
                    Some(pixels) => [width.div_ceil(64), height / pixels + 2],
                };
                let mut pass = encoder
                    .begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("screen"), timestamp_writes: None });
                pass.set_pipeline(pipeline);
                pass.set_bind_group(1, plan, &[offset]);
                pass.set_bind_group(2, &self.group, &[*record]);
                pass.dispatch_workgroups(across, down, 1);
            }
        }
        let mut pass = super::job::begin_drawing(encoder, "picture", target, None);
        pass.set_pipeline(&self.pipelines.finish);
        pass.set_bind_group(1, plan, &[offset]);
        pass.set_bind_group(2, &self.group, &[0]);
        pass.draw(0..3, 0..1);
    }
}
