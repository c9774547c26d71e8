//! What passes draw into, kept from frame to frame while the window stays the same.

use super::pipelines::{DEPTH_FORMAT, ID_FORMAT};
use super::upload::check_size;
use super::{Error, Window};

/// Bytes of a listed fragment.
pub const FRAGMENT_BYTES: u64 = 16;

/// Bytes of a pixel's summed colour.
const SUMMED_BYTES: u64 = 16;

/// Textures and buffers of one window.
#[derive(Debug)]
pub struct Targets {
    pub size: [u32; 2],
    pub ids: wgpu::TextureView,
    pub depth: wgpu::TextureView,
    /// The newest fragment of each pixel and, where something may be cut, the newest crossing with that.
    pub heads: wgpu::Buffer,
    /// Summed colours, where there are several samples.
    pub accumulated: wgpu::Buffer,
    pub layers: wgpu::Buffer,
    pub fragments: wgpu::Buffer,
}

impl Targets {
    /// `summed`: for how many pixels colours are summed; `heads`: of lists.
    pub fn new(
        device: &wgpu::Device,
        allowed: u64,
        window: &Window,
        summed: u64,
        layer_words: u64,
        heads: u64,
        fragments: u64,
    ) -> Result<Self, Error> {
        let limit = device.limits().max_texture_dimension_2d;
        let side = window.size[0].max(window.size[1]);
        if side > limit {
            return Err(Error::TextureTooLarge { name: "of the picture".into(), size: side, allowed: limit });
        }
        let texture = |label, format, usage| {
            let size = wgpu::Extent3d { width: window.size[0], height: window.size[1], depth_or_array_layers: 1 };
            let texture = device.create_texture(&wgpu::TextureDescriptor {
                label: Some(label),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            });
            texture.create_view(&Default::default())
        };
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        Ok(Self {
            size: window.size,
            ids: texture("visibility", ID_FORMAT, attachment | wgpu::TextureUsages::TEXTURE_BINDING),
            depth: texture("depth", DEPTH_FORMAT, attachment),
            heads: work_buffer(device, allowed, "heads of fragment lists", 4 * heads)?,
            accumulated: work_buffer(device, allowed, "summed colours", SUMMED_BYTES * summed)?,
            layers: work_buffer(device, allowed, "layers", 4 * layer_words)?,
            fragments: work_buffer(device, allowed, "fragments", FRAGMENT_BYTES * fragments)?,
        })
    }

    /// Whether a frame of this size fits.
    pub fn fits(&self, window: &Window, summed: u64, layer_words: u64, heads: u64, fragments: u64) -> bool {
        self.size == window.size
            && self.accumulated.size() >= SUMMED_BYTES * summed
            && self.heads.size() >= 4 * heads
            && self.layers.size() >= 4 * layer_words
            && self.fragments.size() >= FRAGMENT_BYTES * fragments
    }
}

/// A storage buffer that passes write and may be copied from; `allowed`: the most bytes it may have.
pub fn work_buffer(device: &wgpu::Device, allowed: u64, label: &str, bytes: u64) -> Result<wgpu::Buffer, Error> {
    check_size(allowed, &format!("the {label}"), bytes)?;
    Ok(device.create_buffer(&wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes.max(64).next_multiple_of(16),
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    }))
}
