//! The `when` of an overlap rule: `!` before `&` before `|`, parentheses, lens names and patterns.
//!
//! ```text
//! or   = and { "|" and }
//! and  = not { "&" not }
//! not  = "!" not | "(" or ")" | name
//! ```

use std::ops::Range;

use super::item::Item;
use super::lens::is_name_char;
use crate::InputError;
use crate::spec::{At, Condition, Pattern};

/// Bounds the depth of the tree, and with it the stack that parsing, evaluating and dropping it need.
const MOST_TOKENS: usize = 1000;

pub fn read(item: &Item) -> Result<At<Condition>, InputError> {
    let text = item.text().map_err(|error| error.help("write an expression such as \"shell & !probe\""))?;
    let mut parser = Parser { item, text, start: content_start(item, text), tokens: Vec::new(), next: 0 };
    parser.tokens = parser.split()?;
    let condition = parser.or()?;
    match parser.peek() {
        None => Ok(item.at(condition)),
        Some(token) => {
            Err(parser.error(token.at.clone(), format!("expected `&`, `|` or the end, not {}", token.shown())))
        }
    }
}

/// Where the string's text starts in the file; `None` where escapes make the two differ.
fn content_start(item: &Item, text: &str) -> Option<usize> {
    let raw = item.file.source.text.get(item.span.clone())?;
    Some(item.span.start + raw.find(text)?)
}

#[derive(Clone)]
struct Token<'t> {
    text: &'t str,
    /// Bytes of the condition's text.
    at: Range<usize>,
}

impl Token<'_> {
    fn is_name(&self) -> bool {
        self.text.starts_with(is_pattern_char)
    }

    fn shown(&self) -> String {
        format!("`{}`", self.text)
    }
}

struct Parser<'i, 'f> {
    item: &'i Item<'f>,
    text: &'i str,
    /// Of the text, in the file.
    start: Option<usize>,
    tokens: Vec<Token<'i>>,
    next: usize,
}

fn is_pattern_char(c: char) -> bool {
    is_name_char(c) || c == '*' || c == '?'
}

impl<'i> Parser<'i, '_> {
    fn split(&self) -> Result<Vec<Token<'i>>, InputError> {
        let mut tokens = Vec::new();
        let mut at = 0;
        while let Some(c) = self.text[at..].chars().next() {
            let rest = &self.text[at..];
            let length = match c {
                _ if c.is_whitespace() => {
                    at += c.len_utf8();
                    continue;
                }
                '!' | '&' | '|' | '(' | ')' => 1,
                _ if is_pattern_char(c) => rest.find(|c| !is_pattern_char(c)).unwrap_or(rest.len()),
                _ => return Err(self.bad_character(c, at)),
            };
            tokens.push(Token { text: &rest[..length], at: at..at + length });
            at += length;
        }
        if tokens.len() > MOST_TOKENS {
            let message =
                format!("this condition has {} names and signs; at most {MOST_TOKENS} are allowed", tokens.len());
            return Err(self.item.error(message).help("use a pattern such as cut-* for many lenses"));
        }
        Ok(tokens)
    }

    fn bad_character(&self, c: char, at: usize) -> InputError {
        self.error(at..at + c.len_utf8(), format!("{c:?} has no meaning in a condition"))
    }

    fn or(&mut self) -> Result<Condition, InputError> {
        let mut left = self.and()?;
        while self.take("|") {
            left = Condition::Or(Box::new(left), Box::new(self.and()?));
        }
        Ok(left)
    }

    fn and(&mut self) -> Result<Condition, InputError> {
        let mut left = self.not()?;
        while self.take("&") {
            left = Condition::And(Box::new(left), Box::new(self.not()?));
        }
        Ok(left)
    }

    fn not(&mut self) -> Result<Condition, InputError> {
        if self.take("!") {
            return Ok(Condition::Not(Box::new(self.not()?)));
        }
        if let Some(open) = self.peek().filter(|token| token.text == "(").cloned() {
            self.next += 1;
            let inner = self.or()?;
            return if self.take(")") { Ok(inner) } else { Err(self.unclosed(&open)) };
        }
        match self.peek().cloned() {
            Some(token) if token.is_name() => {
                self.next += 1;
                Ok(Condition::Lens(At::new(Pattern::new(token.text), self.place(token.at))))
            }
            Some(token) => Err(self.error(token.at.clone(), format!("expected a lens name, not {}", token.shown()))),
            None => Err(self.at_end("a lens name")),
        }
    }

    fn unclosed(&self, open: &Token) -> InputError {
        let error = match self.peek() {
            Some(token) => self.error(token.at.clone(), format!("expected `)`, not {}", token.shown())),
            None => self.at_end("`)`"),
        };
        error.label(self.place(open.at.clone()), "for this parenthesis")
    }

    fn at_end(&self, wanted: &str) -> InputError {
        let end = self.text.len();
        self.error(end..end, format!("expected {wanted}, but the condition ends"))
    }

    fn peek(&self) -> Option<&Token<'i>> {
        self.tokens.get(self.next)
    }

    fn take(&mut self, text: &str) -> bool {
        let found = self.peek().is_some_and(|token| token.text == text);
        self.next += usize::from(found);
        found
    }

    /// Bytes of the condition as bytes of the file.
    fn place(&self, at: Range<usize>) -> Range<usize> {
        match self.start {
            Some(start) => start + at.start..start + at.end,
            None => self.item.span.clone(),
        }
    }

    fn error(&self, at: Range<usize>, message: String) -> InputError {
        let column = self.text[..at.start].chars().count() + 1;
        InputError::at(self.item.file.source, self.place(at), format!("`when`, column {column}: {message}"))
            .help("names and patterns, joined by !, &, | and parentheses, such as \"shell & !(probe | cut-*)\"")
    }
}
