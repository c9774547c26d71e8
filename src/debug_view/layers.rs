//! The number of layers of each pixel, over the picture.

use std::collections::BTreeMap;

use super::legend::{Entry, Legend, share_text};
use super::palette::{dimmed, mix, sequential};
use super::sheet::Map;
use crate::frame::{Aovs, Frame};

/// How much of a number's colour covers the picture.
const COVER: f32 = 0.62;

pub fn draw(picture: &Frame, aovs: &Aovs) -> Frame {
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
    let values = &without_specks(&aovs.layers, picture.size.map(|side| side as usize));
    let over = |at: usize, _| mix(dimmed(picture.pixels[at]), color(values[at]), COVER);
    Map { size: picture.size, values, color: &over, label: &label }.with_legend(&legend)
}

/// Single pixels between others, where a ray grazes a lens, are drawn as what lies around them.
fn without_specks(values: &[u16], [width, height]: [usize; 2]) -> Vec<u16> {
    let mut cleaned = values.to_vec();
    for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
        let (columns, rows) = (x.saturating_sub(1)..(x + 2).min(width), y.saturating_sub(1)..(y + 2).min(height));
        let around = rows.flat_map(|row| columns.clone().map(move |column| row * width + column));
        let here = y * width + x;
        let mut others: Vec<u16> = around.filter(|at| *at != here).map(|at| values[at]).collect();
        others.sort_unstable();
        let most = others.chunk_by(|a, b| a == b).max_by_key(|run| run.len());
        if let Some(run) = most.filter(|_| !others.contains(&values[here])) {
            cleaned[here] = run[0];
        }
    }
    cleaned
}

#[cfg(test)]
mod tests {
    use super::without_specks;

    #[test]
    fn single_pixels_go_and_lines_stay() {
        let mut values = vec![1; 30];
        values[7] = 3;
        (0..6).for_each(|x| values[18 + x] = 2);
        let mut cleaned = values.clone();
        cleaned[7] = 1;
        assert_eq!(without_specks(&values, [6, 5]), cleaned);
    }
}
