//! Pixels to draw on, with text.

use embedded_graphics::mono_font::iso_8859_1::FONT_8X13;

use crate::drawing::{Rgb, draw_text};
use crate::frame::Frame;

/// Pixels of a letter.
pub const LETTER: [i32; 2] = [8, 13];
/// Pixels from one line of text to the next.
pub const LINE: i32 = 18;

/// An opaque picture in the making. What is drawn outside is left out.
pub struct Canvas {
    size: [i32; 2],
    pixels: Vec<Rgb>,
}

impl Canvas {
    pub fn new(size: [i32; 2], background: Rgb) -> Self {
        Self { size, pixels: vec![background; (size[0] * size[1]) as usize] }
    }

    pub fn set(&mut self, [x, y]: [i32; 2], color: Rgb) {
        if (0..self.size[0]).contains(&x) && (0..self.size[1]).contains(&y) {
            self.pixels[(y * self.size[0] + x) as usize] = color;
        }
    }

    pub fn fill(&mut self, min: [i32; 2], size: [i32; 2], color: Rgb) {
        for y in min[1]..min[1] + size[1] {
            (min[0]..min[0] + size[0]).for_each(|x| self.set([x, y], color));
        }
    }

    /// One line of text, its top left corner at `at`.
    pub fn text(&mut self, text: &str, at: [i32; 2], color: Rgb) {
        draw_text(&FONT_8X13, text, at, |at| self.set(at, color));
    }

    /// The same around a centre, on a dark ground.
    pub fn label(&mut self, text: &str, center: [i32; 2], color: Rgb) {
        let size = [width(text), LETTER[1]];
        let min = [center[0] - size[0] / 2, center[1] - size[1] / 2];
        self.fill([min[0] - 3, min[1] - 1], [size[0] + 6, size[1] + 2], [20, 22, 26]);
        self.text(text, min, color);
    }

    pub fn into_frame(self) -> Frame {
        let pixels = self.pixels.into_iter().map(|[r, g, b]| [r, g, b, 255]).collect();
        Frame { size: self.size.map(|side| side as u32), pixels, aovs: None }
    }
}

/// Pixels that a line of text takes.
pub fn width(text: &str) -> i32 {
    LETTER[0] * text.chars().count() as i32
}
