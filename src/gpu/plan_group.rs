//! The plan on the device: the buffers of group 1, which live for one frame.

use super::item_data::ItemData;
use super::lens_data::LensData;
use super::records::FrameRecord;
use super::upload::check_size;
use super::{Error, alloc, bindings};
use crate::plan::Plan;

/// What goes into the buffers besides the plan itself.
pub struct PlanContents<'a> {
    pub plan: &'a Plan,
    pub frames: &'a [u8],
    pub items: &'a ItemData,
    pub lenses: &'a LensData,
    pub tiles: &'a [u32],
}

/// A plan that has been uploaded.
#[derive(Debug)]
pub struct PlanGroup {
    pub group: wgpu::BindGroup,
    /// Records of items: in the group, and read by vertices as an attribute of their instance.
    pub items: wgpu::Buffer,
}

impl PlanContents<'_> {
    /// Uploads everything; `allowed`: the most bytes of one buffer.
    pub fn upload(
        &self,
        device: &wgpu::Device,
        layout: &wgpu::BindGroupLayout,
        allowed: u64,
    ) -> Result<PlanGroup, Error> {
        let Self { plan, items, lenses, .. } = self;
        let buffer = |label, bytes| plan_buffer(device, allowed, label, bytes, wgpu::BufferUsages::STORAGE);
        let frames = plan_buffer(device, allowed, "the window's frames", self.frames, wgpu::BufferUsages::STORAGE)?;
        let as_attribute = wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::VERTEX;
        let records = plan_buffer(device, allowed, "the plan's items", &items.items, as_attribute)?;
        let storage = [
            buffer("the plan's steps of movers", bytemuck::cast_slice(&items.steps))?,
            buffer("the plan's lenses", &lenses.lenses)?,
            buffer("the plan's parts of lenses", bytemuck::cast_slice(&lenses.parts.records))?,
            buffer("the plan's planes and corners of lenses", bytemuck::cast_slice(&lenses.parts.vectors))?,
            buffer("the plan's programs and meshes of lenses", bytemuck::cast_slice(&lenses.parts.words))?,
            buffer("the plan's filters", bytemuck::cast_slice(&plan.ops))?,
            buffer("the plan's lights", bytemuck::cast_slice(&plan.lighting.lights))?,
            buffer("the window's tiles", bytemuck::cast_slice(self.tiles))?,
            buffer("the plan's parameters of filters", bytemuck::cast_slice(&plan.custom_words))?,
        ];
        let record = wgpu::BufferBinding {
            buffer: &frames,
            offset: 0,
            size: wgpu::BufferSize::new(size_of::<FrameRecord>() as u64),
        };
        let mut resources = vec![wgpu::BindingResource::Buffer(record), records.as_entire_binding()];
        resources.extend(storage.iter().map(wgpu::Buffer::as_entire_binding));
        Ok(PlanGroup { group: bindings::group(device, "plan", layout, &resources), items: records })
    }
}

/// A buffer of the plan, never smaller than any record. Its label starts with whose it is: what is the window's gets
/// smaller with the window.
fn plan_buffer(
    device: &wgpu::Device,
    allowed: u64,
    label: &str,
    bytes: &[u8],
    usage: wgpu::BufferUsages,
) -> Result<wgpu::Buffer, Error> {
    check_size(allowed, label, bytes.len() as u64)?;
    let mut padded = [0; 1024];
    let contents = if bytes.len() < padded.len() {
        padded[..bytes.len()].copy_from_slice(bytes);
        &padded
    } else {
        bytes
    };
    alloc::filled_buffer(device, label, contents, usage)
}
