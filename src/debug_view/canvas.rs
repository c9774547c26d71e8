//! Pixels to draw on, with text.

use std::convert::Infallible;

use embedded_graphics::Drawable;
use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Point, Size};
use embedded_graphics::mono_font::MonoTextStyle;
use embedded_graphics::mono_font::iso_8859_1::FONT_8X13;
use embedded_graphics::pixelcolor::{Rgb888, RgbColor};
use embedded_graphics::text::{Baseline, Text};

use super::palette::Rgb;
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
    pub fn text(&mut self, text: &str, at: [i32; 2], [r, g, b]: Rgb) {
        let style = MonoTextStyle::new(&FONT_8X13, Rgb888::new(r, g, b));
        let Ok(_) = Text::with_baseline(text, Point::new(at[0], at[1]), style, Baseline::Top).draw(self);
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

impl OriginDimensions for Canvas {
    fn size(&self) -> Size {
        Size::new(self.size[0] as u32, self.size[1] as u32)
    }
}

impl DrawTarget for Canvas {
    type Color = Rgb888;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = embedded_graphics::Pixel<Rgb888>>,
    {
        for embedded_graphics::Pixel(at, color) in pixels {
            self.set([at.x, at.y], [color.r(), color.g(), color.b()]);
        }
        Ok(())
    }
}
