//! Reads texels; which ones and how they are weighed is the shaders' say.

use glam::{Vec2, Vec4};

use crate::appearance as wgsl;
use crate::scene::{MipImage, TextureRecord, TextureSet, decode_table};

/// The texture's colour at `uv` in linear light, for a pixel that spans `footprint` texels of level 0.
pub fn sample(set: &TextureSet, texture: u32, uv: Vec2, footprint: f32) -> Vec4 {
    let record = &set.textures[texture as usize];
    let image = &set.images[record.image as usize];
    let mips = wgsl::choose_mips(record.filter, footprint, image.levels.len() as u32);
    let first = level_sample(image, record, mips.first, uv, mips.linear != 0);
    if mips.mix == 0.0 {
        return first;
    }
    first.lerp(level_sample(image, record, mips.second, uv, mips.linear != 0), mips.mix)
}

/// Width and height of level 0.
pub fn size(set: &TextureSet, texture: u32) -> Vec2 {
    let level = &set.images[set.textures[texture as usize].image as usize].levels[0];
    Vec2::new(level.width as f32, level.height as f32)
}

fn level_sample(image: &MipImage, record: &TextureRecord, level: u32, uv: Vec2, linear: bool) -> Vec4 {
    let level = &image.levels[level as usize];
    let decode = decode_table(image.srgb);
    let (width, height) = (level.width as i32, level.height as i32);
    let texel = |x: i32, y: i32| {
        let x = wgsl::wrap_texel(x, width, record.wrap_u) as u32;
        let y = wgsl::wrap_texel(y, height, record.wrap_v) as u32;
        let [r, g, b, a] = level.pixels[(y * level.width + x) as usize].map(usize::from);
        Vec4::new(decode[r], decode[g], decode[b], a as f32 / 255.0)
    };
    let x = wgsl::wrap_coordinate(uv.x, record.wrap_u) * width as f32;
    let y = wgsl::wrap_coordinate(uv.y, record.wrap_v) * height as f32;
    if !linear {
        return texel(x.floor() as i32, y.floor() as i32);
    }
    let (x, y) = (x - 0.5, y - 0.5);
    let (x0, y0) = (x.floor(), y.floor());
    let (fx, fy) = (x - x0, y - y0);
    let (x0, y0) = (x0 as i32, y0 as i32);
    let top = texel(x0, y0).lerp(texel(x0 + 1, y0), fx);
    let bottom = texel(x0, y0 + 1).lerp(texel(x0 + 1, y0 + 1), fx);
    top.lerp(bottom, fy)
}
