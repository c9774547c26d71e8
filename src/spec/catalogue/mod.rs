//! Every filter of the format: kind, help, parameters with type, range and default; and every shape.
//! The reader of specs, `lenspeel filters`, `lenspeel shapes` and the JSON Schema all answer from here.

mod rows;
mod shapes;

use std::fmt;

pub use rows::{FILTERS, LINE_WIDTH};
pub use shapes::{SHAPES, ShapeRow, shape};

use super::NumberRange;
use crate::color_map;

/// One filter of the format.
#[derive(Debug)]
pub struct FilterRow {
    pub name: &'static str,
    pub kind: FilterKind,
    /// Moves content, so that lenses below it act at another point (SEMANTICS 5.2).
    pub moves: bool,
    pub help: &'static str,
    pub params: &'static [Param],
    /// What shows it best, from `lens-specs/filters`; `None`: the picture there that has its name.
    pub picture: Option<&'static str>,
}

/// When a filter acts (SEMANTICS 5.4).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FilterKind {
    Content,
    Surface,
    Color,
    Coverage,
    Screen,
    Custom,
}

#[derive(Debug)]
pub struct Param {
    pub name: &'static str,
    pub kind: ParamKind,
    pub default: ParamDefault,
    pub help: &'static str,
}

/// What a parameter's value may be.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParamKind {
    Number(NumberRange),
    /// Both ends included.
    Integer(i64, i64),
    /// One number, or two.
    NumberOrPair(NumberRange),
    /// Two numbers that differ.
    Interval,
    Vector,
    Color,
    Bool,
    Text,
    File,
    Choice(&'static [&'static str]),
    /// The name of a colour map.
    ColorMap,
    Patterns,
    /// What closes a cut solid.
    Cap,
    /// The line around what closes it.
    Outline,
    /// A table whose keys the filter's own file declares.
    FreeTable,
}

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ParamDefault {
    Number(f64),
    Color(&'static str),
    Text(&'static str),
    Bool(bool),
    /// Left out, it means what these words say.
    Meaning(&'static str),
    /// It must be given.
    Required,
}

/// The row of a filter.
pub fn filter(name: &str) -> Option<&'static FilterRow> {
    FILTERS.iter().find(|row| row.name == name)
}

impl FilterRow {
    pub fn param(&self, name: &str) -> Option<&'static Param> {
        self.params.iter().find(|param| param.name == name)
    }

    /// The picture that shows it best, from `lens-specs/filters`.
    pub fn picture(&self) -> String {
        self.picture.map_or_else(|| format!("{}.png", self.name), str::to_owned)
    }

    /// Whether the bare name is a whole filter.
    pub fn stands_alone(&self) -> bool {
        self.name != "show" && self.params.iter().all(|param| param.default != ParamDefault::Required)
    }
}

impl fmt::Display for FilterKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Content => "content",
            Self::Surface => "surface",
            Self::Color => "colour",
            Self::Coverage => "coverage",
            Self::Screen => "screen",
            Self::Custom => "custom",
        })
    }
}

/// Reads as a noun: "number, above 0".
impl fmt::Display for ParamKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(range) if *range == NumberRange::ANY => write!(f, "number"),
            Self::Number(range) => write!(f, "number, {range}"),
            Self::Integer(min, max) => write!(f, "whole number, from {min} to {max}"),
            Self::NumberOrPair(range) if *range == NumberRange::ANY => write!(f, "number or [x, y]"),
            Self::NumberOrPair(range) => write!(f, "number or [x, y], {range}"),
            Self::Interval => write!(f, "[first, last]"),
            Self::Vector => write!(f, "[x, y, z]"),
            Self::Color => write!(f, "colour"),
            Self::Bool => write!(f, "true or false"),
            Self::Text => write!(f, "text"),
            Self::File => write!(f, "file"),
            Self::Choice(words) => write!(f, "{}", words.join(" | ")),
            Self::ColorMap => write!(f, "{}; with -r behind it, reversed", color_map::NAMES.join(" | ")),
            Self::Patterns => write!(f, "list of patterns"),
            Self::Cap => write!(f, "colour, \"own\", \"hatch\" or \"hatch COLOUR\""),
            Self::Outline => write!(f, "{{ width, color }}"),
            Self::FreeTable => write!(f, "table"),
        }
    }
}

impl fmt::Display for ParamDefault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Number(value) => write!(f, "{value}"),
            Self::Color(text) | Self::Text(text) => write!(f, "\"{text}\""),
            Self::Bool(value) => write!(f, "{value}"),
            Self::Meaning(words) => write!(f, "{words}"),
            Self::Required => write!(f, "required"),
        }
    }
}
