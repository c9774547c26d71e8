//! Schemas of plain values.

use serde_json::{Value, json};

use crate::spec::catalogue::LINE_WIDTH;
use crate::spec::{NumberRange, Outline};

pub fn number(range: NumberRange) -> Value {
    let mut schema = json!({ "type": "number" });
    let [min, max] = if range.open { ["exclusiveMinimum", "exclusiveMaximum"] } else { ["minimum", "maximum"] };
    if let Some(value) = range.min {
        schema[min] = value.into();
    }
    if let Some(value) = range.max {
        schema[max] = value.into();
    }
    schema
}

/// A list of exactly `count` numbers.
pub fn numbers(count: usize, range: NumberRange) -> Value {
    json!({ "type": "array", "items": number(range), "minItems": count, "maxItems": count })
}

pub fn vector() -> Value {
    numbers(3, NumberRange::ANY)
}

pub fn size() -> Value {
    number(NumberRange::POSITIVE)
}

/// A list of points, at least `least`.
pub fn points(least: usize) -> Value {
    json!({ "type": "array", "items": vector(), "minItems": least })
}

pub fn patterns() -> Value {
    json!({ "type": "array", "items": { "type": "string", "minLength": 1 } })
}

pub fn text() -> Value {
    json!({ "type": "string", "minLength": 1 })
}

pub fn color() -> Value {
    json!({
        "description": "\"#rrggbb\", \"#rrggbbaa\" (sRGB) or a CSS name.",
        "type": "string",
        "pattern": "^(#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?|[a-zA-Z]+)$",
    })
}

pub fn cap() -> Value {
    json!({
        "type": "string",
        "pattern": "^(own|hatch|(hatch +)?(#[0-9a-fA-F]{6}([0-9a-fA-F]{2})?|[a-zA-Z]+))$",
    })
}

pub fn outline() -> Value {
    let default = Outline::default();
    let properties = json!({
        "width": described(number(LINE_WIDTH), "Of the line, pixels.", default.width.into()),
        "color": described(reference("color"), "Of the line.", default.color.to_string().into()),
    });
    table(&[], properties)
}

pub fn rotation() -> Value {
    json!({
        "description": "Three degrees (intrinsic XYZ) or a quaternion [x, y, z, w].",
        "type": "array",
        "items": { "type": "number" },
        "minItems": 3,
        "maxItems": 4,
    })
}

pub fn reference(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}

/// A schema with a description, and a default if it is not null.
pub fn described(mut schema: Value, help: &str, default: Value) -> Value {
    schema["description"] = help.into();
    if !default.is_null() {
        schema["default"] = default;
    }
    schema
}

/// A list of at most so many tables.
pub fn tables(help: &str, most: usize, table: Value) -> Value {
    json!({ "description": help, "type": "array", "maxItems": most, "items": table })
}

/// A table with these keys and no others.
pub fn table(required: &[&str], properties: Value) -> Value {
    let mut schema = json!({ "type": "object", "additionalProperties": false, "properties": properties });
    if !required.is_empty() {
        schema["required"] = json!(required);
    }
    schema
}
