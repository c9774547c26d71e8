//! Which parts of lenses may touch which 16 by 16 pixels, and where those pixels' layers are stored.

use super::Window;
use super::cells::{Cells, is_convex};
use super::records::NONE;
use crate::lens::{LayerStart, LensSet, PixelRect, Solid};
use crate::plan::Plan;

/// Side of a tile in pixels; `TILE` of the shaders.
pub const TILE: u32 = 16;
/// Workgroups in a row of the layer pass; `DISPATCH_WIDTH` of the shaders.
pub const DISPATCH_WIDTH: u32 = 1024;

/// Words of a part of a tile; the same name in the shaders.
const PART_WORDS_OF_TILE: u32 = 3;

/// The tiles of a window as the shaders read them.
#[derive(Debug, Clone, PartialEq)]
pub struct Tiles {
    /// Four words a tile (first word of its layers, words a pixel, first part, parts), the numbers of all tiles, first
    /// of those that lenses touch; for each part of a tile three words (the part, where its cells are listed or
    /// [`NONE`], cells along each side of the tile); and for each part with cells in a tile where the faces of each of its
    /// cells start, where those of the last one end, and the faces.
    pub words: Vec<u32>,
    /// All tiles.
    pub count: u32,
    /// Tiles that lenses touch.
    pub active: u32,
    /// Words that the layers of all pixels of those tiles need.
    pub layer_words: u64,
    /// The most layers that a pixel has room for.
    pub most_layers: u32,
    /// Of each part of a lens, where its faces are listed.
    pub cells: Vec<Option<Cells>>,
    /// Words of a layer.
    stride: u32,
}

/// Every part of every lens, with the pixels of a window outside which it does not matter.
pub fn parts<'a>(plan: &'a Plan, window: &Window) -> impl Iterator<Item = (&'a Solid, PixelRect)> {
    plan.lenses.iter().flat_map(move |lens| {
        let rect = |solid: &Solid| match lens.volume.parts.len() {
            1 => lens.rect,
            // A part may reach beyond its lens, when another part cuts it.
            _ => solid.pixel_rect(&plan.view).intersection(lens.rect),
        };
        lens.volume.parts.iter().map(move |solid| (solid, window.local(&rect(solid))))
    })
}

impl Tiles {
    /// A ray crosses each of n convex parts at most twice, so a pixel has at most 2n + 1 layers, and storage for them is
    /// settled here. For each mesh there is room for so many `crossings`.
    pub fn new(plan: &Plan, window: &Window, set_words: u32, crossings: u32) -> Self {
        let columns = window.size[0].div_ceil(TILE);
        let rows = window.size[1].div_ceil(TILE);
        let mut lists: Vec<Vec<u32>> = vec![Vec::new(); (columns * rows) as usize];
        let (mut room, mut cells) = (Vec::new(), Vec::new());
        for (part, (solid, rect)) in (0u32..).zip(parts(plan, window)) {
            room.push(if is_convex(&solid.form) { 2 } else { crossings });
            cells.push(if rect.is_empty() { None } else { Cells::new(&plan.view, window, solid, &rect) });
            if rect.is_empty() {
                continue;
            }
            for y in rect.min[1] / TILE..rect.max[1].div_ceil(TILE) {
                for x in rect.min[0] / TILE..rect.max[0].div_ceil(TILE) {
                    lists[(y * columns + x) as usize].push(part);
                }
            }
        }
        Self::from_lists(&lists, columns, &room, cells, set_words)
    }

    /// The layers of each pixel of a window of the given width and height, read back from the device.
    pub fn decode(&self, layers: &[u32], size: [u32; 2], near: f64) -> Vec<Vec<LayerStart>> {
        let columns = size[0].div_ceil(TILE);
        let pixels = (0..size[1]).flat_map(|y| (0..size[0]).map(move |x| (x, y)));
        pixels
            .map(|(x, y)| {
                let tile = 4 * (y / TILE * columns + x / TILE) as usize;
                let [first, stride, _, parts] = [0, 1, 2, 3].map(|i| self.words[tile + i]);
                if parts == 0 {
                    return vec![LayerStart { depth: near, set: LensSet::EMPTY }];
                }
                let at = (first + (y % TILE * TILE + x % TILE) * stride) as usize;
                let layer = |words: &[u32]| LayerStart {
                    depth: f64::from(f32::from_bits(words[0])),
                    set: LensSet::from_words(&words[1..]),
                };
                layers[at + 1..].chunks_exact(self.stride as usize).take(layers[at] as usize).map(layer).collect()
            })
            .collect()
    }

    /// `lists`: the parts of each tile, row by row; `room`: how many boundaries each part may have on a ray.
    fn from_lists(lists: &[Vec<u32>], columns: u32, room: &[u32], cells: Vec<Option<Cells>>, set_words: u32) -> Self {
        let (active, rest): (Vec<u32>, Vec<u32>) =
            (0..lists.len() as u32).partition(|tile| !lists[*tile as usize].is_empty());
        let layer = 1 + set_words;
        let mut words = Vec::new();
        let (mut layer_words, mut most_layers) = (0u64, 1);
        let mut next_part = 5 * lists.len() as u32;
        for list in lists {
            let count = list.len() as u32;
            let boundaries: u32 = list.iter().map(|part| room[*part as usize]).sum();
            let stride = if count == 0 { 0 } else { 1 + (boundaries + 1) * layer };
            most_layers = most_layers.max(boundaries + 1);
            words.extend([layer_words as u32, stride, next_part, count]);
            layer_words += u64::from(stride) * u64::from(TILE * TILE);
            next_part += PART_WORDS_OF_TILE * count;
        }
        words.extend(active.iter().chain(&rest));
        let mut tables = Vec::new();
        for (tile, list) in (0u32..).zip(lists) {
            for part in list {
                let (table, side) = match &cells[*part as usize] {
                    Some(cells) => {
                        let at = next_part + tables.len() as u32;
                        push_cells(&mut tables, next_part, cells, [tile % columns, tile / columns]);
                        (at, cells.side)
                    }
                    None => (NONE, 0),
                };
                words.extend([*part, table, side]);
            }
        }
        words.extend(tables);
        let count = lists.len() as u32;
        Self { words, count, active: active.len() as u32, layer_words, most_layers, cells, stride: layer }
    }
}

/// Appends the cells of a part in a tile; `before`: how many words stand before the tables.
fn push_cells(tables: &mut Vec<u32>, before: u32, cells: &Cells, tile: [u32; 2]) {
    let mut end = before + tables.len() as u32 + cells.side * cells.side + 1;
    tables.push(end);
    for faces in cells.of_tile(tile) {
        end += faces.len() as u32;
        tables.push(end);
    }
    tables.extend(cells.of_tile(tile).flatten());
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn storage_grows_with_the_tiles_that_lenses_touch() {
        let none = Tiles::from_lists(&[vec![], vec![]], 1, &[], vec![], 1);
        assert_eq!((none.active, none.layer_words), (0, 0));
        let two = Tiles::from_lists(&[vec![], vec![0, 5], vec![3]], 3, &[2; 6], vec![None; 6], 2);
        assert_eq!(two.active, 2);
        let (of_two, of_one) = (1 + 5 * 3, 1 + 3 * 3);
        assert_eq!(two.layer_words, 256 * (of_two + of_one));
        assert_eq!(two.words[4..8], [0, 16, 15, 2]);
        assert_eq!(two.words[8..12], [256 * 16, 10, 21, 1]);
        assert_eq!(two.words[12..15], [1, 2, 0], "the tiles that lenses touch come first");
        assert_eq!(two.words[15..], [0, NONE, 0, 5, NONE, 0, 3, NONE, 0]);
        assert_eq!(two.most_layers, 5);
        let mesh = Tiles::from_lists(&[vec![0, 1]], 1, &[2, 8], vec![None, None], 1);
        assert_eq!((mesh.layer_words, mesh.most_layers), (256 * (1 + 11 * 2), 11));
    }
}
