//! What a spec gives for the parameters of a filter file, and how a filter gets it: one 32-bit word for each scalar,
//! in the order of the struct.

use std::ops::Range;

use super::params::{FieldKind, ParamField};
use crate::InputError;
use crate::spec::Source;
use crate::spec::read::{color, suggest};

/// A value as a spec writes it.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    Number(f64),
    Numbers(Vec<f64>),
    Text(String),
    Bool(bool),
}

/// One entry of a spec's `params`.
#[derive(Debug, Clone, PartialEq)]
pub struct Given {
    pub name: String,
    /// Bytes of the spec that hold the value.
    pub span: Range<usize>,
    pub value: Value,
}

/// The words of all fields: what is given, else the default. `span` is the place of the filter in the spec.
pub fn values(fields: &[ParamField], source: &Source, given: &[Given]) -> Result<Vec<u32>, InputError> {
    for entry in given {
        if !fields.iter().any(|field| field.name == entry.name) {
            let error =
                InputError::at(source, entry.span.clone(), format!("the filter has no parameter `{}`", entry.name));
            return Err(match fields {
                [] => error.help("its file has no `struct Params`"),
                _ => error.help(suggest::help(&entry.name, fields.iter().map(|field| field.name.as_str()))),
            });
        }
    }
    let words = fields.iter().map(|field| match given.iter().find(|entry| entry.name == field.name) {
        Some(entry) => entry.value.words(field.kind).map_err(|problem| {
            let message = format!("`{}` must be {}, {problem}", field.name, field.kind.wanted());
            let error = InputError::at(source, entry.span.clone(), message);
            if field.doc.is_empty() { error } else { error.help(format!("it is: {}", field.doc)) }
        }),
        None => Ok(field.default.clone()),
    });
    Ok(words.collect::<Result<Vec<_>, _>>()?.concat())
}

impl FieldKind {
    /// As messages say it.
    pub(super) fn wanted(self) -> &'static str {
        match self {
            Self::Float => "a number",
            Self::Int => "a whole number of 32 bits",
            Self::Uint => "a whole number from 0 to 4294967295",
            Self::Bool => "true or false",
            Self::Vec2 => "a list of 2 numbers",
            Self::Vec3 => "a list of 3 numbers or a colour",
            Self::Vec4 => "a list of 4 numbers or a colour",
        }
    }
}

impl Value {
    /// `None` for dates, tables and lists of other things than numbers.
    pub(super) fn from_toml(value: &toml::Value) -> Option<Self> {
        let number = |value: &toml::Value| match value {
            toml::Value::Integer(x) => Some(*x as f64),
            toml::Value::Float(x) => Some(*x),
            _ => None,
        };
        match value {
            toml::Value::Boolean(x) => Some(Self::Bool(*x)),
            toml::Value::String(x) => Some(Self::Text(x.clone())),
            toml::Value::Array(list) => list.iter().map(number).collect::<Option<_>>().map(Self::Numbers),
            other => number(other).map(Self::Number),
        }
    }

    /// The words of a value, or what it is instead of what is wanted. Colours become linear light.
    pub(super) fn words(&self, kind: FieldKind) -> Result<Vec<u32>, String> {
        match (self, kind) {
            (Self::Number(x), FieldKind::Float) => Ok(vec![float(*x)?]),
            (Self::Number(x), FieldKind::Int) => {
                whole(*x, f64::from(i32::MIN), f64::from(i32::MAX)).map(|x| vec![x as i32 as u32])
            }
            (Self::Number(x), FieldKind::Uint) => whole(*x, 0.0, f64::from(u32::MAX)).map(|x| vec![x as u32]),
            (Self::Bool(x), FieldKind::Bool) => Ok(vec![u32::from(*x)]),
            (Self::Numbers(list), FieldKind::Vec2 | FieldKind::Vec3 | FieldKind::Vec4) => {
                if list.len() != kind.words() {
                    return Err(format!("but has {}", list.len()));
                }
                list.iter().map(|x| float(*x)).collect()
            }
            (Self::Text(text), FieldKind::Vec3 | FieldKind::Vec4) => {
                let color = color::parse(text).ok_or_else(|| {
                    format!("not \"{text}\": write \"#rrggbb\", \"#rrggbbaa\" or a CSS name such as \"orange\"")
                })?;
                let linear = color.to_linear();
                if kind == FieldKind::Vec3 && linear[3] < 1.0 {
                    return Err(format!("and the colour \"{text}\" has an alpha, for which there is no room"));
                }
                Ok(linear[..kind.words()].iter().map(|x| x.to_bits()).collect())
            }
            _ => Err(format!("not {}", self.called())),
        }
    }

    fn called(&self) -> &'static str {
        match self {
            Self::Number(_) => "a number",
            Self::Numbers(_) => "a list",
            Self::Text(_) => "a string",
            Self::Bool(true) => "true",
            Self::Bool(false) => "false",
        }
    }
}

fn float(x: f64) -> Result<u32, String> {
    let narrow = x as f32;
    if narrow.is_finite() { Ok(narrow.to_bits()) } else { Err(format!("not {x:e}, which no f32 holds")) }
}

fn whole(x: f64, min: f64, max: f64) -> Result<f64, String> {
    if x.fract() == 0.0 && (min..=max).contains(&x) { Ok(x) } else { Err(format!("not {x}")) }
}
