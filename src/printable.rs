//! Text of files that nobody here has written, made safe to print.

use std::borrow::Cow;
use std::fmt::Write;

/// Characters of a name that a message or a table shows; of more the beginning and how many there are.
const MOST_SHOWN: usize = 80;

/// A name in one line: what a terminal would obey is escaped, and of a very long one only the beginning is shown.
pub fn name(name: &str) -> Cow<'_, str> {
    let shown = escaped(name, |_| false);
    match shown.char_indices().nth(MOST_SHOWN) {
        Some((end, _)) => Cow::Owned(format!("{}... ({} characters)", &shown[..end], name.chars().count())),
        None => shown,
    }
}

/// A name in one line and whole.
pub fn whole_name(name: &str) -> Cow<'_, str> {
    escaped(name, |_| false)
}

/// A message, which may have lines.
pub fn message(text: &str) -> Cow<'_, str> {
    escaped(text, |c| c == '\n')
}

fn escaped(text: &str, allowed: impl Fn(char) -> bool) -> Cow<'_, str> {
    let unsafe_here = |c: char| is_unsafe(c) && !allowed(c);
    if !text.contains(unsafe_here) {
        return Cow::Borrowed(text);
    }
    let mut out = String::with_capacity(text.len());
    for c in text.chars() {
        if unsafe_here(c) {
            let _ = write!(out, "{}", c.escape_unicode());
        } else {
            out.push(c);
        }
    }
    Cow::Owned(out)
}

/// Control characters (C0, DEL, C1), line separators, and those that change the direction of text, so that a name can
/// neither steer a terminal nor show as another.
fn is_unsafe(c: char) -> bool {
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
    }

    #[test]
    fn long_names_are_cut_and_counted() {
        let long = "ä".repeat(65_536);
        assert_eq!(name(&long), format!("{}... (65536 characters)", "ä".repeat(80)));
        assert_eq!(whole_name(&long), long);
        assert_eq!(name(&"x".repeat(80)), "x".repeat(80));
    }
}
