//! The legend over a picture: what its false colours and contour lines stand for.

mod axis;
mod block;
mod overlay;

use crate::frame::Frame;
use crate::plan::Plan;
use block::Block;
use overlay::{Overlay, Type};

/// The most of a picture's height that a legend takes, so that it leaves the middle free.
const MOST_HEIGHT: f64 = 0.42;

/// Draws the legend of a plan along the lower edge of its picture: as many blocks as there is room for.
pub fn draw(plan: &Plan, frame: &mut Frame) {
    let letters = Type::of(frame.size);
    let blocks = block::blocks(plan);
    let places = places(&blocks, frame.size, letters);
    let mut overlay = Overlay::new(frame, letters);
    for (block, place) in blocks.iter().zip(places) {
        if let Some(at) = place {
            block.draw(&mut overlay, at);
        }
    }
}

/// How many of a legend's blocks a picture has no room for.
pub fn left_out(plan: &Plan) -> usize {
    let blocks = block::blocks(plan);
    places(&blocks, plan.view.size, Type::of(plan.view.size)).iter().filter(|place| place.is_none()).count()
}

/// The upper left corners of the blocks: in rows from the left, the first row lowest.
fn places(blocks: &[Block], size: [u32; 2], letters: Type) -> Vec<Option<[i32; 2]>> {
    let [width, height] = size.map(|side| side as i32 / letters.zoom);
    let margin = letters.letter[1];
    let highest = height - (f64::from(height) * MOST_HEIGHT) as i32;
    let (mut x, mut bottom, mut row) = (margin, height - margin, 0);
    let place = |block: &Block| {
        let [w, h] = block.size(letters);
        if x > margin && x + w + margin > width {
            (x, bottom, row) = (margin, bottom - row - margin / 2, 0);
        }
        if x + w + margin > width || bottom - h < highest {
            return None;
        }
        let at = [x, bottom - h];
        (x, row) = (x + w + margin / 2, row.max(h));
        Some(at)
    };
    blocks.iter().map(place).collect()
}

#[cfg(test)]
mod tests;
