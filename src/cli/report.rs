//! An [`InputError`] with the lines of the file it points into.

use std::fmt;
use std::ops::Range;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, NamedSource, SourceCode};

use super::excerpt::Excerpt;
use crate::InputError;
use crate::error::shortened;

/// Of several errors so many are shown.
const MOST: usize = 20;

/// The error as a block of text, at most `width` columns wide; colours only where the terminal shows them. Others behind
/// it, each as a block of its own.
pub fn report(error: &InputError, width: usize, color: bool) -> String {
    let shown = std::iter::once(error).chain(&error.others).take(MOST);
    let mut text: String = shown.map(|error| one(error, width, color)).collect();
    if let more @ 1.. = (1 + error.others.len()).saturating_sub(MOST) {
        text += &format!("  and {more} more\n");
    }
    text
}

fn one(error: &InputError, width: usize, color: bool) -> String {
    let theme = if color { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme).with_width(width).with_links(false);
    let mut text = String::new();
    match handler.render_report(&mut text, &Report::new(error)) {
        Ok(()) => text,
        Err(fmt::Error) => error.to_string(),
    }
}

/// [`InputError`] as miette sees it.
#[derive(Debug)]
struct Report<'a> {
    error: &'a InputError,
    source: Option<NamedSource<String>>,
    labels: Vec<(Range<usize>, String)>,
}

impl<'a> Report<'a> {
    fn new(error: &'a InputError) -> Self {
        let places: Vec<Range<usize>> = error.labels.iter().map(|(place, _)| place.clone()).collect();
        let excerpt = error.source_text.as_ref().map(|source| (source, Excerpt::new(&source.text, &places)));
        let place = |place: &Range<usize>| excerpt.as_ref().map_or(place.clone(), |(_, excerpt)| excerpt.place(place));
        let labels = error.labels.iter().map(|(own, text)| (place(own), shortened(text).into_owned())).collect();
        let source = excerpt.map(|(source, excerpt)| NamedSource::new(&source.name, excerpt.text));
        Self { error, source, labels }
    }
}

impl fmt::Display for Report<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&shortened(&self.error.message))
    }
}

impl std::error::Error for Report<'_> {}

impl Diagnostic for Report<'_> {
    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.error.help.as_ref().map(|help| Box::new(shortened(help)) as Box<dyn fmt::Display>)
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let label = |(span, text): &(std::ops::Range<usize>, String)| {
            LabeledSpan::new(Some(text.clone()), span.start, span.end.saturating_sub(span.start))
        };
        Some(Box::new(self.labels.iter().map(label)))
    }
}
