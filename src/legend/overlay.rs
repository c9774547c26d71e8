//! Drawing over a finished picture.

use embedded_graphics::mono_font::MonoFont;
use embedded_graphics::mono_font::iso_8859_1::{FONT_6X10, FONT_8X13, FONT_10X20};

use crate::drawing::{Rgb, draw_text};
use crate::frame::Frame;

/// Letters of a size that suits a picture.
#[derive(Clone, Copy)]
pub struct Type {
    font: &'static MonoFont<'static>,
    /// Of a letter, in units of `zoom` pixels.
    pub letter: [i32; 2],
    pub zoom: i32,
}

impl Type {
    pub fn of([_, height]: [u32; 2]) -> Self {
        let (font, zoom) = match height {
            0..300 => (&FONT_6X10, 1),
            300..900 => (&FONT_8X13, 1),
            // Larger fonts there are none.
            _ => (&FONT_10X20, (height / 1000).max(1)),
        };
        let size = font.character_size;
        Self { font, letter: [size.width as i32, size.height as i32], zoom: zoom as i32 }
    }

    pub fn width(&self, text: &str) -> i32 {
        self.letter[0] * text.chars().count() as i32
    }
}

/// A picture in units of `zoom` pixels. What is drawn outside is left out.
pub struct Overlay<'a> {
    frame: &'a mut Frame,
    pub letters: Type,
}

impl<'a> Overlay<'a> {
    pub fn new(frame: &'a mut Frame, letters: Type) -> Self {
        Self { frame, letters }
    }

    /// A rectangle, of which `opacity` covers the picture.
    pub fn fill(&mut self, min: [i32; 2], size: [i32; 2], color: Rgb, opacity: f32) {
        let zoom = self.letters.zoom;
        let [width, height] = self.frame.size.map(|side| side as i32);
        let span = |axis: usize, side: i32| (min[axis] * zoom).max(0)..((min[axis] + size[axis]) * zoom).min(side);
        for y in span(1, height) {
            for x in span(0, width) {
                let pixel = &mut self.frame.pixels[(y * width + x) as usize];
                *pixel = over(*pixel, color, opacity);
            }
        }
    }

    /// One line of text, its upper left corner at `at`.
    pub fn text(&mut self, text: &str, at: [i32; 2], color: Rgb) {
        draw_text(self.letters.font, text, at, |at| self.fill(at, [1, 1], color, 1.0));
    }
}

/// The over operator, for straight alpha.
fn over(below: [u8; 4], color: Rgb, opacity: f32) -> [u8; 4] {
    let under = f32::from(below[3]) / 255.0 * (1.0 - opacity);
    let alpha = opacity + under;
    let mix = |c: usize| (f32::from(color[c]) * opacity + f32::from(below[c]) * under) / alpha.max(f32::MIN_POSITIVE);
    [mix(0), mix(1), mix(2), alpha * 255.0].map(|value| value.round() as u8)
}
