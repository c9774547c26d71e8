//! All mip levels of all textures on the pages of one array texture.
//!
//! Shaders address texels themselves (`shaders/appearance/texture.wgsl`), so levels may lie anywhere.

use super::records::TextureInfo;
use super::{Error, alloc};
use crate::scene::TextureSet;

/// The pages, seen as stored and with sRGB decoded, and where everything is.
#[derive(Debug)]
pub struct Atlas {
    pub linear: wgpu::TextureView,
    pub srgb: wgpu::TextureView,
    pub infos: Vec<TextureInfo>,
}

const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;
const FORMAT_SRGB: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8UnormSrgb;

/// Where one level lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Place {
    x: u32,
    y: u32,
    page: u32,
}

/// Pages filled row by row, tallest first.
#[derive(Debug, Default, PartialEq, Eq)]
struct Shelves {
    places: Vec<Place>,
    pages: u32,
    /// Width and height of a page.
    size: [u32; 2],
}

impl Shelves {
    /// Packs rectangles onto pages no higher than `limit`, if each fits a page at all.
    fn pack(sizes: &[[u32; 2]], limit: u32) -> Self {
        let width = sizes.iter().map(|s| s[0]).max().unwrap_or(1);
        let area: u64 = sizes.iter().map(|s| u64::from(s[0]) * u64::from(s[1])).sum();
        // About square when everything fits one page.
        let width = width.max((area as f64).sqrt().ceil() as u32).min(limit);
        let mut order: Vec<usize> = (0..sizes.len()).collect();
        order.sort_by_key(|i| (std::cmp::Reverse(sizes[*i][1]), *i));
        let mut places = vec![Place { x: 0, y: 0, page: 0 }; sizes.len()];
        let (mut x, mut y, mut shelf, mut page, mut height) = (0, 0, 0, 0, 1);
        for i in order {
            let [w, h] = sizes[i];
            if x + w > width {
                (x, y, shelf) = (0, y + shelf, 0);
            }
            if y + h > limit {
                (x, y, shelf, page) = (0, 0, 0, page + 1);
            }
            places[i] = Place { x, y, page };
            x += w;
            shelf = shelf.max(h);
            height = height.max(y + h);
        }
        Self { places, pages: page + 1, size: [width, height] }
    }
}

impl Atlas {
    pub fn new(device: &wgpu::Device, queue: &wgpu::Queue, set: &TextureSet) -> Result<Self, Error> {
        let limits = device.limits();
        let limit = limits.max_texture_dimension_2d;
        let levels = || set.images.iter().flat_map(|image| &image.levels);
        for image in &set.images {
            let size = image.levels[0].width.max(image.levels[0].height);
            if size > limit {
                return Err(Error::TextureTooLarge { name: image.name.clone(), size, allowed: limit });
            }
        }
        let sizes: Vec<[u32; 2]> = levels().map(|level| [level.width, level.height]).collect();
        let shelves = Shelves::pack(&sizes, limit);
        if shelves.pages > limits.max_texture_array_layers {
            let allowed = limits.max_texture_array_layers;
            return Err(Error::TooManyTextures { needed: shelves.pages, page: limit, allowed });
        }
        let texture = create(device, &shelves)?;
        for (level, place) in levels().zip(&shelves.places) {
            write(queue, &texture, [level.width, level.height], place, bytemuck::cast_slice(&level.pixels));
        }
        let view = |format| {
            texture.create_view(&wgpu::TextureViewDescriptor {
                label: Some("texture pages"),
                format: Some(format),
                dimension: Some(wgpu::TextureViewDimension::D2Array),
                ..Default::default()
            })
        };
        Ok(Self { linear: view(FORMAT), srgb: view(FORMAT_SRGB), infos: infos(set, &shelves.places) })
    }
}

fn create(device: &wgpu::Device, shelves: &Shelves) -> Result<wgpu::Texture, Error> {
    let descriptor = wgpu::TextureDescriptor {
        label: Some("texture pages"),
        size: wgpu::Extent3d { width: shelves.size[0], height: shelves.size[1], depth_or_array_layers: shelves.pages },
        mip_level_count: 1,
        sample_count: 1,
        dimension: wgpu::TextureDimension::D2,
        format: FORMAT,
        usage: wgpu::TextureUsages::TEXTURE_BINDING | wgpu::TextureUsages::COPY_DST,
        view_formats: &[FORMAT_SRGB],
    };
    alloc::texture(device, "the scene's textures", &descriptor)
}

fn write(queue: &wgpu::Queue, texture: &wgpu::Texture, size: [u32; 2], place: &Place, bytes: &[u8]) {
    queue.write_texture(
        wgpu::TexelCopyTextureInfo {
            texture,
            mip_level: 0,
            origin: wgpu::Origin3d { x: place.x, y: place.y, z: place.page },
            aspect: wgpu::TextureAspect::All,
        },
        bytes,
        wgpu::TexelCopyBufferLayout { offset: 0, bytes_per_row: Some(4 * size[0]), rows_per_image: Some(size[1]) },
        wgpu::Extent3d { width: size[0], height: size[1], depth_or_array_layers: 1 },
    );
}

fn infos(set: &TextureSet, places: &[Place]) -> Vec<TextureInfo> {
    let first_level: Vec<usize> = set
        .images
        .iter()
        .scan(0, |next, image| {
            let first = *next;
            *next += image.levels.len();
            Some(first)
        })
        .collect();
    set.textures
        .iter()
        .map(|record| {
            let image = &set.images[record.image as usize];
            let mut levels = [[0; 4]; 16];
            let first = first_level[record.image as usize];
            for ((slot, level), place) in levels.iter_mut().zip(&image.levels).zip(&places[first..]) {
                *slot = [place.x, place.y, place.page, level.width | level.height << 16];
            }
            TextureInfo {
                wrap_u: record.wrap_u,
                wrap_v: record.wrap_v,
                filter_bits: record.filter,
                srgb: u32::from(image.srgb),
                level_count: image.levels.len() as u32,
                pad: [0; 3],
                levels,
            }
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn packed_rectangles_stay_on_their_page_and_apart() {
        let sizes: Vec<[u32; 2]> = (0..60).map(|i| [1 + (i * 37) % 64, 1 + (i * 53) % 64]).collect();
        let shelves = Shelves::pack(&sizes, 80);
        assert!(shelves.pages > 1);
        let boxes: Vec<_> = shelves.places.iter().zip(&sizes).collect();
        for (i, (p, s)) in boxes.iter().enumerate() {
            assert!(p.x + s[0] <= shelves.size[0] && p.y + s[1] <= shelves.size[1] && p.page < shelves.pages);
            let overlaps = |(q, t): &(&Place, &[u32; 2])| {
                q.page == p.page && p.x < q.x + t[0] && q.x < p.x + s[0] && p.y < q.y + t[1] && q.y < p.y + s[1]
            };
            assert!(!boxes[..i].iter().any(overlaps));
        }
    }
}
