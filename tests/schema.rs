//! The JSON Schema as editors get it, held against the reader: what it says of numbers the reader says, too.

use std::path::Path;

use lenspeel::spec::Spec;
use serde_json::Value;

#[test]
fn the_schema_is_as_recorded() {
    insta::assert_json_snapshot!(lenspeel::cli::schema());
}

/// A value that a schema of numbers allows, as the file writes it; `None` for anything else.
fn inside(schema: &Value) -> Option<String> {
    match schema["type"].as_str()? {
        "number" | "integer" => {
            let low = schema["minimum"].as_f64().or(schema["exclusiveMinimum"].as_f64()).unwrap_or(0.0);
            let high = schema["maximum"].as_f64().or(schema["exclusiveMaximum"].as_f64()).unwrap_or(low + 2.0);
            Some(if schema["type"] == "integer" { format!("{low}") } else { format!("{}", 0.5 * (low + high)) })
        }
        "array" => list(schema, &inside(&schema["items"])?),
        _ => None,
    }
}

/// Values just beyond the ends that a schema gives numbers.
fn outside(schema: &Value) -> Vec<String> {
    let beyond = |closed: &str, open: &str, step: f64| {
        schema[closed].as_f64().map(|end| end + step).or(schema[open].as_f64()).map(|value| value.to_string())
    };
    match schema["type"].as_str() {
        Some("number" | "integer") => {
            [beyond("minimum", "exclusiveMinimum", -1.0), beyond("maximum", "exclusiveMaximum", 1.0)]
                .into_iter()
                .flatten()
                .collect()
        }
        Some("array") => outside(&schema["items"]).iter().filter_map(|value| list(schema, value)).collect(),
        _ => Vec::new(),
    }
}

fn list(schema: &Value, value: &str) -> Option<String> {
    let count = schema["minItems"].as_u64()? as usize;
    Some(format!("[{}]", vec![value; count].join(", ")))
}

/// What the reader says of a spec with this table of a key, beside a scene.
fn read(table: &str) -> Result<(), String> {
    let text = format!("scene.file = \"a.glb\"\n{table}");
    Spec::parse(&text, "spec.toml", Path::new("")).map(|_| ()).map_err(|error| error.to_string())
}

/// Holds every number of a table of the schema against the reader; returns how many were refused.
fn hold(pointer: &str, write: impl Fn(&str) -> String) -> usize {
    let schema = lenspeel::cli::schema();
    let table = schema.pointer(pointer).unwrap_or_else(|| panic!("{pointer}"));
    let properties = table["properties"].as_object().expect("a table");
    let is_required = |key: &str| table["required"].as_array().is_some_and(|list| list.iter().any(|name| name == key));
    let mut refused = 0;
    for (key, value) in properties {
        for outside in outside(value) {
            let others = properties.iter().filter(|(name, _)| *name != key && is_required(name));
            // A shape from one place to the same is wrong in another way.
            let apart = |name: &str, value: String| if name == "to" { value.replace('1', "2") } else { value };
            let others = others.filter_map(|(name, value)| Some(format!(", {name} = {}", apart(name, inside(value)?))));
            let text = write(&format!("{key} = {outside}{}", others.collect::<String>()));
            let error = read(&text).expect_err(&text);
            assert!(error.contains(&format!("`{key}`")) && error.contains("must be"), "{text}: {error}");
            refused += 1;
        }
    }
    refused
}

#[test]
fn numbers_that_the_schema_refuses_the_reader_refuses() {
    let mut refused = 0;
    for shape in ["sphere", "ellipsoid", "cylinder", "cone", "capsule", "slab", "flat"] {
        let write = |keys: &str| format!("[[lens]]\nname = \"a\"\nshape.{shape} = {{ {keys} }}\n");
        refused += hold(&format!("/$defs/shape/properties/{shape}"), write);
    }
    let lens = "[[lens]]\nname = \"a\"\nshape.sphere = { center = [0, 0, 0], radius = 1 }\n";
    refused += hold("/properties/lens/items/properties/glass/anyOf/1", |keys| format!("{lens}glass = {{ {keys} }}\n"));
    refused += hold("/properties/image", |keys| format!("image = {{ {keys} }}\n"));
    refused += hold("/properties/light", |keys| format!("light = {{ {keys} }}\n"));
    assert!(refused > 15, "only {refused}");
}

#[test]
fn as_many_lenses_and_rules_as_the_reader_takes_the_schema_takes() {
    let schema = lenspeel::cli::schema();
    let most = |list: &str| schema["properties"][list]["maxItems"].as_u64().expect("a limit") as usize;
    let lens = |n: usize| {
        format!("[[lens]]\nname = \"l{n}\"\nenabled = false\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\n")
    };
    let rule = |_| "[[overlap]]\nwhen = \"l0\"\nfilters = []\n".to_owned();
    let spec = |lenses: usize, rules: usize| (0..lenses).map(lens).chain((0..rules).map(rule)).collect::<String>();
    assert_eq!(read(&spec(most("lens"), most("overlap"))), Ok(()));
    assert!(read(&spec(most("lens") + 1, 0)).is_err_and(|error| error.contains("4097 lenses")));
    assert!(read(&spec(1, most("overlap") + 1)).is_err_and(|error| error.contains("129 overlap rules")));
}
