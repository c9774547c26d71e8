//! The words of a WGSL text with their places, comments left out: what naga's IR no longer tells.

use std::ops::Range;

/// A run of letters, digits and `_`, or any other single character that is not blank.
#[derive(Debug, Clone, PartialEq)]
pub struct Word<'a> {
    pub text: &'a str,
    pub span: Range<usize>,
}

/// All words of a text, in order. A comment that does not end reaches to the end of the text.
pub fn all(text: &str) -> Vec<Word<'_>> {
    let mut words = Vec::new();
    let mut at = 0;
    while let Some(letter) = text[at..].chars().next() {
        let rest = &text[at..];
        let length = if rest.starts_with("//") {
            rest.find('\n').unwrap_or(rest.len())
        } else if rest.starts_with("/*") {
            block_comment(rest)
        } else if is_part_of_name(letter) {
            let length = rest.find(|c| !is_part_of_name(c)).unwrap_or(rest.len());
            words.push(Word { text: &rest[..length], span: at..at + length });
            length
        } else {
            let length = letter.len_utf8();
            if !letter.is_whitespace() {
                words.push(Word { text: &rest[..length], span: at..at + length });
            }
            length
        };
        at += length;
    }
    words
}

fn is_part_of_name(c: char) -> bool {
    c.is_alphanumeric() || c == '_'
}

/// Bytes of the comment that a text begins with; block comments nest.
fn block_comment(text: &str) -> usize {
    let mut depth = 0;
    let mut at = 0;
    let bytes = text.as_bytes();
    while at < bytes.len() {
        match &bytes[at..] {
            [b'/', b'*', ..] => (depth, at) = (depth + 1, at + 2),
            [b'*', b'/', ..] => (depth, at) = (depth - 1, at + 2),
            _ => at += 1,
        }
        if depth == 0 {
            return at;
        }
    }
    bytes.len()
}

/// Where a word first stands.
pub fn find(text: &str, word: &str) -> Option<Range<usize>> {
    all(text).into_iter().find(|found| found.text == word).map(|found| found.span)
}

/// Where a word first stands that begins with those letters.
pub fn find_start(text: &str, letters: &str) -> Option<Range<usize>> {
    all(text).into_iter().find(|found| found.text.starts_with(letters)).map(|found| found.span)
}

/// The keywords that declare something by the name behind them.
const DECLARE: [&str; 7] = ["fn", "struct", "const", "let", "var", "alias", "override"];

/// All names that the text declares anywhere, but for arguments and members.
pub fn declared(text: &str) -> Vec<&str> {
    all(text).windows(2).filter(|pair| DECLARE.contains(&pair[0].text)).map(|pair| pair[1].text).collect()
}

/// How a name is declared, `struct` or `fn` or another keyword, and where the name stands.
pub fn declaration<'a>(text: &'a str, name: &str) -> Option<(&'a str, Range<usize>)> {
    let words = all(text);
    let pair = words.windows(2).find(|pair| DECLARE.contains(&pair[0].text) && pair[1].text == name)?;
    Some((pair[0].text, pair[1].span.clone()))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_are_left_out_and_places_are_kept() {
        let text = "/* a /* b */ c */ fn f // fn g\n(x: f32) /* to the end";
        let words: Vec<&str> = all(text).iter().map(|word| word.text).collect();
        assert_eq!(words, ["fn", "f", "(", "x", ":", "f32", ")"]);
        assert_eq!(find(text, "x").map(|span| &text[span]), Some("x"));
        assert_eq!(find(text, "g"), None);
        assert_eq!(declared(text), ["f"]);
        assert_eq!(declaration(text, "f").map(|(keyword, _)| keyword), Some("fn"));
    }
}
