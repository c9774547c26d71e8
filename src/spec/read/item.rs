//! One value of the file with its place, and the plain kinds it can be read as.

use std::cell::RefCell;
use std::ops::Range;
use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::DeValue;

use super::suggest;
use crate::InputError;
use crate::error::Faults;
use crate::spec::{At, Pattern, Source};

/// What every reader needs to know of the file.
pub struct File<'a> {
    pub source: &'a Source,
    /// Relative paths start here.
    pub folder: &'a Path,
    /// What is wrong with values whose readers went on: see [`File::note`].
    faults: RefCell<Faults>,
}

impl<'a> File<'a> {
    pub fn new(source: &'a Source, folder: &'a Path) -> Self {
        Self { source, folder, faults: RefCell::default() }
    }

    /// Keeps a fault for later, so that others are found, too. Whoever reads on with something in the value's place must
    /// not complain of that: the file is refused in the end.
    pub fn note(&self, error: InputError) {
        self.faults.borrow_mut().note(error);
    }

    pub fn into_faults(self) -> Faults {
        self.faults.into_inner()
    }
}

/// A value, called by its key in messages.
#[derive(Clone)]
pub struct Item<'a> {
    pub file: &'a File<'a>,
    pub name: String,
    pub value: &'a DeValue<'a>,
    pub span: Range<usize>,
    /// The place of the word that says what it is; the whole value where there is none.
    pub key: Range<usize>,
    /// One of the values of a list; then `name` is the list's.
    in_list: bool,
}

impl<'a> Item<'a> {
    pub fn new(file: &'a File<'a>, name: impl Into<String>, value: &'a Spanned<DeValue<'a>>) -> Self {
        Self { file, name: name.into(), value: value.get_ref(), span: value.span(), key: value.span(), in_list: false }
    }

    /// As messages call it: "`radius`", "an entry of `radii`".
    pub fn called(&self) -> String {
        let entry = if self.in_list { "an entry of " } else { "" };
        format!("{entry}`{}`", self.name)
    }

    /// An error about the kind of thing this is rather than its value.
    pub fn error_at_key(&self, message: impl Into<String>) -> InputError {
        InputError::at(self.file.source, self.key.clone(), message)
    }

    pub fn error(&self, message: impl Into<String>) -> InputError {
        InputError::at(self.file.source, self.span.clone(), message)
    }

    /// "`radius` must be a number, not a string"
    pub fn wrong_type(&self, wanted: &str) -> InputError {
        self.error(format!("{} must be {wanted}, not {}", self.called(), kind_of(self.value)))
    }

    pub fn at<T>(&self, value: T) -> At<T> {
        At::new(value, self.span.clone())
    }

    pub fn boolean(&self) -> Result<bool, InputError> {
        match self.value {
            DeValue::Boolean(value) => Ok(*value),
            _ => Err(self.wrong_type("true or false")),
        }
    }

    /// A string that is not empty.
    pub fn text(&self) -> Result<&'a str, InputError> {
        match self.value {
            DeValue::String(text) if text.is_empty() => Err(self.error(format!("{} is empty", self.called()))),
            DeValue::String(text) => Ok(text.as_ref()),
            _ => Err(self.wrong_type("a string")),
        }
    }

    pub fn path(&self) -> Result<At<PathBuf>, InputError> {
        Ok(self.at(self.file.folder.join(self.text()?)))
    }

    pub fn pattern(&self) -> Result<At<Pattern>, InputError> {
        Ok(self.at(Pattern::new(self.text()?)))
    }

    pub fn patterns(&self) -> Result<Vec<At<Pattern>>, InputError> {
        self.each("a list of names or patterns, such as [\"Bolt*\"]", Item::pattern)
    }

    /// One of a few words.
    pub fn choice<T: Copy>(&self, choices: &[(&str, T)]) -> Result<T, InputError> {
        let words = choices.iter().map(|(word, _)| *word);
        let DeValue::String(text) = self.value else {
            return Err(self.wrong_type(&format!("one of {}", quoted(words))));
        };
        match choices.iter().find(|(word, _)| word == text) {
            Some((_, value)) => Ok(*value),
            None => {
                let message = format!("{} must be one of {}, not \"{text}\"", self.called(), quoted(words.clone()));
                let near = suggest::nearest(text, words);
                Err(with_near(self.error(message), near))
            }
        }
    }

    /// What a reader makes of each element; faults are noted, and those elements left out.
    pub fn each<T>(
        &self,
        wanted: &str,
        read: impl Fn(&Item<'a>) -> Result<T, InputError>,
    ) -> Result<Vec<T>, InputError> {
        let read = |item: Item<'a>| read(&item).map_err(|error| self.file.note(error)).ok();
        Ok(self.list(wanted)?.into_iter().filter_map(read).collect())
    }

    /// The elements, each called after its list.
    pub fn list(&self, wanted: &str) -> Result<Vec<Item<'a>>, InputError> {
        match self.value {
            DeValue::Array(array) => {
                Ok(array.iter().map(|v| Item { in_list: true, ..Item::new(self.file, self.name.clone(), v) }).collect())
            }
            _ => Err(self.wrong_type(wanted)),
        }
    }
}

fn with_near(error: InputError, near: Option<&str>) -> InputError {
    match near {
        Some(word) => error.help(format!("did you mean \"{word}\"?")),
        None => error,
    }
}

/// "\"a\", \"b\""
fn quoted<'a>(words: impl Iterator<Item = &'a str>) -> String {
    words.map(|word| format!("\"{word}\"")).collect::<Vec<_>>().join(", ")
}

/// What a value is, in words.
pub fn kind_of(value: &DeValue) -> &'static str {
    match value {
        DeValue::String(_) => "a string",
        DeValue::Integer(_) => "a whole number",
        DeValue::Float(_) => "a decimal number",
        DeValue::Boolean(true) => "true",
        DeValue::Boolean(false) => "false",
        DeValue::Datetime(_) => "a date",
        DeValue::Array(_) => "a list",
        DeValue::Table(_) => "a table",
    }
}
