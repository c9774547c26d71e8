//! Schemas of the filters, from the catalogue.

use serde_json::{Map, Value, json};

use super::kinds::{cap, described, number, numbers, outline, patterns, reference, table, text, vector};
use crate::color_map;
use crate::spec::NumberRange;
use crate::spec::catalogue::{FILTERS, FilterRow, Param, ParamDefault, ParamKind};

/// One filter: a bare name, or a table with one key.
pub fn filter() -> Value {
    let names: Vec<&str> = FILTERS.iter().filter(|row| row.stands_alone()).map(|row| row.name).collect();
    let tables: Map<String, Value> = FILTERS.iter().map(|row| (row.name.to_owned(), parameters(row))).collect();
    json!({
        "description": "A filter's name, or a table with its name as the only key.",
        "anyOf": [
            { "enum": names },
            {
                "type": "object",
                "additionalProperties": false,
                "minProperties": 1,
                "maxProperties": 1,
                "properties": tables,
            },
        ],
    })
}

fn parameters(row: &FilterRow) -> Value {
    let properties: Map<String, Value> =
        row.params.iter().map(|param| (param.name.to_owned(), parameter(param))).collect();
    let required: Vec<&str> =
        row.params.iter().filter(|param| param.default == ParamDefault::Required).map(|param| param.name).collect();
    let mut schema = table(&required, properties.into());
    match row.name {
        "show" => {
            let nodes_alone = json!({ "required": ["nodes"], "properties": { "materials": false } });
            schema["anyOf"] = json!([{ "required": ["alternate"] }, nodes_alone]);
        }
        "erase" => schema["dependentRequired"] = json!({ "outline": ["cap"] }),
        _ => {}
    }
    described(schema, row.help, Value::Null)
}

fn parameter(param: &Param) -> Value {
    let (default, meaning) = match param.default {
        ParamDefault::Number(value) => (value.into(), String::new()),
        ParamDefault::Color(text) | ParamDefault::Text(text) => (text.into(), String::new()),
        ParamDefault::Bool(value) => (value.into(), String::new()),
        ParamDefault::Meaning(words) => (Value::Null, format!("; default: {words}")),
        ParamDefault::Required => (Value::Null, String::new()),
    };
    let help = format!("{}{meaning}", param.help);
    described(kind(param.kind), &help, default)
}

fn kind(kind: ParamKind) -> Value {
    match kind {
        ParamKind::Number(range) => number(range),
        ParamKind::Integer(min, max) => json!({ "type": "integer", "minimum": min, "maximum": max }),
        ParamKind::NumberOrPair(range) => json!({ "anyOf": [number(range), numbers(2, range)] }),
        ParamKind::Interval => numbers(2, NumberRange::ANY),
        ParamKind::Vector => vector(),
        ParamKind::Color => reference("color"),
        ParamKind::Bool => json!({ "type": "boolean" }),
        ParamKind::Text | ParamKind::File => text(),
        ParamKind::Choice(words) => json!({ "enum": words }),
        ParamKind::ColorMap => {
            let reversed = color_map::NAMES.iter().map(|name| format!("{name}{}", color_map::REVERSED));
            json!({ "enum": color_map::NAMES.iter().map(|name| (*name).to_owned()).chain(reversed).collect::<Vec<_>>() })
        }
        ParamKind::Patterns => patterns(),
        ParamKind::Cap => cap(),
        ParamKind::Outline => outline(),
        ParamKind::FreeTable => json!({ "type": "object" }),
    }
}
