//! What passes draw into, kept from frame to frame while the window stays the same.

use super::pipelines::{DEPTH_FORMAT, ID_FORMAT};
use super::upload::check_size;
use super::{Error, Window, alloc};

/// Bytes of a listed fragment.
pub const FRAGMENT_BYTES: u64 = 16;

/// Bytes of a pixel's summed colour.
const SUMMED_BYTES: u64 = 16;

/// What a frame needs of its targets, beside its window.
#[derive(Debug, Clone, Copy)]
pub struct TargetSizes {
    /// For how many pixels colours are summed.
    pub summed: u64,
    pub layer_words: u64,
    /// Of lists.
    pub heads: u64,
    pub fragments: u64,
    /// Words of a set of lenses, where there are filters of the screen.
    pub screen: Option<u32>,
}

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
    pub screen: Option<ScreenTargets>,
}

/// What filters of the screen work on.
#[derive(Debug)]
pub struct ScreenTargets {
    /// One sample of each pixel.
    pub samples: wgpu::Buffer,
    /// Sums along rows.
    pub rows: wgpu::Buffer,
    /// A number for each pixel.
    pub marks: wgpu::Buffer,
}

impl Targets {
    /// `allowed`: the most bytes that a buffer may have.
    pub fn new(device: &wgpu::Device, allowed: u64, window: &Window, sizes: &TargetSizes) -> Result<Self, Error> {
        let TargetSizes { summed, layer_words, heads, fragments, screen } = *sizes;
        let limit = device.limits().max_texture_dimension_2d;
        let side = window.size[0].max(window.size[1]);
        if side > limit {
            return Err(Error::TextureTooLarge { name: "of the picture".into(), size: side, allowed: limit });
        }
        let texture = |label: &str, format, usage| -> Result<wgpu::TextureView, Error> {
            let size = wgpu::Extent3d { width: window.size[0], height: window.size[1], depth_or_array_layers: 1 };
            let descriptor = wgpu::TextureDescriptor {
                label: Some(label),
                size,
                mip_level_count: 1,
                sample_count: 1,
                dimension: wgpu::TextureDimension::D2,
                format,
                usage,
                view_formats: &[],
            };
            let texture = alloc::texture(device, &format!("the {label} of the picture"), &descriptor)?;
            Ok(texture.create_view(&Default::default()))
        };
        let attachment = wgpu::TextureUsages::RENDER_ATTACHMENT;
        Ok(Self {
            size: window.size,
            ids: texture("visibility", ID_FORMAT, attachment | wgpu::TextureUsages::TEXTURE_BINDING)?,
            depth: texture("depth", DEPTH_FORMAT, attachment)?,
            heads: work_buffer(device, allowed, "heads of fragment lists", 4 * heads)?,
            accumulated: work_buffer(device, allowed, "summed colours", SUMMED_BYTES * summed)?,
            layers: work_buffer(device, allowed, "layers", 4 * layer_words)?,
            fragments: work_buffer(device, allowed, "fragments", FRAGMENT_BYTES * fragments)?,
            screen: screen.map(|words| ScreenTargets::new(device, allowed, window, words)).transpose()?,
        })
    }

    /// Whether a frame of this size fits.
    pub fn fits(&self, window: &Window, sizes: &TargetSizes) -> bool {
        let holds_samples =
            |words| self.screen.as_ref().is_some_and(|s| s.samples.size() >= sample_bytes(words) * window.pixels());
        self.size == window.size
            && self.accumulated.size() >= SUMMED_BYTES * sizes.summed
            && self.heads.size() >= 4 * sizes.heads
            && self.layers.size() >= 4 * sizes.layer_words
            && self.fragments.size() >= FRAGMENT_BYTES * sizes.fragments
            && sizes.screen.is_none_or(holds_samples)
    }
}

impl ScreenTargets {
    fn new(device: &wgpu::Device, allowed: u64, window: &Window, words: u32) -> Result<Self, Error> {
        let pixels = window.pixels();
        let buffer = |label, bytes| work_buffer(device, allowed, label, bytes * pixels);
        Ok(Self {
            samples: buffer("samples of the screen", sample_bytes(words))?,
            rows: buffer("sums of the screen's rows", 16)?,
            marks: buffer("marks of the screen", 4)?,
        })
    }

    /// Of all buffers.
    pub fn bytes(&self) -> u64 {
        [&self.samples, &self.rows, &self.marks].map(wgpu::Buffer::size).iter().sum()
    }
}

/// Bytes of a `ScreenSample` of the shaders, with sets of so many words.
pub fn sample_bytes(words: u32) -> u64 {
    (40 + 2 * 4 * u64::from(words)).next_multiple_of(16)
}

/// A storage buffer that passes write and may be copied from; `allowed`: the most bytes it may have.
pub fn work_buffer(device: &wgpu::Device, allowed: u64, label: &str, bytes: u64) -> Result<wgpu::Buffer, Error> {
    let what = format!("the {label}");
    check_size(allowed, &what, bytes)?;
    let descriptor = wgpu::BufferDescriptor {
        label: Some(label),
        size: bytes.max(64).next_multiple_of(16),
        usage: wgpu::BufferUsages::STORAGE | wgpu::BufferUsages::COPY_DST | wgpu::BufferUsages::COPY_SRC,
        mapped_at_creation: false,
    };
    alloc::buffer(device, &what, &descriptor)
}
