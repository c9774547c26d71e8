//! An [`InputError`] with the lines of the file it points into.

use std::fmt;
use std::ops::Range;

use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError, MietteSpanContents, SourceCode,
    SourceSpan, SpanContents,
};

use super::excerpt::Excerpt;
use crate::error::shortened;
use crate::spec::Source;
use crate::{InputError, printable};

/// Of several errors so many are shown.
const MOST: usize = 20;

/// The error as a block of text; colours only where the terminal shows them. Others behind it, each as a block of its own.
/// No line is broken to fit a width, which would fall into paths: a terminal does that without changing the text.
pub fn report(error: &InputError, color: bool) -> String {
    let shown = std::iter::once(error).chain(&error.others).take(MOST);
    let mut text: String = shown.map(|error| one(error, color)).collect();
    if let more @ 1.. = (1 + error.others.len()).saturating_sub(MOST) {
        text += &format!("  and {more} more\n");
    }
    text
}

fn one(error: &InputError, color: bool) -> String {
    let theme = if color { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme).with_wrap_lines(false).with_links(false);
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
    source: Option<Text>,
    labels: Vec<(Range<usize>, String)>,
}

impl<'a> Report<'a> {
    fn new(error: &'a InputError) -> Self {
        let places: Vec<Range<usize>> = error.labels.iter().map(|(place, _)| place.clone()).collect();
        let excerpt =
            error.source_text.as_ref().map(|source| (source, Excerpt::new(&printable::lines(&source.text), &places)));
        let place = |place: &Range<usize>| excerpt.as_ref().map_or(place.clone(), |(_, excerpt)| excerpt.place(place));
        let words = |text: &str| shortened(&printable::message(text)).into_owned();
        let labels = error.labels.iter().map(|(own, text)| (place(own), words(text))).collect();
        let source = excerpt.map(|(source, excerpt)| Text::new(source, excerpt));
        Self { error, source, labels }
    }
}

/// A source as miette sees it: each of its parts a file of its own.
#[derive(Debug)]
struct Text {
    text: String,
    /// With names.
    parts: Vec<(Range<usize>, String)>,
}

impl Text {
    fn new(source: &Source, excerpt: Excerpt) -> Self {
        let part = |part: Range<usize>| {
            (excerpt.place(&part), printable::whole_name(source.part_name(part.start)).into_owned())
        };
        Self { parts: source.parts().map(part).collect(), text: excerpt.text }
    }
}

impl SourceCode for Text {
    fn read_span<'b>(
        &'b self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'b> + 'b>, MietteError> {
        let (part, name) =
            self.parts.iter().find(|(part, _)| span.offset() <= part.end).ok_or(MietteError::OutOfBounds)?;
        let local = SourceSpan::from((span.offset().saturating_sub(part.start), span.len()));
        let read = self.text[part.clone()].read_span(&local, lines_before, lines_after)?;
        let global = SourceSpan::from((read.span().offset() + part.start, read.span().len()));
        Ok(Box::new(MietteSpanContents::new_named(
            name.clone(),
            read.data(),
            global,
            read.line(),
            read.column(),
            read.line_count(),
        )))
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
