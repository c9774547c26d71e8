//! What a report shows of a file whose lines are very long: the part of each around the place that is meant.

use std::ops::Range;

/// Bytes up to which a line is shown whole.
const LONGEST: usize = 400;
/// Bytes that are shown of a longer one, and how many of them stand before the place that is meant.
const SHOWN: usize = 240;
const BEFORE: usize = 80;

/// A text with its long lines cut, and where places of the whole are in it.
pub struct Excerpt {
    pub text: String,
    lines: Vec<Line>,
}

struct Line {
    /// In the whole text, less its break.
    whole: Range<usize>,
    /// What is kept of it.
    kept: Range<usize>,
    /// Where that stands in the excerpt.
    at: usize,
}

impl Excerpt {
    /// `places`: what is meant.
    pub fn new(text: &str, places: &[Range<usize>]) -> Self {
        let mut excerpt = Self { text: String::new(), lines: Vec::new() };
        let mut start = 0;
        for line in text.split_inclusive('\n') {
            let whole = start..start + line.trim_end_matches(['\r', '\n']).len();
            let kept = kept(text, whole.clone(), places);
            excerpt.text.push_str(if kept.start > whole.start { "..." } else { "" });
            excerpt.lines.push(Line { whole: whole.clone(), kept: kept.clone(), at: excerpt.text.len() });
            excerpt.text.push_str(&text[kept.clone()]);
            excerpt.text.push_str(if kept.end < whole.end { "..." } else { "" });
            start += line.len();
            excerpt.text.push_str(&text[whole.end..start]);
        }
        excerpt
    }

    /// Where a place of the whole is; what has been cut off is at the cut.
    pub fn place(&self, place: &Range<usize>) -> Range<usize> {
        let [start, end] = [place.start, place.end].map(|at| {
            let line = self.lines.partition_point(|line| line.whole.start <= at).checked_sub(1);
            line.map_or(0, |line| {
                let Line { whole, kept, at: own } = &self.lines[line];
                // The break of a line that is kept to its end stays behind it.
                let last = if kept.end < whole.end { kept.end } else { usize::MAX };
                (own + at.clamp(kept.start, last) - kept.start).min(self.text.len())
            })
        });
        start..end.max(start)
    }
}

fn kept(text: &str, line: Range<usize>, places: &[Range<usize>]) -> Range<usize> {
    if line.len() <= LONGEST {
        return line;
    }
    let meant = places.iter().find(|place| line.contains(&place.start)).map_or(line.start, |place| place.start);
    let start = char_start(text, meant.saturating_sub(BEFORE).max(line.start));
    let start = if start - line.start < BEFORE { line.start } else { start };
    start..char_start(text, (start + SHOWN).min(line.end))
}

/// The last place up to `at` where a character starts.
fn char_start(text: &str, at: usize) -> usize {
    (0..=at.min(text.len())).rev().find(|place| text.is_char_boundary(*place)).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn short_lines_stay_as_they_are() {
        let text = "a = 1\r\nb = \"é\"\n\nc";
        let excerpt = Excerpt::new(text, &[]);
        assert_eq!(excerpt.text, text);
        for start in 0..=text.len() {
            assert_eq!(excerpt.place(&(start..text.len())), start..text.len());
        }
    }

    #[test]
    fn a_long_line_is_cut_around_the_place() {
        let text = format!("first\nx = \"{}\" # {}\nlast = 1\n", "é".repeat(100_000), "y".repeat(100_000));
        let place = text.find('#').map(|at| at..at + 50_000).expect("there is one");
        let last = text.find("last").map(|at| at..at + 4).expect("there is one");
        let excerpt = Excerpt::new(&text, std::slice::from_ref(&place));
        assert!(excerpt.text.len() < 300, "{}", excerpt.text);
        let shown = excerpt.place(&place);
        assert!(excerpt.text[shown.clone()].starts_with("# yyy"), "{}", &excerpt.text[shown]);
        assert_eq!(&excerpt.text[excerpt.place(&last)], "last");
        assert!(excerpt.text.starts_with("first\n...é") && excerpt.text.ends_with("y...\nlast = 1\n"));
    }

    #[test]
    fn a_place_ends_where_the_line_is_cut() {
        let text = format!("x = \"{}\"\ny = 1\n", "é".repeat(300));
        let excerpt = Excerpt::new(&text, std::slice::from_ref(&(4..606)));
        let shown = excerpt.place(&(4..606));
        assert_eq!(&excerpt.text[shown], format!("\"{}", "é".repeat(117)), "the cut is before a character");
        assert!(excerpt.text.ends_with("é...\ny = 1\n"));
    }
}
