//! A frame ready to be encoded, stage by stage.

use std::sync::Arc;

use super::cut_data::LidDraw;
use super::draws::Draw;
use super::frame::Sample;
use super::pipelines::Pipelines;
use super::screen_job::ScreenJob;
use super::targets::Targets;
use super::tiles::{DISPATCH_WIDTH, Tiles};
use super::{Room, Window};
use crate::lens::PixelRect;

/// A frame ready to be encoded, stage by stage.
#[derive(Debug)]
pub struct Job {
    pub samples: Vec<Sample>,
    pub window: Window,
    /// Counters of the room that each sample needs.
    pub needed: wgpu::Buffer,
    pub room: Room,
    /// What lies at the pixel centres, when asked for.
    pub maps: Option<wgpu::Buffer>,
    pub words: u32,
    pub passes: u32,
    pub tiles: Tiles,
    pub record_stride: u32,
    pub draws: Vec<(Draw, wgpu::RenderPipeline)>,
    /// Where something may be cut.
    pub caps: Option<CapSteps>,
    pub positions: wgpu::Buffer,
    pub items: wgpu::Buffer,
    pub indices: wgpu::Buffer,
    pub compute: ComputeSteps,
    /// Those that give accounts of pixels.
    pub accounts: Arc<Pipelines>,
    /// `None` where no picture is drawn.
    pub resolve: Option<ResolvePipelines>,
    /// Filters of the screen, where there are some.
    pub screen: Option<ScreenJob>,
    pub targets: Arc<Targets>,
    pub groups: Groups,
}

/// What finds caps.
#[derive(Debug)]
pub struct CapSteps {
    /// Of all that may be cut.
    pub draws: Vec<Draw>,
    pub crossings: wgpu::RenderPipeline,
    /// What closes holes of it over, if any.
    pub lids: Option<(Vec<LidDraw>, wgpu::RenderPipeline)>,
    pub find: wgpu::ComputePipeline,
}

/// What is not drawn but computed.
#[derive(Debug)]
pub struct ComputeSteps {
    /// Where rays are cut into layers.
    pub layers: Option<wgpu::ComputePipeline>,
    /// When maps are asked for.
    pub aov: Option<wgpu::ComputePipeline>,
}

#[derive(Debug)]
pub struct Groups {
    pub scene: wgpu::BindGroup,
    pub plan: wgpu::BindGroup,
    pub layers: wgpu::BindGroup,
    pub visibility: wgpu::BindGroup,
    pub resolve: wgpu::BindGroup,
    pub maps: Option<wgpu::BindGroup>,
}

/// What composites pixels.
#[derive(Debug)]
pub enum ResolvePipelines {
    /// Into the picture: those of tiles that lenses touch, and those of all others.
    Tiles { inside: wgpu::RenderPipeline, outside: wgpu::RenderPipeline },
    /// One sample into a buffer, for filters of the screen.
    Sample(wgpu::ComputePipeline),
}

/// Writes the fragment of one pixel into a buffer.
#[derive(Debug)]
pub struct ExplainPass {
    pub pipeline: wgpu::ComputePipeline,
    pub group: wgpu::BindGroup,
    pub buffer: wgpu::Buffer,
}

impl Job {
    fn offset(&self, sample: &Sample, layer: u32) -> u32 {
        (sample.index * self.passes + layer) * self.record_stride
    }

    /// Cuts the rays of the pixels that lenses touch into layers.
    pub fn encode_layers(&self, encoder: &mut wgpu::CommandEncoder, sample: &Sample) {
        let Some(pipeline) = self.compute.layers.as_ref().filter(|_| self.tiles.active > 0) else { return };
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("layers"), timestamp_writes: None });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.groups.scene, &[]);
        pass.set_bind_group(1, &self.groups.plan, &[self.offset(sample, 0)]);
        pass.set_bind_group(2, &self.groups.layers, &[]);
        dispatch_tiles(&mut pass, self.tiles.active);
    }

    /// Draws the scene: once, or once for each layer, farthest first.
    pub fn encode_visibility(&self, encoder: &mut wgpu::CommandEncoder, sample: &Sample) {
        encoder.clear_buffer(&self.targets.heads, 0, None);
        let mut pass = begin_drawing(encoder, "visibility", &self.targets.ids, Some(&self.targets.depth));
        pass.set_bind_group(0, &self.groups.scene, &[]);
        pass.set_bind_group(2, &self.groups.visibility, &[]);
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_vertex_buffer(1, self.items.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        for layer in (0..self.passes).rev() {
            pass.set_bind_group(1, &self.groups.plan, &[self.offset(sample, layer)]);
            for (draw, pipeline) in &self.draws {
                pass.set_pipeline(pipeline);
                let PixelRect { min, max } = draw.rect;
                pass.set_scissor_rect(min[0], min[1], max[0] - min[0], max[1] - min[1]);
                pass.draw_indexed(draw.indices.clone(), draw.base_vertex, draw.record..draw.record + 1);
            }
        }
        drop(pass);
        if let Some(caps) = self.caps.as_ref().filter(|caps| !caps.draws.is_empty()) {
            self.encode_caps(encoder, sample, caps);
        }
    }

    /// Lists what rays meet of all that may be cut, then the caps that close it.
    fn encode_caps(&self, encoder: &mut wgpu::CommandEncoder, sample: &Sample, caps: &CapSteps) {
        let mut pass = begin_listing(encoder, "crossings", &self.targets.depth);
        pass.set_bind_group(0, &self.groups.scene, &[]);
        pass.set_bind_group(1, &self.groups.plan, &[self.offset(sample, 0)]);
        pass.set_bind_group(2, &self.groups.visibility, &[]);
        pass.set_vertex_buffer(0, self.positions.slice(..));
        pass.set_vertex_buffer(1, self.items.slice(..));
        pass.set_index_buffer(self.indices.slice(..), wgpu::IndexFormat::Uint32);
        pass.set_pipeline(&caps.crossings);
        for draw in &caps.draws {
            let PixelRect { min, max } = draw.rect;
            pass.set_scissor_rect(min[0], min[1], max[0] - min[0], max[1] - min[1]);
            pass.draw_indexed(draw.indices.clone(), draw.base_vertex, draw.record..draw.record + 1);
        }
        if let Some((lids, pipeline)) = &caps.lids {
            pass.set_pipeline(pipeline);
            for LidDraw { record, vertices, rect: PixelRect { min, max } } in lids {
                pass.set_scissor_rect(min[0], min[1], max[0] - min[0], max[1] - min[1]);
                pass.draw(0..*vertices, *record..*record + 1);
            }
        }
        drop(pass);
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("caps"), timestamp_writes: None });
        pass.set_pipeline(&caps.find);
        pass.set_bind_group(0, &self.groups.scene, &[]);
        pass.set_bind_group(1, &self.groups.plan, &[self.offset(sample, 0)]);
        pass.set_bind_group(2, &self.groups.visibility, &[]);
        // What is moved may be cut where no lens is.
        dispatch_tiles(&mut pass, self.tiles.count);
    }

    /// Composites each pixel's fragments into a target as large as the window, where the picture stands after the last
    /// sample; writes the maps where this is the sample for them.
    pub fn encode_resolve(&self, encoder: &mut wgpu::CommandEncoder, sample: &Sample, target: &wgpu::TextureView) {
        match self.resolve.as_ref().filter(|_| sample.colors) {
            None => {}
            Some(ResolvePipelines::Tiles { inside, outside }) => {
                let mut pass = begin_drawing(encoder, "resolve", target, None);
                pass.set_bind_group(0, &self.groups.scene, &[]);
                pass.set_bind_group(1, &self.groups.plan, &[self.offset(sample, 0)]);
                pass.set_bind_group(2, &self.groups.resolve, &[]);
                let Tiles { active, count, .. } = self.tiles;
                pass.set_pipeline(inside);
                pass.draw(0..4, 0..active);
                pass.set_pipeline(outside);
                pass.draw(0..4, active..count);
            }
            Some(ResolvePipelines::Sample(pipeline)) => {
                self.encode_pixels(encoder, sample, pipeline, &self.groups.resolve);
                if let Some(screen) = &self.screen {
                    screen.encode(encoder, &self.groups.plan, self.offset(sample, 0), &self.window, target);
                }
            }
        }
        if let (true, Some(pipeline), Some(group)) = (sample.maps, &self.compute.aov, &self.groups.maps) {
            self.encode_pixels(encoder, sample, pipeline, group);
        }
    }

    /// Classifies and shades the fragment that a sample has drawn at the window's one pixel.
    pub fn encode_explain(&self, encoder: &mut wgpu::CommandEncoder, sample: &Sample, pass: &ExplainPass) {
        self.encode_pixels(encoder, sample, &pass.pipeline, &pass.group);
    }

    fn encode_pixels(
        &self,
        encoder: &mut wgpu::CommandEncoder,
        sample: &Sample,
        pipeline: &wgpu::ComputePipeline,
        group: &wgpu::BindGroup,
    ) {
        let mut pass =
            encoder.begin_compute_pass(&wgpu::ComputePassDescriptor { label: Some("pixels"), timestamp_writes: None });
        pass.set_pipeline(pipeline);
        pass.set_bind_group(0, &self.groups.scene, &[]);
        pass.set_bind_group(1, &self.groups.plan, &[self.offset(sample, 0)]);
        pass.set_bind_group(2, group, &[]);
        let [width, height] = self.window.size;
        pass.dispatch_workgroups(width.div_ceil(8), height.div_ceil(8), 1);
    }
}

/// One workgroup for each of the first tiles in their order: those that lenses touch come first.
fn dispatch_tiles(pass: &mut wgpu::ComputePass, tiles: u32) {
    pass.dispatch_workgroups(tiles.min(DISPATCH_WIDTH), tiles.div_ceil(DISPATCH_WIDTH), 1);
}

/// A pass that draws into lists alone; it has the size of a depth target, and neither reads nor changes one.
fn begin_listing<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    depth: &wgpu::TextureView,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[],
        depth_stencil_attachment: Some(wgpu::RenderPassDepthStencilAttachment {
            view: depth,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}

/// A pass that starts with cleared targets.
pub fn begin_drawing<'a>(
    encoder: &'a mut wgpu::CommandEncoder,
    label: &str,
    color: &wgpu::TextureView,
    depth: Option<&wgpu::TextureView>,
) -> wgpu::RenderPass<'a> {
    encoder.begin_render_pass(&wgpu::RenderPassDescriptor {
        label: Some(label),
        color_attachments: &[Some(wgpu::RenderPassColorAttachment {
            view: color,
            depth_slice: None,
            resolve_target: None,
            ops: wgpu::Operations { load: wgpu::LoadOp::Clear(wgpu::Color::TRANSPARENT), store: wgpu::StoreOp::Store },
        })],
        // Reverse-Z: 0 is infinitely far.
        depth_stencil_attachment: depth.map(|view| wgpu::RenderPassDepthStencilAttachment {
            view,
            depth_ops: Some(wgpu::Operations { load: wgpu::LoadOp::Clear(0.0), store: wgpu::StoreOp::Discard }),
            stencil_ops: None,
        }),
        timestamp_writes: None,
        occlusion_query_set: None,
        multiview_mask: None,
    })
}
