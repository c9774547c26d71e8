//! A filter file as naga reads it: behind the contract's declarations, with every place mapped back to the file.

use std::ops::Range;

use super::{contract, words};
use crate::InputError;
use crate::spec::Source;

/// Where the file's own text begins.
const START: usize = contract::WGSL.len();

/// The contract's declarations and the user's file.
pub struct Text {
    pub user: Source,
    /// Of both.
    pub whole: String,
}

impl Text {
    pub fn new(source: &str, name: &str) -> Self {
        // Some editors put a byte order mark in front.
        let source = source.strip_prefix('\u{feff}').unwrap_or(source);
        Self { user: Source::new(name, source), whole: format!("{}{source}", contract::WGSL) }
    }

    /// The place in the user's file, if it lies there; of several lines, the first.
    pub fn place(&self, span: naga::Span) -> Option<Range<usize>> {
        let range = span.to_range().filter(|range| range.start >= START)?;
        let text = self.user.text.trim_end();
        // What is missing at the end of the file is pointed at behind its last character.
        let start = (range.start - START).min(text.len());
        let line_end = text[start..].find('\n').map_or(text.len(), |length| start + length);
        Some(start..(range.end - START).clamp(start, line_end))
    }

    /// An error at a place of the file, or about the whole of it where the place is not known; whoever asked for the
    /// file adds its own.
    pub fn error(&self, place: Option<Range<usize>>, message: impl Into<String>) -> InputError {
        match place {
            Some(place) => InputError::at(&self.user, place, message),
            None => InputError::new(format!("{}: {}", self.user.name, message.into())),
        }
    }

    /// An error where the file declares a name.
    pub fn error_at_name(&self, name: &str, message: impl Into<String>) -> InputError {
        self.error(words::declaration(&self.user.text, name).map(|(_, place)| place), message)
    }
}
