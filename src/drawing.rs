//! What pictures with words and axes are drawn with: debug views and legends.

use std::convert::Infallible;

use embedded_graphics::draw_target::DrawTarget;
use embedded_graphics::geometry::{OriginDimensions, Point, Size};
use embedded_graphics::mono_font::{MonoFont, MonoTextStyle};
use embedded_graphics::pixelcolor::BinaryColor;
use embedded_graphics::text::{Baseline, Text};
use embedded_graphics::{Drawable, Pixel};

/// sRGB.
pub type Rgb = [u8; 3];

/// One line of text, its upper left corner at `at`; `set` takes the pixels of its letters.
pub fn draw_text(font: &MonoFont, text: &str, [x, y]: [i32; 2], set: impl FnMut([i32; 2])) {
    let style = MonoTextStyle::new(font, BinaryColor::On);
    let Ok(_) = Text::with_baseline(text, Point::new(x, y), style, Baseline::Top).draw(&mut Letters(set));
}

/// The least of 1, 2 and 5 times a power of ten that is not below.
pub fn round_step(step: f64) -> f64 {
    let power = 10f64.powf(step.log10().floor());
    [1.0, 2.0, 5.0].map(|digit| digit * power).into_iter().find(|round| *round >= step).unwrap_or(10.0 * power)
}

struct Letters<F>(F);

impl<F> OriginDimensions for Letters<F> {
    /// Nothing is cut off here.
    fn size(&self) -> Size {
        Size::new_equal(u32::MAX)
    }
}

impl<F: FnMut([i32; 2])> DrawTarget for Letters<F> {
    type Color = BinaryColor;
    type Error = Infallible;

    fn draw_iter<I>(&mut self, pixels: I) -> Result<(), Infallible>
    where
        I: IntoIterator<Item = Pixel<BinaryColor>>,
    {
        pixels.into_iter().filter(|Pixel(_, color)| color.is_on()).for_each(|Pixel(at, _)| (self.0)([at.x, at.y]));
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use embedded_graphics::mono_font::iso_8859_1::FONT_6X10;

    use super::*;

    #[test]
    fn steps_are_round_and_not_below() {
        assert_eq!([1.0, 1.1, 2.1, 5.1, 0.03].map(round_step), [1.0, 2.0, 5.0, 10.0, 0.05]);
    }

    #[test]
    fn letters_stand_at_their_place() {
        let mut pixels = Vec::new();
        draw_text(&FONT_6X10, "ii", [-3, 20], |at| pixels.push(at));
        assert!(pixels.len() > 10 && pixels.iter().all(|[x, y]| (-3..9).contains(x) && (20..30).contains(y)));
        assert!(pixels.iter().filter(|[x, _]| *x < 3).all(|[x, y]| pixels.contains(&[x + 6, *y])), "two alike");
    }
}
