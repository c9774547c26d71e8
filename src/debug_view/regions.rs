//! The region of each pixel's nearest surface, over the picture.

use super::legend::{Entry, Legend, region_lines, share_text};
use super::palette::{RegionColors, dimmed, mix};
use super::sheet::Map;
use crate::frame::{Aovs, Frame};
use crate::plan::{Plan, Region};

/// How much of a region's colour covers the picture.
const COVER: f32 = 0.62;

pub fn draw(plan: &Plan, picture: &Frame, aovs: &Aovs) -> Frame {
    let colors = RegionColors::new(plan, aovs, std::iter::empty());
    let over = |region: &Region, pixel: [u8; 4]| match *region {
        Region::PLAIN => dimmed(pixel),
        _ => mix(dimmed(pixel), colors.color(region), COVER),
    };
    let color =
        |at: usize, _| aovs.region(at).map_or_else(|| dimmed(picture.pixels[at]), |r| over(&r, picture.pixels[at]));
    let label = |index: u32| {
        let region = aovs.table.get(index as usize).filter(|region| **region != Region::PLAIN)?;
        Some(colors.id(region)?.to_string())
    };
    let legend = Legend::new(
        "Regions",
        &["of the nearest surfaces that are", "left, opaque or not"],
        entries(plan, aovs, &colors),
    );
    Map { size: picture.size, values: &aovs.regions, color: &color, label: &label }.with_legend(&legend)
}

/// The regions of a picture by their numbers.
fn entries(plan: &Plan, aovs: &Aovs, colors: &RegionColors) -> Vec<Entry> {
    let mut counts = vec![0usize; aovs.table.len()];
    aovs.regions.iter().for_each(|index| {
        if let Some(count) = counts.get_mut(*index as usize) {
            *count += 1;
        }
    });
    let mut seen: Vec<(Option<usize>, &Region, usize)> =
        aovs.table.iter().zip(counts).map(|(region, count)| (colors.id(region), region, count)).collect();
    seen.sort_unstable();
    let entry = |(id, region, count): (Option<usize>, &Region, usize)| Entry {
        color: colors.color(region),
        lines: region_lines(plan, id, region, &share_text(count, aovs.regions.len())),
    };
    seen.into_iter().map(entry).collect()
}
