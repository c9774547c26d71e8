//! Text of files that nobody here has written, made safe to print.

use std::borrow::Cow;
use std::fmt::Write;

/// Characters of a name that a message or a table shows; of more the beginning and how many there are.
const MOST_SHOWN: usize = 80;

/// A name in one line: what a terminal would obey is escaped, and of a very long one only the beginning is shown.
pub fn name(name: &str) -> Cow<'_, str> {
    let shown = whole_name(name);
    match shown.char_indices().nth(MOST_SHOWN) {
        Some((end, _)) => Cow::Owned(format!("{}... ({} characters)", &shown[..end], name.chars().count())),
        None => shown,
    }
}

/// A name in one line and whole.
pub fn whole_name(name: &str) -> Cow<'_, str> {
    replaced(name, is_unsafe, escape)
}

/// A message, which may have lines.
pub fn message(text: &str) -> Cow<'_, str> {
    replaced(text, is_unsafe_in_lines, escape)
}

/// JSON, whose strings stay what they mean.
pub fn json(text: &str) -> Cow<'_, str> {
    replaced(text, is_unsafe_in_lines, |c, out| _ = write!(out, "\\u{:04x}", u32::from(c)))
}

/// Lines of a file, in which every place stays where it is.
pub fn lines(text: &str) -> Cow<'_, str> {
    let is_unsafe = |c| is_unsafe_in_lines(c) && !matches!(c, '\t' | '\r');
    replaced(text, is_unsafe, |c, out| out.extend(std::iter::repeat_n('?', c.len_utf8())))
}

fn escape(c: char, out: &mut String) {
    out.extend(c.escape_unicode());
}

fn replaced(text: &str, is_unsafe: impl Fn(char) -> bool, replace: impl Fn(char, &mut String)) -> Cow<'_, str> {
    if !text.contains(&is_unsafe) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if is_unsafe(c) {
            replace(c, &mut out);
        } else {
            out.push(c);
        }
    }
    Cow::Owned(out)
}

fn is_unsafe_in_lines(c: char) -> bool {
    c != '\n' && is_unsafe(c)
}

/// Control characters (C0, DEL, C1), line separators, and those that change the direction of text, so that a name can
/// neither steer a terminal nor show as another.
pub fn is_unsafe(c: char) -> bool {
    c.is_control()
        || matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{2028}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_terminal_would_obey_is_escaped() {
        assert_eq!(name("Zahnrad 3 – größer"), "Zahnrad 3 – größer");
        assert_eq!(name("a\u{1b}[31mb\nc\u{9b}d\u{202e}e"), "a\\u{1b}[31mb\\u{a}c\\u{9b}d\\u{202e}e");
        assert_eq!(message("one\ntwo\u{7}"), "one\ntwo\\u{7}");
        assert_eq!(json("[\n  \"a\u{9b}b\u{202e}\"\n]"), "[\n  \"a\\u009bb\\u202e\"\n]");
        assert_eq!(lines("a\tb\r\n\u{1b}\u{202e}."), "a\tb\r\n????.");
    }

    #[test]
    fn long_names_are_cut_and_counted() {
        let long = "ä".repeat(65_536);
        assert_eq!(name(&long), format!("{}... (65536 characters)", "ä".repeat(80)));
        assert_eq!(whole_name(&long), long);
        assert_eq!(name(&"x".repeat(80)), "x".repeat(80));
    }
}
