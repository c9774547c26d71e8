//! What the colours mean, beside the picture.

use super::canvas::{Canvas, LETTER, LINE, width};
use super::palette::{DIM_TEXT, TEXT};
use crate::drawing::Rgb;
use crate::output::stack;
use crate::plan::{Plan, Region};

/// A legend with more entries says how many it leaves out.
const MOST_ENTRIES: usize = 40;
/// Longer lines go on in the next one.
const MOST_LETTERS: usize = 64;
/// Before what goes on.
const INDENT: &str = "    ";
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

impl Entry {
    /// Its lines as they fit, and which of them each is of.
    fn folded(&self) -> impl Iterator<Item = (usize, String)> {
        self.lines.iter().enumerate().flat_map(|(i, line)| folded(line).into_iter().map(move |part| (i, part)))
    }
}

/// A line broken at spaces, and in words where one is too long.
fn folded(line: &str) -> Vec<String> {
    let mut lines = Vec::new();
    let (mut rest, mut indent) = (line, "");
    loop {
        let room = MOST_LETTERS - indent.len();
        let Some((end, next)) = rest.char_indices().nth(room) else { break };
        let space = rest[..end + next.len_utf8()].rfind(' ').filter(|at| !rest[..*at].trim().is_empty());
        let (part, after) = rest.split_at(space.unwrap_or(end));
        lines.push(format!("{indent}{}", part.trim_end()));
        (rest, indent) = (after.trim_start(), INDENT);
    }
    lines.push(format!("{indent}{rest}"));
    lines
}

impl Legend {
    pub fn new(title: &str, notes: &[&str], entries: Vec<Entry>) -> Self {
        let title = title.to_string();
        let mut notes: Vec<String> = notes.iter().map(|note| (*note).to_string()).collect();
        let left_out = entries.len().saturating_sub(MOST_ENTRIES);
        if left_out > 0 {
            notes.push(format!("{left_out} more are not listed: see `explain`"));
        }
        let entries = entries.into_iter().take(MOST_ENTRIES).collect();
        Self { title, entries, notes }
    }

    /// Pixels.
    pub fn size(&self) -> [i32; 2] {
        let lines: Vec<i32> = self.entries.iter().flat_map(Entry::folded).map(|(_, line)| width(&line)).collect();
        let indented = lines.iter().map(|line| line + SWATCH[0] + 10);
        let plain = std::iter::once(&self.title).chain(&self.notes).map(|line| width(line));
        let count = 1 + self.notes.len() + lines.len();
        let gaps = 6 * (self.entries.len() as i32 + 1);
        [indented.chain(plain).max().unwrap_or(0), LINE * count as i32 + gaps]
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
            for (i, line) in entry.folded() {
                canvas.text(&line, [x + SWATCH[0] + 10, y], if i == 0 { TEXT } else { DIM_TEXT });
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn long_lines_go_on_below_and_nothing_is_lost() {
        assert_eq!(folded("stack a.tint < b.erase"), ["stack a.tint < b.erase"]);
        let names: Vec<String> = (0..30).map(|i| format!("lens-{i}.tint")).collect();
        let line = format!("stack {}", names.join(" < "));
        let lines = folded(&line);
        assert!(lines.len() > 3 && lines.iter().all(|line| line.chars().count() <= MOST_LETTERS), "{lines:#?}");
        assert_eq!(lines.iter().map(|line| line.trim_start()).collect::<Vec<_>>().join(" "), line);
        let word = "\u{e9}".repeat(150);
        assert_eq!(folded(&word).iter().map(|line| line.trim_start()).collect::<String>(), word);
        let legend = Legend::new("Regions", &[], vec![Entry { color: [0; 3], lines: vec![line] }]);
        assert_eq!(legend.size()[1], LINE * (1 + lines.len() as i32) + 12);
    }
}
