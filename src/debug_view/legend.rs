//! What the colours mean, beside the picture.

use super::canvas::{Canvas, LETTER, LINE, width};
use super::palette::{DIM_TEXT, Rgb, TEXT};
use crate::output::stack;
use crate::plan::{Plan, Region};

/// A legend with more entries says how many it leaves out.
const MOST_ENTRIES: usize = 40;
/// Longer lines are cut: `explain` has the whole.
const MOST_LETTERS: usize = 64;
const SWATCH: [i32; 2] = [22, LETTER[1]];

/// A column of colours with words.
pub struct Legend {
    title: String,
    entries: Vec<Entry>,
    notes: Vec<String>,
}

/// A colour and what it stands for.
pub struct Entry {
    pub color: Rgb,
    /// The first line is bright.
    pub lines: Vec<String>,
}

impl Legend {
    pub fn new(title: &str, notes: &[&str], entries: Vec<Entry>) -> Self {
        let title = title.to_string();
        let mut notes: Vec<String> = notes.iter().map(|note| (*note).to_string()).collect();
        let left_out = entries.len().saturating_sub(MOST_ENTRIES);
        if left_out > 0 {
            notes.push(format!("{left_out} more are not listed: see `explain`"));
        }
        let cut = |line: String| match line.char_indices().nth(MOST_LETTERS) {
            Some((at, _)) => format!("{}..", &line[..at]),
            None => line,
        };
        let entries = entries.into_iter().take(MOST_ENTRIES);
        let entries = entries.map(|e| Entry { lines: e.lines.into_iter().map(cut).collect(), ..e }).collect();
        Self { title, entries, notes }
    }

    /// Pixels.
    pub fn size(&self) -> [i32; 2] {
        let indented = |line: &String| width(line) + SWATCH[0] + 10;
        let lines = self.entries.iter().flat_map(|entry| &entry.lines).map(indented);
        let plain = std::iter::once(&self.title).chain(&self.notes).map(|line| width(line));
        let count: usize = 1 + self.notes.len() + self.entries.iter().map(|entry| entry.lines.len()).sum::<usize>();
        let gaps = 6 * (self.entries.len() as i32 + 1);
        [lines.chain(plain).max().unwrap_or(0), LINE * count as i32 + gaps]
    }

    pub fn draw(&self, canvas: &mut Canvas, [x, mut y]: [i32; 2]) {
        canvas.text(&self.title, [x, y], TEXT);
        y += LINE + 6;
        for note in &self.notes {
            canvas.text(note, [x, y], DIM_TEXT);
            y += LINE;
        }
        y += 6 * i32::from(!self.notes.is_empty());
        for entry in &self.entries {
            canvas.fill([x, y], SWATCH, entry.color);
            for (i, line) in entry.lines.iter().enumerate() {
                canvas.text(line, [x + SWATCH[0] + 10, y], if i == 0 { TEXT } else { DIM_TEXT });
                y += LINE;
            }
            y += 6;
        }
    }
}

/// The lines of a region: its number and lenses, then its stack.
pub fn region_lines(plan: &Plan, id: Option<usize>, region: &Region, share: &str) -> Vec<String> {
    let names = plan.names(region.set).join(" + ");
    let names = if names.is_empty() { "no lens".to_string() } else { names };
    let mut lines = vec![match id {
        Some(id) => format!("{id}: {names}{share}"),
        None => format!("{names}{share}"),
    }];
    let entries: Vec<String> = stack(plan, *region).iter().map(ToString::to_string).collect();
    if !entries.is_empty() {
        lines.push(format!("stack {}", entries.join(" < ")));
    }
    lines
}

/// A number of pixels in percent, as it stands behind an entry.
pub fn share_text(pixels: usize, all: usize) -> String {
    match 100.0 * pixels as f64 / all.max(1) as f64 {
        percent if pixels > 0 && percent < 0.05 => "  < 0.1 %".into(),
        percent => format!("  {percent:.1} %"),
    }
}
