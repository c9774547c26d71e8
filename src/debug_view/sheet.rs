//! A picture with labels, and its legend at the right.

use super::canvas::{Canvas, LETTER, width};
use super::label::deepest;
use super::legend::Legend;
use super::palette::{GROUND, TEXT};
use crate::drawing::Rgb;
use crate::frame::Frame;

/// Pixels around and between the parts.
pub const MARGIN: i32 = 16;
/// Smaller pictures are enlarged to at least this many pixels along the longer side.
const LEAST_SIDE: u32 = 560;

/// How many pixels of the sheet stand for one of the picture, along each axis.
pub fn zoom(size: [u32; 2]) -> i32 {
    LEAST_SIDE.div_ceil(size[0].max(size[1])).max(1) as i32
}

/// A map as it is drawn.
pub struct Map<'a, T> {
    pub size: [u32; 2],
    /// What areas are made of: lines part them, and each may have a label.
    pub values: &'a [T],
    /// The colour of a pixel of the picture at a place of the sheet.
    pub color: &'a dyn Fn(usize, [i32; 2]) -> Rgb,
    /// What to write into the areas of a value.
    pub label: &'a dyn Fn(T) -> Option<String>,
}

impl<T: PartialEq + Ord + Copy> Map<'_, T> {
    /// The map beside its legend.
    pub fn with_legend(&self, legend: &Legend) -> Frame {
        let zoom = zoom(self.size);
        let [width, height] = self.size.map(|side| side as i32 * zoom);
        let [legend_width, legend_height] = legend.size();
        let size = [width + legend_width + 3 * MARGIN, height.max(legend_height) + 2 * MARGIN];
        let mut canvas = Canvas::new(size, GROUND);
        self.draw(&mut canvas, zoom);
        self.draw_labels(&mut canvas, zoom);
        legend.draw(&mut canvas, [width + 2 * MARGIN, MARGIN]);
        canvas.into_frame()
    }

    fn draw(&self, canvas: &mut Canvas, zoom: i32) {
        let [width, height] = self.size.map(|side| side as i32 * zoom);
        let at = |x: i32, y: i32| (y / zoom) as usize * self.size[0] as usize + (x / zoom) as usize;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let here = at(x, y);
            let other = |x: i32, y: i32| x < width && y < height && self.values[at(x, y)] != self.values[here];
            let color = (self.color)(here, [x, y]);
            let border = other(x + 1, y) || other(x, y + 1);
            canvas.set([x + MARGIN, y + MARGIN], if border { color.map(|c| c / 3) } else { color });
        }
    }

    /// Labels where they fit.
    fn draw_labels(&self, canvas: &mut Canvas, zoom: i32) {
        let columns = self.size[0] as usize;
        for (value, (at, depth)) in deepest(self.values, self.size.map(|side| side as usize)) {
            let Some(text) = (self.label)(value) else { continue };
            let needed = width(&text).max(LETTER[1]) / 2 + 5;
            if depth as i32 * zoom >= needed {
                let middle = |place: usize| MARGIN + place as i32 * zoom + zoom / 2;
                canvas.label(&text, [middle(at % columns), middle(at / columns)], TEXT);
            }
        }
    }
}
