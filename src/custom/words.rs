//! The words of a WGSL text with their places, comments left out: what naga's IR no longer tells.

use std::collections::HashSet;
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

/// Where a word first stands that begins with those letters.
pub fn find_start(text: &str, letters: &str) -> Option<Range<usize>> {
    all(text).into_iter().find(|found| found.text.starts_with(letters)).map(|found| found.span)
}

/// Where words first stand one behind another.
pub fn find_run(text: &str, run: &[&str]) -> Option<Range<usize>> {
    let words = all(text);
    let found = words.windows(run.len()).find(|found| found.iter().map(|word| &word.text).eq(run))?;
    Some(found.first()?.span.start..found.last()?.span.end)
}

/// The keywords that declare something by the name behind them.
const DECLARE: [&str; 7] = ["fn", "struct", "const", "let", "var", "alias", "override"];

/// All names that the text declares anywhere, but for arguments and members.
pub fn declared(text: &str) -> Vec<&str> {
    all(text).windows(2).filter(|pair| DECLARE.contains(&pair[0].text)).map(|pair| pair[1].text).collect()
}

/// The names that the text declares outside of its functions.
pub fn top_level(text: &str) -> Vec<Word<'_>> {
    let words = all(text);
    let mut depth = 0_usize;
    let mut names = Vec::new();
    for pair in words.windows(2) {
        match pair[0].text {
            "{" => depth += 1,
            "}" => depth = depth.saturating_sub(1),
            keyword if depth == 0 && DECLARE.contains(&keyword) => names.push(pair[1].clone()),
            _ => {}
        }
    }
    names
}

/// The names that a text uses and does not declare: those of WGSL itself.
pub fn used(text: &str) -> HashSet<&str> {
    let words = all(text);
    let is_own = |pair: &[Word], name: &str| {
        (DECLARE.contains(&pair[0].text) && pair[1].text == name) || (pair[0].text == name && pair[1].text == ":")
    };
    words
        .windows(2)
        .filter(|pair| pair[0].text != "." && pair[1].text.starts_with(char::is_alphabetic))
        .map(|pair| pair[1].text)
        .filter(|name| !words.windows(2).any(|pair| is_own(pair, name)))
        .collect()
}

/// The innermost bracket; of several, the first.
pub fn deepest_bracket(text: &str) -> Option<Range<usize>> {
    let mut depth = 0_usize;
    let mut deepest = (0, None);
    for word in all(text) {
        match word.text {
            "(" | "[" | "{" => depth += 1,
            ")" | "]" | "}" => depth = depth.saturating_sub(1),
            _ => {}
        }
        if depth > deepest.0 {
            deepest = (depth, Some(word.span));
        }
    }
    deepest.1
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
        assert_eq!(find_start(text, "f3").map(|span| &text[span]), Some("f32"));
        assert_eq!(find_start(text, "g"), None);
        assert_eq!(find_run(text, &["(", "x"]).map(|span| &text[span]), Some("(x"));
        assert_eq!(find_run(text, &["(", ":"]), None);
        assert_eq!(declared(text), ["f"]);
        assert_eq!(
            top_level("const a = 1; fn f() { let b = 1; } struct S { c: f32 }")
                .iter()
                .map(|w| w.text)
                .collect::<Vec<_>>(),
            ["a", "f", "S"]
        );
        let used = used("fn f(x: f32) -> f32 { let y = max(x, v.z); return y; }");
        assert_eq!(used, HashSet::from(["f32", "let", "max", "v", "return"]));
        assert_eq!(deepest_bracket("f(a[1] + (b)) { (c) }"), Some(3..4));
        assert_eq!(declaration(text, "f").map(|(keyword, _)| keyword), Some("fn"));
    }
}
