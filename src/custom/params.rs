//! `struct Params` of a filter file: the names, types, defaults and help of what a spec sets.

use std::ops::Range;

use naga::{Handle, Module, Scalar, ScalarKind, Type, TypeInner};

use super::source::Text;
use super::value::Value;
use super::words;
use crate::InputError;

/// One member of `struct Params`.
#[derive(Debug, Clone, PartialEq)]
pub struct ParamField {
    pub name: String,
    pub kind: FieldKind,
    /// What it is where a spec says nothing, as `kind` lays it out; zero unless its comment says otherwise.
    pub default: Vec<u32>,
    /// What its comment says of it, in one line.
    pub doc: String,
}

/// The types that a parameter may have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum FieldKind {
    Float,
    Int,
    Uint,
    /// 0 or 1.
    Bool,
    Vec2,
    Vec3,
    Vec4,
}

impl FieldKind {
    /// 32-bit words, one for each scalar.
    pub fn words(self) -> usize {
        match self {
            Self::Float | Self::Int | Self::Uint | Self::Bool => 1,
            Self::Vec2 => 2,
            Self::Vec3 => 3,
            Self::Vec4 => 4,
        }
    }

    fn of(inner: &TypeInner) -> Option<Self> {
        match *inner {
            TypeInner::Scalar(Scalar::F32) => Some(Self::Float),
            TypeInner::Scalar(Scalar::I32) => Some(Self::Int),
            TypeInner::Scalar(Scalar::U32) => Some(Self::Uint),
            TypeInner::Scalar(Scalar { kind: ScalarKind::Bool, .. }) => Some(Self::Bool),
            TypeInner::Vector { size, scalar: Scalar::F32 } => Some(match size {
                naga::VectorSize::Bi => Self::Vec2,
                naga::VectorSize::Tri => Self::Vec3,
                naga::VectorSize::Quad => Self::Vec4,
            }),
            _ => None,
        }
    }
}

/// The members of a struct, in order.
pub fn read(text: &Text, module: &Module, ty: Handle<Type>) -> Result<Vec<ParamField>, InputError> {
    let TypeInner::Struct { members, .. } = &module.types[ty].inner else { return Ok(Vec::new()) };
    let comments = comments(&text.user.text);
    members
        .iter()
        .map(|member| {
            let name = member.name.clone().unwrap_or_default();
            let written = comments.iter().find(|comment| comment.name == name);
            let place = written.map(|comment| comment.place.clone());
            let kind = FieldKind::of(&module.types[member.ty].inner).ok_or_else(|| {
                text.error(place.clone(), format!("`{name}` of `Params` has a type that a spec cannot give"))
                    .help("parameters are f32, i32, u32, bool, vec2f, vec3f or vec4f")
            })?;
            let comment = written.map(|comment| comment.text.clone()).unwrap_or_default();
            let (default, doc) = split(&comment);
            let default = match default {
                Some(written) => self::default(text, &name, kind, written, place)?,
                None => vec![0; kind.words()],
            };
            Ok(ParamField { name, kind, default, doc: doc.to_owned() })
        })
        .collect()
}

/// The default that a comment names, `= 0.5: how strong`, and the rest of it. A rule (`====`) names none.
fn split(comment: &str) -> (Option<&str>, &str) {
    match comment.strip_prefix('=').filter(|rest| !rest.starts_with('=')) {
        Some(rest) => {
            let (default, doc) = rest.split_once(':').unwrap_or((rest, ""));
            (Some(default.trim()), doc.trim())
        }
        None => (None, comment),
    }
}

fn default(
    text: &Text,
    name: &str,
    kind: FieldKind,
    written: &str,
    place: Option<Range<usize>>,
) -> Result<Vec<u32>, InputError> {
    let value = written.parse::<toml::Value>().ok().and_then(|value| Value::from_toml(&value));
    let words = value.ok_or_else(|| format!("not `{written}`")).and_then(|value| value.words(kind));
    words.map_err(|problem| {
        text.error(place, format!("the default of `{name}` must be {}, {problem}", kind.wanted()))
            .help("write it as a spec would, and the help behind a colon: // = 0.5: how strong")
    })
}

/// What stands beside a member: behind it on its line, or else in the comment lines right above it.
struct Comment<'a> {
    name: &'a str,
    place: Range<usize>,
    text: String,
}

/// The members of `struct Params` with their comments.
fn comments(text: &str) -> Vec<Comment<'_>> {
    let names = members(text);
    names
        .iter()
        .enumerate()
        .map(|(i, member)| {
            let line_end = text[member.span.end..].find('\n').map_or(text.len(), |n| member.span.end + n);
            let is_last_of_line = names.get(i + 1).is_none_or(|next| next.span.start > line_end);
            let behind = text[member.span.end..line_end].split_once("//").map_or("", |(_, comment)| bare(comment));
            let behind = if is_last_of_line { behind } else { "" };
            let above = above(&text[..member.span.start]);
            let text = match split(behind) {
                (Some(default), "") => format!("= {default}: {}", split(&above).1),
                _ if behind.is_empty() => above,
                _ => behind.to_owned(),
            };
            Comment { name: member.text, place: member.span.clone(), text }
        })
        .collect()
}

/// The names of the members: within the braces of `struct Params`, the words before a colon.
fn members(text: &str) -> Vec<words::Word<'_>> {
    let words = words::all(text);
    let start = words.windows(2).position(|pair| pair[0].text == "struct" && pair[1].text == super::signature::PARAMS);
    let inside = words.iter().skip(start.map_or(words.len(), |start| start + 2)).take_while(|word| word.text != "}");
    let inside: Vec<_> = inside.collect();
    inside.windows(2).filter(|pair| pair[1].text == ":").map(|pair| pair[0].clone()).collect()
}

/// The comment lines that end where a text does; none for a member that is not the first on its line.
fn above(text: &str) -> String {
    let (lines, beside) = text.rsplit_once('\n').unwrap_or(("", text));
    if beside.contains(['{', ',']) {
        return String::new();
    }
    let lines = lines.lines().rev();
    let mut comment: Vec<&str> = lines.map_while(|line| line.trim().strip_prefix("//")).map(bare).collect();
    comment.reverse();
    comment.join(" ")
}

/// Without the slashes that begin a comment.
fn bare(comment: &str) -> &str {
    comment.trim_start_matches('/').trim()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn comments_stand_behind_or_above() {
        let text = "// = 9: of nobody
            struct Params {
                a: f32, // = 0.5: how strong
                // = [1, 2]: above,
                // on two lines
                b: vec2f,
                // of c
                c: f32, d: f32, // of d

                // = 3: help is above
                e: f32, // = 4
                @align(16) f: f32,
            }
            struct Other { g: f32, }";
        let one_line = "// of all\nstruct Params { a: f32 }";
        assert_eq!(comments(one_line)[0].text, "");
        assert_eq!(split("==== colours ===="), (None, "==== colours ===="));
        let found: Vec<_> = comments(text).into_iter().map(|c| (c.name.to_owned(), c.text)).collect();
        let expected = [
            ("a", "= 0.5: how strong"),
            ("b", "= [1, 2]: above, on two lines"),
            ("c", "of c"),
            ("d", "of d"),
            ("e", "= 4: help is above"),
            ("f", ""),
        ];
        assert_eq!(found, expected.map(|(name, text)| (name.to_owned(), text.to_owned())));
        assert_eq!(split("= \"#ff0000\": of the rim"), (Some("\"#ff0000\""), "of the rim"));
        assert_eq!(split("plain: help"), (None, "plain: help"));
    }
}
