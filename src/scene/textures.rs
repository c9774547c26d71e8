//! All textures of a scene in one table, with their mip levels.

use rayon::prelude::*;

use super::{Image, Mips, Sampler, Wrap};

/// Images with mip levels, and how each texture samples its image.
#[derive(Debug, Clone, Default)]
pub struct TextureSet {
    pub images: Vec<MipImage>,
    pub textures: Vec<TextureRecord>,
}

/// An image and its halves, down to one pixel.
#[derive(Debug, Clone, PartialEq)]
pub struct MipImage {
    pub name: String,
    /// Red, green and blue are sRGB encoded.
    pub srgb: bool,
    /// Largest first.
    pub levels: Vec<MipLevel>,
}

#[derive(Debug, Clone, PartialEq)]
pub struct MipLevel {
    pub width: u32,
    pub height: u32,
    /// Row 0 at the top.
    pub pixels: Vec<[u8; 4]>,
}

/// How a texture samples its image; the layout of WGSL's `TextureRecord`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, Eq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct TextureRecord {
    /// Into [`TextureSet::images`].
    pub image: u32,
    /// `WRAP_...` constants of the shaders.
    pub wrap_u: u32,
    pub wrap_v: u32,
    /// `FILTER_...` bits of the shaders.
    pub filter: u32,
}

impl TextureSet {
    /// The texture for an image and sampler; the same pixels are stored once.
    pub fn add(&mut self, image: &Image, srgb: bool, sampler: Sampler) -> u32 {
        let same = |known: &MipImage| {
            let first = &known.levels[0];
            known.srgb == srgb
                && (first.width, first.height) == (image.width, image.height)
                && first.pixels == image.pixels
        };
        let index = self.images.iter().position(same).unwrap_or_else(|| {
            self.images.push(MipImage::new(image, srgb));
            self.images.len() - 1
        });
        let record = TextureRecord::new(index as u32, sampler);
        let found = self.textures.iter().position(|known| *known == record);
        found.unwrap_or_else(|| {
            self.textures.push(record);
            self.textures.len() - 1
        }) as u32
    }
}

impl TextureRecord {
    fn new(image: u32, sampler: Sampler) -> Self {
        use crate::appearance as wgsl;
        let wrap = |w| match w {
            Wrap::Repeat => wgsl::WRAP_REPEAT.0,
            Wrap::MirroredRepeat => wgsl::WRAP_MIRROR.0,
            Wrap::ClampToEdge => wgsl::WRAP_CLAMP.0,
        };
        let mut filter = 0;
        if sampler.mag_linear {
            filter |= wgsl::FILTER_MAG_LINEAR.0;
        }
        if sampler.min_linear {
            filter |= wgsl::FILTER_MIN_LINEAR.0;
        }
        filter |= match sampler.mips {
            Mips::None => 0,
            Mips::Nearest => wgsl::FILTER_MIPS.0,
            Mips::Linear => wgsl::FILTER_MIPS.0 | wgsl::FILTER_MIPS_LINEAR.0,
        };
        Self { image, wrap_u: wrap(sampler.wrap[0]), wrap_v: wrap(sampler.wrap[1]), filter }
    }
}

impl MipImage {
    fn new(image: &Image, srgb: bool) -> Self {
        let mut levels = vec![MipLevel { width: image.width, height: image.height, pixels: image.pixels.clone() }];
        while let Some(next) = levels.last().and_then(|level| level.half(srgb)) {
            levels.push(next);
        }
        Self { name: image.name.clone(), srgb, levels }
    }
}

impl MipLevel {
    /// The next smaller level, each pixel the mean of two by two, in linear light; `None` after one pixel.
    fn half(&self, srgb: bool) -> Option<Self> {
        if self.width == 1 && self.height == 1 {
            return None;
        }
        let (width, height) = ((self.width / 2).max(1), (self.height / 2).max(1));
        let decode = decode_table(srgb);
        let at = |x: u32, y: u32| self.pixels[(y.min(self.height - 1) * self.width + x.min(self.width - 1)) as usize];
        let pixels = (0..height)
            .into_par_iter()
            .flat_map_iter(|y| {
                (0..width).map(move |x| {
                    let four = [(0, 0), (1, 0), (0, 1), (1, 1)].map(|(i, j)| at(2 * x + i, 2 * y + j));
                    std::array::from_fn(|c| {
                        if c == 3 || !srgb {
                            ((four.iter().map(|p| u32::from(p[c])).sum::<u32>() + 2) / 4) as u8
                        } else {
                            let mean = four.iter().map(|p| decode[usize::from(p[c])]).sum::<f32>() * 0.25;
                            (crate::appearance::srgb_from_linear(mean) * 255.0).round() as u8
                        }
                    })
                })
            })
            .collect();
        Some(Self { width, height, pixels })
    }
}

/// Linear values of the 256 bytes.
pub fn decode_table(srgb: bool) -> &'static [f32; 256] {
    static TABLES: std::sync::OnceLock<[[f32; 256]; 2]> = std::sync::OnceLock::new();
    let tables = TABLES.get_or_init(|| {
        [
            std::array::from_fn(|i| i as f32 / 255.0),
            std::array::from_fn(|i| crate::appearance::linear_from_srgb(i as f32 / 255.0)),
        ]
    });
    &tables[usize::from(srgb)]
}
