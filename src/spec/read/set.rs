//! `--set KEY=VALUE`: a value put into the document before it is read, as if the file had it.

use std::ops::Range;

use toml::Spanned;
use toml::de::{DeArray, DeTable, DeValue};

use super::item::kind_of;
use super::{keys, suggest};
use crate::InputError;
use crate::spec::Source;
use crate::spec::catalogue::{self, ShapeRow};

/// One word of a dotted key.
struct Word {
    text: String,
    span: Range<usize>,
}

/// Puts what the text at `range` of the source says into the document.
pub fn apply<'a>(document: &mut DeTable<'a>, source: &'a Source, range: Range<usize>) -> Result<(), InputError> {
    let (path, value) = parts(source, range)?;
    let path = with_shape(document, source, path)?;
    Setting { source }.table(document, &path, value)
}

/// The dotted key and the value.
fn parts(source: &Source, range: Range<usize>) -> Result<(Vec<Word>, Spanned<DeValue<'_>>), InputError> {
    let text = &source.text[range.clone()];
    let Some(equals) = equals_sign(text) else {
        return Err(InputError::at(source, range, "`--set` takes KEY=VALUE")
            .help("as in --set lens.probe.center=[1,0,0] or --set 'camera.node=\"Camera\"'"));
    };
    let path = path(&text[..equals], range.start).ok_or_else(|| {
        let message = "this is no key: it must be words with dots between them, as in lens.probe.center";
        InputError::at(source, range.start..range.start + equals, message)
    })?;
    let written = text[equals + 1..].trim();
    let start = range.end - text[equals + 1..].trim_start().len();
    let value = DeValue::parse(written).map_err(|error| {
        let span = error.span().filter(|span| !span.is_empty()).map(|span| shifted(&span, start));
        InputError::at(source, span.unwrap_or(start..range.end), format!("this is no value: {}", error.message()))
            .help("values are written as in the file; text stands in quotes: --set 'camera.node=\"Camera\"'")
    })?;
    Ok((path, moved(value, start)))
}

/// The first `=` that is not in a quoted key.
fn equals_sign(text: &str) -> Option<usize> {
    let mut quote = None;
    text.char_indices().find_map(|(at, c)| {
        match (quote, c) {
            (None, '=') => return Some(at),
            (None, '"' | '\'') => quote = Some(c),
            (Some(open), c) if c == open => quote = None,
            _ => {}
        }
        None
    })
}

/// The words of a dotted key that begins at `start`.
fn path(key: &str, start: usize) -> Option<Vec<Word>> {
    let line = format!("{key}=0");
    let document = DeTable::parse(&line).ok().filter(|_| !key.contains(['\n', '\r']))?;
    let mut words = Vec::new();
    let mut table = document.get_ref();
    loop {
        let (word, value) = table.iter().next()?;
        words.push(Word { text: word.get_ref().to_string(), span: shifted(&word.span(), start) });
        match value.get_ref() {
            DeValue::Table(inner) => table = inner,
            _ => return Some(words),
        }
    }
}

/// `lens.NAME.radius` for `lens.NAME.shape.sphere.radius`: no other key of a lens has that name.
fn with_shape(document: &DeTable, source: &Source, mut path: Vec<Word>) -> Result<Vec<Word>, InputError> {
    let [first, name, key, ..] = path.as_slice() else { return Ok(path) };
    if first.text != "lens" || keys::LENS.contains(&key.text.as_str()) {
        return Ok(path);
    }
    let shape = || {
        let lenses = document.get("lens")?.get_ref().as_array()?;
        let lens = &lenses[place(lenses, &name.text)?];
        let (kind, _) = lens.get_ref().as_table()?.get("shape")?.get_ref().as_table()?.iter().next()?;
        catalogue::shape(kind.get_ref())
    };
    let Some(ShapeRow { name: kind, keys: known, .. }) = shape() else { return Ok(path) };
    if !known.contains(&key.text.as_str()) {
        let message = format!("neither lens `{}` nor its `{kind}` has a key `{}`", name.text, key.text);
        let names = known.iter().chain(keys::LENS).copied();
        return Err(InputError::at(source, key.span.clone(), message).help(suggest::help(&key.text, names)));
    }
    let span = key.span.clone();
    let word = |text: &str| Word { text: text.to_owned(), span: span.clone() };
    path.splice(2..2, ["shape", kind].map(word));
    Ok(path)
}

struct Setting<'a> {
    source: &'a Source,
}

impl<'a> Setting<'a> {
    fn table(&self, table: &mut DeTable<'a>, path: &[Word], value: Spanned<DeValue<'a>>) -> Result<(), InputError> {
        let Some((word, rest)) = path.split_first() else { return Ok(()) };
        let value = match rest {
            [] => value,
            _ => {
                if let Some(inner) = table.get_mut(word.text.as_str()) {
                    return self.value(inner, word, rest, value);
                }
                let mut inner = DeTable::new();
                self.table(&mut inner, rest, value)?;
                Spanned::new(word.span.clone(), DeValue::Table(inner))
            }
        };
        // A key that stays keeps its place; this one is where its value is.
        table.remove(word.text.as_str());
        table.insert(Spanned::new(word.span.clone(), word.text.clone().into()), value);
        Ok(())
    }

    /// Goes on into the value of `at`.
    fn value(
        &self,
        inner: &mut Spanned<DeValue<'a>>,
        at: &Word,
        path: &[Word],
        value: Spanned<DeValue<'a>>,
    ) -> Result<(), InputError> {
        let Some((word, rest)) = path.split_first() else {
            *inner = value;
            return Ok(());
        };
        // A filter without parameters is its name.
        if matches!(inner.get_ref(), DeValue::String(name) if *name == word.text) {
            let mut table = DeTable::new();
            let empty = Spanned::new(inner.span(), DeValue::Table(DeTable::new()));
            table.insert(Spanned::new(inner.span(), word.text.clone().into()), empty);
            *inner = Spanned::new(inner.span(), DeValue::Table(table));
        }
        match inner.get_mut() {
            DeValue::Table(table) => self.table(table, path, value),
            DeValue::Array(list) => {
                let place = place(list, &word.text).ok_or_else(|| self.no_entry(list, at, word))?;
                // The name of a filter is both its place in the list and the key of its table.
                let path = if is_filter(list[place].get_ref(), &word.text) { path } else { rest };
                self.value(&mut list.as_mut()[place], word, path, value)
            }
            other => {
                let message = format!("`{}` is {}, which holds no `{}`", at.text, kind_of(other), word.text);
                Err(InputError::at(self.source, word.span.clone(), message))
            }
        }
    }

    fn no_entry(&self, list: &DeArray, at: &Word, word: &Word) -> InputError {
        let names: Vec<&str> = list.iter().filter_map(|entry| name(entry.get_ref())).collect();
        let message = match names[..] {
            [] => format!("`{}` has {} entries, counted from 0, and no entry `{}`", at.text, list.len(), word.text),
            _ => format!("`{}` has no entry `{}`", at.text, word.text),
        };
        let error = InputError::at(self.source, word.span.clone(), message);
        if names.is_empty() { error } else { error.help(suggest::help(&word.text, names)) }
    }
}

/// Where a list has what a word names: a lens or a filter by name, anything by its number from 0.
fn place(list: &DeArray, word: &str) -> Option<usize> {
    let by_name = list.iter().position(|entry| name(entry.get_ref()) == Some(word));
    by_name.or_else(|| word.parse().ok().filter(|place| *place < list.len()))
}

/// What an entry of a list goes by: its `name`, or the only word of a filter.
fn name<'v>(entry: &'v DeValue) -> Option<&'v str> {
    match entry {
        DeValue::String(name) => Some(name),
        DeValue::Table(table) => match table.get("name") {
            Some(name) => name.get_ref().as_str(),
            None if table.len() == 1 => table.keys().next().map(|key| key.get_ref().as_ref()),
            None => None,
        },
        _ => None,
    }
}

/// Whether an entry goes by the only key of its table.
fn is_filter(entry: &DeValue, word: &str) -> bool {
    match entry {
        DeValue::String(name) => name == word,
        DeValue::Table(table) => table.len() == 1 && table.contains_key(word),
        _ => false,
    }
}

fn shifted(span: &Range<usize>, by: usize) -> Range<usize> {
    span.start + by..span.end + by
}

/// A value that was read from a part of the source, with its places in all of it.
fn moved(value: Spanned<DeValue>, by: usize) -> Spanned<DeValue> {
    let span = shifted(&value.span(), by);
    let value = match value.into_inner() {
        DeValue::Array(list) => DeValue::Array(list.into_iter().map(|entry| moved(entry, by)).collect()),
        DeValue::Table(table) => {
            let entries = table.into_iter().map(|(key, value)| {
                let span = shifted(&key.span(), by);
                (Spanned::new(span, key.into_inner()), moved(value, by))
            });
            DeValue::Table(entries.collect())
        }
        other => other,
    };
    Spanned::new(span, value)
}
