//! What a baseline's frame is: passes of draws, and records that every frame uploads anew, as a viewer would.

use std::ops::Range;
use std::rc::Rc;
use std::time::Instant;

use lenspeel::appearance::srgb_from_linear;
use lenspeel::plan::Plan;

use super::host::{COLOR_FORMAT, DEPTH_FORMAT, Host};

/// A triangle list.
#[derive(Clone)]
pub struct Mesh {
    /// Positions, and normals where it has them.
    pub vertices: Vec<wgpu::Buffer>,
    pub indices: wgpu::Buffer,
    pub index_count: u32,
}

pub struct Draw {
    pub pipeline: wgpu::RenderPipeline,
    pub group: wgpu::BindGroup,
    pub mesh: Mesh,
    pub instances: Range<u32>,
}

pub struct Pass {
    /// `None`: only depths are drawn.
    pub color: Option<wgpu::TextureView>,
    pub depth: wgpu::TextureView,
    pub draws: Vec<Draw>,
}

/// A frame, ready to be drawn any number of times.
pub struct Baseline {
    host: Rc<Host>,
    target: wgpu::Texture,
    background: wgpu::Color,
    /// Uniform buffers and what each frame writes into them.
    records: Vec<(wgpu::Buffer, Vec<u8>)>,
    passes: Vec<Pass>,
}

impl Baseline {
    /// A frame of one pass with a picture and depths, until more are added.
    pub fn new(host: &Rc<Host>, plan: &Plan) -> Self {
        let target = host.texture(plan.view.size, COLOR_FORMAT, wgpu::TextureUsages::COPY_SRC);
        let [r, g, b, a] = plan.background;
        let encoded = |c: f32| f64::from(srgb_from_linear(c));
        let background = wgpu::Color { r: encoded(r), g: encoded(g), b: encoded(b), a: f64::from(a) };
        Self { host: host.clone(), target, background, records: Vec::new(), passes: Vec::new() }
    }

    /// A uniform buffer that every frame fills.
    pub fn uniform(&mut self, bytes: Vec<u8>) -> wgpu::Buffer {
        let usage = wgpu::BufferUsages::UNIFORM | wgpu::BufferUsages::COPY_DST;
        let buffer = self.host.buffer(&bytes, usage);
        self.records.push((buffer.clone(), bytes));
        buffer
    }

    /// The pass that draws the picture.
    pub fn picture(&mut self, draws: Vec<Draw>) {
        let [width, height] = [self.target.width(), self.target.height()];
        let depth = self.host.texture([width, height], DEPTH_FORMAT, wgpu::TextureUsages::empty());
        let color = Some(self.target.create_view(&Default::default()));
        self.passes.push(Pass { color, depth: depth.create_view(&Default::default()), draws });
    }

    /// A pass that draws depths alone.
    pub fn depths(&mut self, depth: &wgpu::TextureView, draws: Vec<Draw>) {
        self.passes.push(Pass { color: None, depth: depth.clone(), draws });
    }

    /// Seconds of one frame: upload, encoding, submission, and waiting for the end.
    pub fn frame(&self) -> Result<f64, String> {
        let start = Instant::now();
        for (buffer, bytes) in &self.records {
            self.host.queue.write_buffer(buffer, 0, bytes);
        }
        let mut encoder = self.host.device.create_command_encoder(&Default::default());
        self.passes.iter().for_each(|pass| self.encode(&mut encoder, pass));
        self.host.queue.submit([encoder.finish()]);
        self.host.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| error.to_string())?;
        let seconds = start.elapsed().as_secs_f64();
        self.host.check()?;
        Ok(seconds)
    }

    fn encode(&self, encoder: &mut wgpu::CommandEncoder, pass: &Pass) {
        let color = pass.color.as_ref().map(|view| wgpu::RenderPassColorAttachment {
            view,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(self.background), store: wgpu::StoreOp::Store },
        });
        // Depths alone are drawn to be read.
        let store = if color.is_some() { wgpu::StoreOp::Discard } else { wgpu::StoreOp::Store };
        let colors: &[_] = if color.is_some() { &[color] } else { &[] };
        let mut drawing = encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
            label: None,
            color_attachments: colors,
            depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
                view: &pass.depth,
                depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store }),
                stencil_ops: None,
            }),
            timestamp_writes: None,
            occlusion_query_set: None,
            multiview_mask: None,
        });
        for draw in &pass.draws {
            drawing.set_pipeline(&draw.pipeline);
            drawing.set_bind_group(0, &draw.group, &[]);
            for (slot, vertices) in (0u32..).zip(&draw.mesh.vertices) {
                drawing.set_vertex_buffer(slot, vertices.slice(..));
            }
            drawing.set_index_buffer(draw.mesh.indices.slice(..), wgpu::IndexFormat::Uint32);
            drawing.draw_indexed(0..draw.mesh.index_count, 0, draw.instances.clone());
        }
    }

    /// The picture that the last frame has drawn.
    pub fn pixels(&self) -> Result<Vec<[u8; 4]>, String> {
        let (width, height) = (self.target.width(), self.target.height());
        let row = (4 * width).next_multiple_of(wgpu::COPY_BYTES_PER_ROW_ALIGNMENT);
        let device = &self.host.device;
        let copy = device.create_buffer(&wgpu::BufferDescriptor {
            label: None,
            size: u64::from(row) * u64::from(height),
            usage: wgpu::BufferUsages::MAP_READ | wgpu::BufferUsages::COPY_DST,
            mapped_at_creation: false,
        });
        let mut encoder = device.create_command_encoder(&Default::default());
        let layout = wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(row), rows_per_image: None };
        let into = wgpu::TexelCopyBufferInfo { buffer: &copy, layout };
        encoder.copy_texture_to_buffer(self.target.as_image_copy(), into, self.target.size());
        self.host.queue.submit([encoder.finish()]);
        copy.map_async(wgpu::MapMode::Read, .., |_| ());
        device.poll(wgpu::PollType::wait_indefinitely()).map_err(|error| error.to_string())?;
        let bytes = copy.get_mapped_range(..).map_err(|error| error.to_string())?;
        let rows = bytes.chunks_exact(row as usize);
        let pixels =
            rows.flat_map(|bytes| bytes[..4 * width as usize].chunks_exact(4).map(|p| [p[0], p[1], p[2], p[3]]));
        let pixels = pixels.collect();
        self.host.check()?;
        Ok(pixels)
    }
}
