//! The error of the input side: what is wrong, where, and what to do; and several of them.

use std::borrow::Cow;
use std::fmt;
use std::ops::Range;

use crate::limits::MAX_SHOWN;
use crate::printable;
use crate::spec::Source;
use crate::spec::suggest::MOST_SUGGESTED;

/// Something in a spec or a model is wrong. `Display` is a single paragraph that names the place;
/// the program prints the same with the source lines.
#[derive(Debug, Clone, thiserror::Error)]
pub struct InputError {
    /// One sentence: what is wrong, with the numbers.
    pub message: String,
    /// What was expected or what to do about it.
    pub help: Option<String>,
    /// The file the labels point into; `None` where the message names the object itself.
    pub source_text: Option<Box<Source>>,
    /// Byte ranges with a few words each; the first is the place.
    pub labels: Vec<(Range<usize>, String)>,
    /// What else is wrong, in the order of the file.
    pub others: Vec<InputError>,
}

impl InputError {
    pub fn new(message: impl Into<String>) -> Self {
        let message = printable::message(&message.into()).into_owned();
        Self { message, help: None, source_text: None, labels: Vec::new(), others: Vec::new() }
    }

    /// An error at a place of a spec file.
    pub fn at(source: &Source, span: Range<usize>, message: impl Into<String>) -> Self {
        Self { source_text: Some(Box::new(source.clone())), ..Self::new(message) }.label(span, "here")
    }

    pub fn help(mut self, help: impl Into<String>) -> Self {
        self.help = Some(printable::message(&help.into()).into_owned());
        self
    }

    /// Adds a place with a word about it; replaces the bare "here" of [`InputError::at`] when it is the same place.
    pub fn label(mut self, span: Range<usize>, text: impl Into<String>) -> Self {
        self.labels.retain(|(other, _)| *other != span);
        self.labels.push((span, text.into()));
        self
    }

    /// Ties an error without a place (a model that does not open) to the line of the spec that asked for it.
    pub fn or_at(self, source: &Source, span: Range<usize>) -> Self {
        if self.source_text.is_some() {
            return self;
        }
        Self { source_text: Some(Box::new(source.clone())), ..self }.label(span, "needed here")
    }

    /// 1-based line of the first label.
    pub fn line(&self) -> Option<usize> {
        let (span, _) = self.labels.first()?;
        Some(self.source_text.as_ref()?.line(span.start))
    }
}

impl fmt::Display for InputError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if let Some(source) = &self.source_text {
            match self.labels.first() {
                Some((span, _)) => write!(f, "{}: ", source.place(span.start))?,
                None => write!(f, "{}: ", source.name)?,
            }
        }
        write!(f, "{}", shortened(&self.message))?;
        if let Some(help) = &self.help {
            write!(f, " ({})", shortened(help))?;
        }
        match self.others.len() {
            0 => Ok(()),
            more => write!(f, " (and {more} more)"),
        }
    }
}

/// What is wrong with things that do not depend on each other.
#[derive(Debug, Default)]
pub(crate) struct Faults(Vec<InputError>);

impl Faults {
    /// More are not kept: nobody reads them.
    const MOST: usize = 1000;

    /// Keeps a fault, and those behind it; each once.
    pub fn note(&mut self, error: InputError) {
        let InputError { others, .. } = &error;
        let (others, first) = (others.clone(), InputError { others: Vec::new(), ..error });
        for error in std::iter::once(first).chain(others) {
            let is_known = |known: &InputError| (&known.message, &known.labels) == (&error.message, &error.labels);
            if self.0.len() < Self::MOST && !self.0.iter().any(is_known) {
                self.0.push(error);
            }
        }
    }

    /// Whether it is worth the time to look for what may have been meant.
    pub fn are_few(&self) -> bool {
        self.0.len() < MOST_SUGGESTED
    }

    /// The value, or `None` where its fault was noted.
    pub fn take<T>(&mut self, result: Result<T, InputError>) -> Option<T> {
        result.map_err(|error| self.note(error)).ok()
    }

    /// All of them as one, the first of the file first.
    pub fn finish(mut self) -> Result<(), InputError> {
        self.0.sort_by_key(|error| error.labels.first().map(|(span, _)| span.start));
        let mut all = self.0.into_iter();
        let Some(first) = all.next() else { return Ok(()) };
        Err(InputError { others: all.collect(), ..first })
    }
}

/// A text as messages show it: words that are much longer than any name are cut.
pub(crate) fn shortened(text: &str) -> Cow<'_, str> {
    if text.split_whitespace().all(|word| word.len() <= MAX_SHOWN) {
        return Cow::Borrowed(text);
    }
    let mut short = String::new();
    for piece in text.split_inclusive(char::is_whitespace) {
        let count = piece.trim_end().chars().count();
        if count <= MAX_SHOWN {
            short.push_str(piece);
            continue;
        }
        // What stands behind the name, such as a quote, stays.
        let tail: String = piece.chars().skip(count - 16).collect();
        short.extend(piece.chars().take(MAX_SHOWN / 2));
        short.push_str(&format!("... ({count} characters) ...{tail}"));
    }
    Cow::Owned(short)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn faults_are_one_error_in_the_order_of_the_file() {
        let source = Source::new("spec.toml", "abcdefgh");
        let at = |place: usize| InputError::at(&source, place..place + 1, format!("fault {place}"));
        let mut inner = Faults::default();
        [7, 3].into_iter().for_each(|place| inner.note(at(place)));
        let mut faults = Faults::default();
        assert_eq!(faults.take(Ok(1)), Some(1));
        assert_eq!(faults.take(Err::<(), _>(at(5))), None);
        faults.note(at(5));
        assert_eq!(faults.take(inner.finish()), None);
        let error = faults.finish().expect_err("three faults");
        let messages: Vec<&str> = error.others.iter().map(|error| error.message.as_str()).collect();
        assert_eq!((error.message.as_str(), messages), ("fault 3", vec!["fault 5", "fault 7"]));
        assert_eq!(error.to_string(), "spec.toml:1: fault 3 (and 2 more)");
        assert!(Faults::default().finish().is_ok());
    }

    #[test]
    fn only_words_longer_than_any_name_are_cut() {
        let plain = "no lens matches `cut-*`, however long the sentence is ".repeat(40);
        assert_eq!(shortened(&plain), plain);
        let long = format!("no lens matches `{}é`, so it is", "x".repeat(200_000));
        let short = shortened(&long);
        assert!(short.len() < 2 * MAX_SHOWN, "{short}");
        assert!(short.starts_with("no lens matches `xxx") && short.ends_with("xé`, so it is"), "{short}");
        assert!(short.contains("200004 characters"), "{short}");
    }
}
