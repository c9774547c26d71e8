//! Pictures that show how a view comes about: layers, regions, order, and depth intervals, each with a legend.
//!
//! They are drawn from a picture and its AOVs, whichever backend made them.

mod canvas;
mod label;
mod layers;
mod legend;
mod order;
mod palette;
mod regions;
mod section;
mod sheet;

pub use section::Row;

use crate::frame::{Aovs, Frame, InFront};
use crate::plan::Plan;

/// What a debug view shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum DebugView {
    /// How many layers each pixel's ray has.
    Layers,
    /// The region of each pixel's nearest surface, opaque or not.
    Regions,
    /// Who acts on each pixel's visible fragment: the topmost lens, striped with those below.
    Order,
}

/// The debug view of a picture of `plan` with these maps, as large as it needs to be.
pub fn draw(view: DebugView, plan: &Plan, picture: &Frame, aovs: &Aovs, in_front: &InFront) -> Frame {
    match view {
        DebugView::Layers => layers::draw(picture, aovs),
        DebugView::Regions => regions::draw(plan, picture, &in_front.nearest_regions(aovs)),
        DebugView::Order => order::draw(plan, picture, aovs, in_front),
    }
}

/// A section along one row of a picture: columns to the right, depth upwards, the layers in the colours of their
/// regions, and the visible surface as a line.
pub fn draw_section(plan: &Plan, picture: &Frame, aovs: &Aovs, row: &Row) -> Frame {
    section::draw(plan, picture, aovs, row)
}
