//! A table whose keys are known: unknown ones are noted as it is opened, missing ones refused as they are asked for.

use std::ops::Range;

use toml::de::{DeTable, DeValue};

use super::item::{File, Item};
use super::suggest;
use crate::InputError;

pub struct Table<'a> {
    file: &'a File<'a>,
    /// As messages call it: "[camera]", "shape `sphere`".
    pub name: String,
    map: &'a DeTable<'a>,
    keys: &'static [&'static str],
    pub span: Range<usize>,
    /// A key that is not among those: what is missing may have been meant by it.
    unknown: Option<InputError>,
}

impl<'a> Table<'a> {
    /// Takes a table and notes keys that are not in `keys`.
    pub fn open(item: &Item<'a>, name: impl Into<String>, keys: &'static [&'static str]) -> Result<Self, InputError> {
        let DeValue::Table(map) = item.value else {
            return Err(item.wrong_type(&format!("a table with {}", suggest::listed(keys.iter().copied()))));
        };
        Ok(Self::of_map(item.file, name, map, item.span.clone(), keys))
    }

    pub fn of_map(
        file: &'a File<'a>,
        name: impl Into<String>,
        map: &'a DeTable<'a>,
        span: Range<usize>,
        keys: &'static [&'static str],
    ) -> Self {
        let mut table = Self { file, name: name.into(), map, keys, span, unknown: None };
        let unknown = entries(map).into_iter().filter(|(key, _, _)| !keys.contains(key));
        let unknown: Vec<InputError> = unknown.map(|(key, span, _)| table.unknown(key, span)).collect();
        table.unknown = unknown.first().cloned();
        unknown.into_iter().for_each(|error| file.note(error));
        table
    }

    /// The same table under a better name, once that is known.
    pub fn called(self, name: String) -> Self {
        Self { name, ..self }
    }

    fn unknown(&self, key: &str, span: Range<usize>) -> InputError {
        let message = format!("{} has no key `{key}`", self.name);
        InputError::at(self.file.source, span, message).help(suggest::help(key, self.keys.iter().copied()))
    }

    pub fn get(&self, key: &'static str) -> Option<Item<'a>> {
        debug_assert!(self.keys.contains(&key), "{key} is read from {} but not among its keys", self.name);
        let value = self.map.iter().find(|(k, _)| k.get_ref() == key)?.1;
        Some(Item::new(self.file, key, value))
    }

    pub fn need(&self, key: &'static str) -> Result<Item<'a>, InputError> {
        let missing = || self.error(format!("{} needs `{key}`", self.name));
        self.get(key).ok_or_else(|| self.unknown.clone().unwrap_or_else(missing))
    }

    /// Reads a key if it is there. What is wrong with it is noted, and the key taken as left out.
    pub fn read<T>(&self, key: &'static str, read: impl FnOnce(&Item<'a>) -> Result<T, InputError>) -> Option<T> {
        self.get(key).and_then(|item| read(&item).map_err(|error| self.file.note(error)).ok())
    }

    pub fn error(&self, message: impl Into<String>) -> InputError {
        InputError::at(self.file.source, self.span.clone(), message)
    }
}

/// The entries of a table in file order: key, place of the key, value.
pub fn entries<'a>(map: &'a DeTable<'a>) -> Vec<(&'a str, Range<usize>, &'a toml::Spanned<DeValue<'a>>)> {
    let mut entries: Vec<_> = map.iter().map(|(key, value)| (key.get_ref().as_ref(), key.span(), value)).collect();
    entries.sort_by_key(|(_, span, _)| span.start);
    entries
}

/// The only entry of a one-key table, called by its key.
pub fn only_entry<'a>(item: &Item<'a>, wanted: &str) -> Result<Item<'a>, InputError> {
    let DeValue::Table(map) = item.value else {
        return Err(item.wrong_type(wanted));
    };
    match entries(map).as_slice() {
        [(key, span, value)] => {
            let mut inner = Item::new(item.file, *key, value);
            inner.key = span.clone();
            // A table written with dotted keys has no place of its own.
            inner.span = span.start.min(inner.span.start)..inner.span.end.max(span.end);
            Ok(inner)
        }
        [] => Err(item.error(format!("{} is empty", item.called())).help(format!("it must be {wanted}"))),
        [(first, ..), (second, ..), ..] => Err(item
            .error(format!("{} has both `{first}` and `{second}`", item.called()))
            .help(format!("it must be {wanted}"))),
    }
}
