//! The number of layers of each pixel.

use std::collections::BTreeMap;

use super::legend::{Entry, Legend, share_text};
use super::palette::sequential;
use super::sheet::Map;
use crate::frame::{Aovs, Frame};

pub fn draw(aovs: &Aovs, size: [u32; 2]) -> Frame {
    let mut counts: BTreeMap<u16, usize> = BTreeMap::new();
    aovs.layers.iter().for_each(|layers| *counts.entry(*layers).or_default() += 1);
    let most = f32::from(counts.keys().last().copied().unwrap_or(1).max(2) - 1);
    let color = |layers: u16| sequential(f32::from(layers.max(1) - 1) / most);
    let entry = |(layers, pixels): (&u16, &usize)| Entry {
        color: color(*layers),
        lines: vec![format!("{layers}{}", share_text(*pixels, aovs.layers.len()))],
    };
    let notes = ["1 + the lens boundaries that", "each pixel's ray crosses"];
    let legend = Legend::new("Layers", &notes, counts.iter().rev().map(entry).collect());
    let label = |layers: u16| Some(layers.to_string());
    Map { size, values: &aovs.layers, color: &|at, _| color(aovs.layers[at]), label: &label }.with_legend(&legend)
}
