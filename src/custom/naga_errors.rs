//! What naga refuses, in the words and with the places of this program.

use std::error::Error;

use naga::front::wgsl::ParseError;
use naga::valid::{ExpressionError, FunctionError, ValidationError};
use naga::{BinaryOperator, Scalar, ScalarKind, TypeInner, UnaryOperator, WithSpan};

use super::source::Text;
use super::{contract, signature, words};
use crate::InputError;
use crate::spec::read::suggest;

/// What naga's parser refused.
pub fn not_wgsl(text: &Text, error: &ParseError) -> InputError {
    let first = error.labels().find_map(|(span, _)| text.place(span));
    if let Some(name) = quoted(error.message(), "redefinition of `").filter(|name| contract::NAMES.contains(name)) {
        let message = format!("`{name}` is declared already: it is part of what every filter file finds");
        return text
            .error(first, message)
            .help("leave the declaration out and use it as it is, or choose another name");
    }
    if let Some(name) = quoted(error.message(), "the `").filter(|_| error.message().contains("enable extension")) {
        return text
            .error(first, format!("`{name}` is not available in a filter"))
            .help("filters run on every device: use f32, i32, u32 or bool, and what is made of them");
    }
    if error.notes().chain([error.message()]).any(|note| note.contains("recursion limit")) {
        return text
            .error(words::deepest_bracket(&text.user.text), "the file nests too deep")
            .help("use fewer brackets within brackets; give parts a name with `let`");
    }
    let message = without_handles(&plain(error.message()).replace("found \"\"", "found the end of the file"));
    // naga has no place for this one and the next.
    if let Some((index, _)) = message.strip_prefix("index ").and_then(|rest| rest.split_once(" is out of bounds")) {
        let place = words::find_run(&text.user.text, &["[", index, "]"]);
        return text.error(place, format!("there is no element {index}")).help("they count from 0");
    }
    if message.starts_with("incompatible operands") && first.is_none() {
        return text
            .error(None, "an operator stands between values that it does not work on, such as arrays or structs")
            .help("take the parts that you need, as in a[0], s.normal or *p");
    }
    let mut refusal = text.error(first, message);
    for (span, label) in error.labels() {
        if let Some(place) = text.place(span) {
            let label = if label.is_empty() { "here".to_owned() } else { plain(label) };
            refusal = refusal.label(place, label);
        }
    }
    let notes: Vec<String> = error.notes().map(plain).collect();
    match remedy(text, error.message()) {
        Some(help) => refusal.help(help),
        None if notes.is_empty() => refusal,
        None => refusal.help(notes.join("; ")),
    }
}

/// The name in quotes behind the beginning of a message.
fn quoted<'a>(message: &'a str, beginning: &str) -> Option<&'a str> {
    message.strip_prefix(beginning)?.split_once('`').map(|(name, _)| name)
}

/// What to do about a name that nothing declares, or about what naga does not have.
fn remedy(text: &Text, message: &str) -> Option<String> {
    if message.contains("not yet implemented") {
        return Some("leave it out".to_owned());
    }
    let unknown = quoted(message, "no definition in scope for identifier: `")?;
    if unknown == signature::PARAMS {
        return Some("declare struct Params { strength: f32, }, or leave the argument out".to_owned());
    }
    let known = words::declared(&text.whole);
    let near = suggest::nearest(unknown, known).map(|name| format!("did you mean `{name}`?"));
    near.or_else(|| Some(format!("every filter file finds {} declared", suggest::listed(contract::NAMES))))
}

/// What naga's validator refused.
pub fn not_valid(text: &Text, error: &WithSpan<ValidationError>) -> InputError {
    let place = error.spans().filter_map(|(span, _)| text.place(*span)).last();
    if let ValidationError::Function { name, source, .. } = error.as_inner() {
        match source {
            FunctionError::InvalidReturnType { expression: None, .. } => {
                return text
                    .error_at_name(name, format!("`{name}` can end without a `return` of what it gives"))
                    .help("end every way through it with `return`");
            }
            FunctionError::Expression {
                source: ExpressionError::InvalidBinaryOperandTypes { op, lhs_type, rhs_type, .. },
                ..
            } => {
                let (left, right) = (name_of(lhs_type), name_of(rhs_type));
                return text
                    .error(place, format!("`{}` does not work on {left} and {right}", sign(*op)))
                    .help("convert one of them, as in f32(i), or take the parts that you need, as in v.xy");
            }
            FunctionError::Expression { source: ExpressionError::InvalidUnaryOperandType(op, _), .. } => {
                let (sign, works) = match op {
                    UnaryOperator::Negate => ("-", "f32 and i32"),
                    UnaryOperator::LogicalNot => ("!", "bool"),
                    UnaryOperator::BitwiseNot => ("~", "i32 and u32"),
                };
                let message = format!("`{sign}` works on {works}, and vectors of these");
                return text.error(place, message).help("convert what stands behind it, or compare it");
            }
            _ => {}
        }
    }
    // Outermost first; that something is invalid is known by now.
    let mut causes = Vec::new();
    let mut next: Option<&dyn Error> = Some(error.as_inner());
    while let Some(cause) = next {
        causes.push(without_handles(&plain(&cause.to_string())));
        next = cause.source();
    }
    let told: Vec<&str> = causes.iter().map(String::as_str).filter(|cause| !cause.ends_with("is invalid")).collect();
    text.error(place, if told.is_empty() { causes.join(": ") } else { told.join(": ") })
}

/// As messages are written here: no capital, no full stop.
fn plain(text: &str) -> String {
    let text = text.trim().trim_end_matches('.');
    let mut letters = text.chars();
    match letters.next() {
        Some(first) if !letters.as_str().starts_with(char::is_uppercase) => {
            first.to_lowercase().chain(letters).collect()
        }
        _ => text.to_owned(),
    }
}

/// naga names things by their place in its own lists, which say nothing to the reader: `Expression [12]`.
fn without_handles(text: &str) -> String {
    let mut out = String::new();
    let mut rest = text;
    while let Some(at) = rest.find(" [") {
        let (before, after) = rest.split_at(at);
        out += before;
        rest = match after[2..].split_once(']') {
            Some((number, tail)) if !number.is_empty() && number.bytes().all(|b| b.is_ascii_digit()) => tail,
            _ => {
                out += &after[..2];
                &after[2..]
            }
        };
    }
    out + rest
}

/// As a file writes the type.
fn name_of(inner: &TypeInner) -> String {
    match inner {
        TypeInner::Scalar(scalar) => super::check::types::name_of(*scalar),
        TypeInner::Vector { size, scalar } => format!("vec{}{}", *size as u8, suffix(*scalar)),
        TypeInner::Matrix { columns, rows, scalar } => {
            format!("mat{}x{}{}", *columns as u8, *rows as u8, suffix(*scalar))
        }
        TypeInner::Array { .. } => "an array".to_owned(),
        TypeInner::Pointer { .. } | TypeInner::ValuePointer { .. } => "a pointer".to_owned(),
        _ => "a struct".to_owned(),
    }
}

fn suffix(scalar: Scalar) -> &'static str {
    match scalar.kind {
        ScalarKind::Sint => "i",
        ScalarKind::Uint => "u",
        ScalarKind::Bool => "<bool>",
        _ => "f",
    }
}

fn sign(op: BinaryOperator) -> &'static str {
    match op {
        BinaryOperator::Add => "+",
        BinaryOperator::Subtract => "-",
        BinaryOperator::Multiply => "*",
        BinaryOperator::Divide => "/",
        BinaryOperator::Modulo => "%",
        BinaryOperator::Equal => "==",
        BinaryOperator::NotEqual => "!=",
        BinaryOperator::Less => "<",
        BinaryOperator::LessEqual => "<=",
        BinaryOperator::Greater => ">",
        BinaryOperator::GreaterEqual => ">=",
        BinaryOperator::And => "&",
        BinaryOperator::ExclusiveOr => "^",
        BinaryOperator::InclusiveOr => "|",
        BinaryOperator::LogicalAnd => "&&",
        BinaryOperator::LogicalOr => "||",
        BinaryOperator::ShiftLeft => "<<",
        BinaryOperator::ShiftRight => ">>",
    }
}
