//! The schema as tables for people: each key with what it takes, its default and a line of help.

use serde_json::Value;

use super::schema;
use crate::cli::words::cell;
use crate::spec::catalogue::ShapeRow;
use crate::spec::{NumberRange, keys};

/// A table of the format: how the file writes it, where the schema has it, and its keys in the order of the page.
pub struct Listed {
    pub title: &'static str,
    pub pointer: &'static str,
    pub keys: &'static [&'static str],
}

const fn listed(title: &'static str, pointer: &'static str, keys: &'static [&'static str]) -> Listed {
    Listed { title, pointer, keys }
}

pub const TABLES: &[Listed] = &[
    listed("A spec", "", keys::DOCUMENT),
    listed("`[scene]`", "/properties/scene", keys::SCENE),
    listed("`[camera]`", "/properties/camera", keys::CAMERA),
    listed("`[image]`", "/properties/image", keys::IMAGE),
    listed("`[light]`", "/properties/light", keys::LIGHT),
    listed("`[[light.directional]]`", "/properties/light/properties/directional/items", keys::DIRECTIONAL),
    listed("`[[lens]]`", "/properties/lens/items", keys::LENS),
    listed("`attach` to a node", "/properties/lens/items/properties/attach/anyOf/1", keys::ATTACH),
    listed("`only`, `except`", "/$defs/matches", keys::MATCHES),
    listed("`glass`", "/properties/lens/items/properties/glass/anyOf/1", keys::GLASS),
    listed("`outline` of `erase`", "/$defs/filter/anyOf/1/properties/erase/properties/outline", keys::OUTLINE),
    listed("`[[overlap]]`", "/properties/overlap/items", keys::OVERLAP),
    listed("`[animation]`", "/properties/animation", keys::ANIMATION),
    listed("`[[animation.track]]`", "/properties/animation/properties/track/items", keys::TRACK),
];

/// A key as people read it.
pub struct Row {
    pub key: &'static str,
    pub kind: String,
    /// Empty where the help says what it means to leave it out.
    pub default: String,
    pub help: String,
}

/// All tables in Markdown.
pub fn keys_markdown() -> String {
    let schema = schema();
    let sections: Vec<String> = TABLES
        .iter()
        .map(|Listed { title, pointer, keys }| {
            format!("### {title}\n\n{}", markdown(&rows(&at(&schema, pointer), keys)))
        })
        .collect();
    sections.join("\n")
}

/// The keys of a shape.
pub fn shape_rows(row: &ShapeRow) -> Vec<Row> {
    rows(&at(&schema(), &format!("/$defs/shape/properties/{}", row.name)), row.keys)
}

fn markdown(rows: &[Row]) -> String {
    let mut text = "| key | value | default | |\n|---|---|---|---|\n".to_owned();
    for Row { key, kind, default, help } in rows {
        text += &format!("| `{key}` | {} | {} | {} |\n", cell(kind), cell(default), cell(help));
    }
    text
}

fn at(schema: &Value, pointer: &str) -> Value {
    schema.pointer(pointer).cloned().unwrap_or_default()
}

fn rows(table: &Value, keys: &'static [&'static str]) -> Vec<Row> {
    let is_required = |key: &str| table["required"].as_array().is_some_and(|list| list.iter().any(|name| name == key));
    keys.iter()
        .map(|key| {
            let value = &table["properties"][*key];
            let default = match &value["default"] {
                Value::Null if is_required(key) => "required".to_owned(),
                Value::Null => String::new(),
                default => default.to_string(),
            };
            Row { key, kind: kind(value), default, help: value["description"].as_str().unwrap_or_default().to_owned() }
        })
        .collect()
}

/// What a value may be, as a noun.
fn kind(schema: &Value) -> String {
    if let Some(reference) = schema["$ref"].as_str() {
        return match reference.rsplit('/').next().unwrap_or_default() {
            "color" => "colour".into(),
            "rotation" => "[x, y, z] or [x, y, z, w]".into(),
            "matches" => "`{ nodes, materials }`".into(),
            other => other.into(),
        };
    }
    if let Some(choices) = schema["anyOf"].as_array() {
        return choices.iter().map(kind).collect::<Vec<_>>().join(" or ");
    }
    if let Some(words) = schema["enum"].as_array() {
        return words.iter().map(Value::to_string).collect::<Vec<_>>().join(" | ");
    }
    match schema["type"].as_str() {
        None => schema["const"].to_string(),
        Some("boolean") => "true or false".into(),
        Some("string") => "text".into(),
        Some("number") => ranged("number", schema),
        Some("integer") => ranged("whole number", schema),
        Some("array") => list(schema),
        Some(_) => match schema["properties"].as_object() {
            Some(keys) if keys.len() == 1 => format!("`{{ {} }}`", keys.keys().next().map_or("", String::as_str)),
            Some(_) => "table".into(),
            None => "table of files".into(),
        },
    }
}

/// A number with its range.
fn ranged(noun: &str, schema: &Value) -> String {
    let end = |closed: &str, open: &str| schema[closed].as_f64().or(schema[open].as_f64());
    let open = !(schema["exclusiveMinimum"].is_null() && schema["exclusiveMaximum"].is_null());
    let range = NumberRange { min: end("minimum", "exclusiveMinimum"), max: end("maximum", "exclusiveMaximum"), open };
    if range == NumberRange::ANY { noun.to_owned() } else { format!("{noun}, {range}") }
}

fn list(schema: &Value) -> String {
    if schema["prefixItems"].is_array() {
        return "[seconds, value]".into();
    }
    let items = &schema["items"];
    let number = matches!(items["type"].as_str(), Some("number" | "integer"));
    let least = schema["minItems"].as_u64();
    let most = schema["maxItems"].as_u64();
    if number && least.is_some() && least == most {
        let names = match most {
            Some(2) => "[a, b]",
            Some(3) => "[x, y, z]",
            _ => "[nx, ny, nz, d]",
        };
        return ranged(names, items).replace("],", "], each");
    }
    let of = match items["type"].as_str() {
        Some("array") => kind(items),
        Some("string") => "patterns".into(),
        Some(_) => "tables".into(),
        None => format!("{}s", kind(items)),
    };
    match least {
        Some(least) if least > 1 => format!("list of {of}, at least {least}"),
        _ => format!("list of {of}"),
    }
}
