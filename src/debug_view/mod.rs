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

/// What a debug view shows, with what it needs beside the maps of a picture.
#[derive(Debug, Clone, PartialEq)]
pub enum DebugView {
    /// How many layers each pixel's ray has.
    Layers,
    /// The region of each pixel's nearest surface, opaque or not.
    Regions(InFront),
    /// Who acts on each pixel's visible fragment: the topmost lens, striped with those below.
    Order(InFront),
    /// A section along one row of the picture: columns to the right, depth upwards, the layers in the colours of their
    /// regions, and the visible surface as a line.
    DepthIntervals(Row),
}

impl DebugView {
    /// The view of a picture of `plan` with these maps, as large as it needs to be.
    pub fn draw(&self, plan: &Plan, picture: &Frame, aovs: &Aovs) -> Frame {
        match self {
            DebugView::Layers => layers::draw(picture, aovs),
            DebugView::Regions(in_front) => regions::draw(plan, picture, &in_front.nearest_regions(aovs)),
            DebugView::Order(in_front) => order::draw(plan, picture, aovs, in_front),
            DebugView::DepthIntervals(row) => section::draw(plan, picture, aovs, row),
        }
    }
}
