//! The schema and the reader know the same keys.

use serde_json::Value;

use super::listing::{Listed, TABLES};
use super::schema;
use crate::spec::catalogue::{FILTERS, SHAPES};

fn sorted<'a>(names: impl IntoIterator<Item = &'a str>) -> Vec<String> {
    let mut names: Vec<String> = names.into_iter().map(str::to_owned).collect();
    names.sort();
    names
}

/// The keys under `properties` of the schema at a JSON pointer, which must refuse all others.
fn keys_at(pointer: &str) -> Vec<String> {
    let schema = schema();
    let table = schema.pointer(pointer).unwrap_or_else(|| panic!("the schema has nothing at {pointer}"));
    assert_eq!(table["additionalProperties"], Value::Bool(false), "{pointer}");
    sorted(table["properties"].as_object().expect("a table's keys").keys().map(String::as_str))
}

#[test]
fn tables_have_the_readers_keys() {
    for Listed { pointer, keys, .. } in TABLES {
        assert_eq!(keys_at(pointer), sorted(keys.iter().copied()), "{pointer}");
    }
}

#[test]
fn shapes_have_the_readers_keys() {
    assert_eq!(keys_at("/$defs/shape"), sorted(SHAPES.iter().map(|row| row.name)));
    for row in SHAPES.iter().filter(|row| !row.keys.is_empty()) {
        let keys = sorted(row.keys.iter().copied());
        assert_eq!(keys_at(&format!("/$defs/shape/properties/{}", row.name)), keys, "{}", row.name);
    }
}

#[test]
fn filters_have_the_catalogues_parameters() {
    assert_eq!(keys_at("/$defs/filter/anyOf/1"), sorted(FILTERS.iter().map(|row| row.name)));
    for row in FILTERS {
        let params = sorted(row.params.iter().map(|param| param.name));
        assert_eq!(keys_at(&format!("/$defs/filter/anyOf/1/properties/{}", row.name)), params, "{}", row.name);
    }
}

/// All strings under the key `$ref`.
fn references(value: &Value, found: &mut Vec<String>) {
    match value {
        Value::Object(map) => {
            found.extend(map.get("$ref").and_then(Value::as_str).map(str::to_owned));
            map.values().for_each(|inner| references(inner, found));
        }
        Value::Array(list) => list.iter().for_each(|inner| references(inner, found)),
        _ => {}
    }
}

#[test]
fn references_lead_somewhere() {
    let schema = schema();
    let mut found = Vec::new();
    references(&schema, &mut found);
    assert!(found.len() > 10, "only {} references", found.len());
    for reference in found {
        let pointer = reference.strip_prefix('#').expect("references stay in the schema");
        assert!(schema.pointer(pointer).is_some(), "{reference} leads nowhere");
    }
}
