//! What lies in front of the visible fragments, for accounts of a picture.

use rayon::prelude::*;

use super::{BAND, BAND_PIXELS, BLOCK, Block, Error, Renderer, Scratch, pixels_of, tiles_of};
use crate::frame::{InFront, NOTHING, RegionTable, filled};
use crate::lens::PixelRect;
use crate::plan::Region;

/// A tile's share.
type Tile = (PixelRect, InFront, Vec<Option<Region>>);

impl Renderer<'_> {
    /// What lies in front of the visible fragment at the centre of each pixel. Goes from band to band, as maps do.
    ///
    /// # Errors
    /// There is no memory for a number a pixel.
    pub fn in_front(&self) -> Result<InFront, Error> {
        let [width, height] = self.plan.view.size;
        let ranks = self.plan.lenses.len() + self.plan.rules.len();
        let mut all = InFront::of(ranks, filled(width as usize * height as usize, NOTHING)?);
        let mut table = RegionTable::default();
        let rows = (BAND_PIXELS / width).next_multiple_of(BAND);
        for first in (0..height).step_by(rows as usize) {
            let band = PixelRect { min: [0, first], max: [width, (first + rows).min(height)] };
            let tile = |scratch: &mut Scratch, rect: PixelRect| -> Tile {
                let block = Block { rect, side: 1 };
                self.tracer.trace(&block, &self.ranks(&rect), scratch);
                let (mut counts, mut nearest) = (InFront::of(ranks, Vec::new()), Vec::new());
                self.tracer.count_in_front(block.len(), scratch, &mut counts, &mut nearest);
                (rect, counts, nearest)
            };
            let tiles: Vec<Tile> = tiles_of(&band, BLOCK).into_par_iter().map_init(Scratch::noting, tile).collect();
            for (rect, counts, nearest) in tiles {
                all.add(counts);
                for ((x, y), region) in pixels_of(&rect).zip(nearest) {
                    let at = y as usize * width as usize + x as usize;
                    all.nearest[at] = region.map_or(NOTHING, |region| table.number(region));
                }
            }
        }
        all.table = table.table;
        Ok(all)
    }
}
