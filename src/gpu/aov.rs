//! Reads the maps of pixel centres that `shaders/gpu/aov.wgsl` writes.

use super::Window;
use crate::frame::{Aovs, RegionTable};
use crate::pixel::cap_maker;
use crate::plan::{LensSet, Plan, Region};

/// Words a pixel ahead of those of its set and its stack; `MAP_WORDS` of the shader.
const FIXED_WORDS: u32 = 8;

/// Bytes that the maps of a window need.
pub fn bytes(window: &Window, words: u32) -> u64 {
    4 * u64::from(FIXED_WORDS + 2 * words) * window.pixels()
}

/// Puts a window's share into the maps of a part of the picture; `drawn`: the window that the bytes are of, which holds it.
#[expect(clippy::too_many_arguments, reason = "the maps, three rectangles, and what the bytes mean")]
pub fn store(
    maps: &mut Aovs,
    table: &mut RegionTable,
    plan: &Plan,
    part: &Window,
    window: &Window,
    drawn: &Window,
    words: u32,
    bytes: &[u8],
) {
    let stride = (FIXED_WORDS + 2 * words) as usize;
    let values: Vec<u32> = bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
    for (i, pixel) in values.chunks_exact(stride).take(drawn.pixels() as usize).enumerate() {
        let (x, y) = (i as u32 % drawn.size[0], i as u32 / drawn.size[0]);
        let pixel_of_picture = [drawn.min[0] + x, drawn.min[1] + y];
        if !window.holds(pixel_of_picture) {
            continue;
        }
        let at = part.place(pixel_of_picture);
        maps.layers[at] = pixel[0] as u16;
        if pixel[1] != 0 {
            let item = &plan.items[plan.instances[pixel[2] as usize].item];
            maps.instances[at] = pixel[2];
            let is_cap = cap_maker(pixel[3]).is_some();
            maps.triangles[at] = if is_cap { pixel[3] } else { pixel[3] - item.first_triangle };
            maps.nodes[at] = item.node as u32 + 1;
            maps.depth[at] = plan.view.from_eye(f64::from(f32::from_bits(pixel[4])));
            maps.normals[at] = [pixel[5], pixel[6], pixel[7]].map(f32::from_bits);
            let (set, stack) = pixel[FIXED_WORDS as usize..].split_at(words as usize);
            let [set, stack] = [set, stack].map(LensSet::from_words);
            maps.regions[at] = table.number(Region { set, stack });
        }
    }
}
