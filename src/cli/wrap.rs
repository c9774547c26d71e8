//! Lines that fit a terminal.

use std::fmt::{self, Write};

/// Hands text on with long lines broken at spaces; what follows a break is indented deeper than its line.
pub struct Wrapped<W> {
    out: W,
    /// Columns.
    width: usize,
    line: String,
}

impl<W: Write> Wrapped<W> {
    pub fn new(out: W, width: usize) -> Self {
        Self { out, width, line: String::new() }
    }

    fn end_line(&mut self) -> fmt::Result {
        let line = std::mem::take(&mut self.line);
        let indent = line.len() - line.trim_start().len() + 4;
        let mut rest = line.as_str();
        let width = self.width;
        let mut margin = 0;
        while margin + rest.chars().count() > width {
            let Some(at) = break_in(rest, width - margin) else { break };
            writeln!(self.out, "{:margin$}{}", "", rest[..at].trim_end())?;
            rest = rest[at..].trim_start();
            margin = indent.min(width / 2);
        }
        writeln!(self.out, "{:margin$}{rest}", "")
    }
}

impl<W: Write> Write for Wrapped<W> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        for part in text.split_inclusive('\n') {
            self.line += part.strip_suffix('\n').unwrap_or(part);
            if part.ends_with('\n') {
                self.end_line()?;
            }
        }
        Ok(())
    }
}

/// The last space behind the indent that leaves at most `room` columns before it, else the first one behind that.
fn break_in(line: &str, room: usize) -> Option<usize> {
    let start = line.len() - line.trim_start().len();
    let spaces = line.char_indices().enumerate().filter(|(_, (at, c))| *c == ' ' && *at > start);
    let mut spaces = spaces.map(|(column, (at, _))| (column, at));
    let mut last = None;
    for (column, at) in &mut spaces {
        if column > room {
            return last.or(Some(at));
        }
        last = Some(at);
    }
    last
}

#[cfg(test)]
mod tests {
    use super::*;

    const WIDTH: usize = 100;

    fn wrapped(text: &str) -> String {
        let mut out = String::new();
        Wrapped::new(&mut out, WIDTH).write_str(text).expect("a string takes all");
        out
    }

    #[test]
    fn long_lines_break_at_spaces_and_short_ones_stay() {
        assert_eq!(wrapped("  short\n\n"), "  short\n\n");
        let words = "word ".repeat(50);
        let text = wrapped(&format!("  {words}\n"));
        assert!(text.lines().all(|line| line.chars().count() <= WIDTH), "{text}");
        assert!(text.lines().skip(1).all(|line| line.starts_with("      word")), "{text}");
        assert_eq!(text.split_whitespace().count(), 50);
    }

    #[test]
    fn a_word_that_is_too_long_stays_whole() {
        let word = "x".repeat(150);
        assert_eq!(wrapped(&format!("a {word} b\n")), format!("a\n    {word}\n    b\n"));
    }
}
