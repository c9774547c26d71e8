//! Schemas of lenses and overlap rules.

use serde_json::{Value, json};

use super::kinds::{described, number, patterns, reference, table, text, vector};
use crate::limits::MAX_NAME;
use crate::spec::{Glass, NumberRange};

const NONE: Value = Value::Null;

pub fn lens() -> Value {
    let flag = json!({ "type": "boolean" });
    let overlap = json!({ "enum": ["stack", "override"] });
    let name = json!({ "type": "string", "pattern": "^[A-Za-z0-9_-]+$", "maxLength": MAX_NAME });
    let properties = json!({
        "name": described(name, "Unique; letters, digits, - and _.", NONE),
        "enabled": described(flag, "false: takes part in nothing.", json!(true)),
        "shape": reference("shape"),
        "attach": attach(),
        "translation": described(vector(), "Moves the shape.", json!([0, 0, 0])),
        "rotation": reference("rotation"),
        "scale": scale(),
        "filters": filters(),
        "over": described(patterns(), "Lenses that this one is above.", json!([])),
        "under": described(patterns(), "Lenses that this one is below.", json!([])),
        "hides": described(patterns(), "Lenses that do not act where this one is.", json!([])),
        "overlap": described(overlap, "override hides everything below it.", json!("stack")),
        "priority": described(json!({ "type": "integer" }), "Breaks ties between lenses with no declared order.", json!(0)),
        "by": described(json!({ "enum": ["pixel", "object"] }), "Cuts through objects, or takes whole ones.", json!("pixel")),
        "only": described(reference("matches"), "Acts on these alone.", NONE),
        "except": described(reference("matches"), "Does not act on these.", NONE),
        "soft": described(number(NumberRange::NOT_NEGATIVE), "Width over which the effect fades in from the boundary, scene units.", json!(0)),
        "glass": glass(),
    });
    table(&["name", "shape"], properties)
}

pub fn overlap() -> Value {
    let when = "Lens names and patterns, ! before & before |, parentheses.";
    let properties = json!({ "when": described(text(), when, NONE), "filters": filters() });
    table(&["when", "filters"], properties)
}

pub fn matches() -> Value {
    table(&[], json!({ "nodes": patterns(), "materials": patterns() }))
}

fn filters() -> Value {
    json!({ "description": "The first acts first.", "type": "array", "items": reference("filter") })
}

fn attach() -> Value {
    json!({
        "description": "The space the shape is in.",
        "default": "scene",
        "anyOf": [{ "enum": ["scene", "camera"] }, table(&["node"], json!({ "node": text() }))],
    })
}

fn scale() -> Value {
    json!({ "description": "One factor or three, none zero.", "default": 1, "anyOf": [{ "type": "number" }, vector()] })
}

fn glass() -> Value {
    let default = Glass::default();
    let pixels = || number(NumberRange::closed(0.0, 1000.0));
    let contact = "Width of a line on the scene where the surface meets it, pixels; 0 draws none, 1 to 2 looks well.";
    let unit = || number(NumberRange::UNIT);
    let properties = json!({
        "color": described(reference("color"), "Of the lens surface.", default.color.to_string().into()),
        "opacity": described(unit(), "Face on.", short(default.opacity)),
        "rim": described(unit(), "Added edge on.", short(default.rim)),
        "outline": described(pixels(), "Width of the silhouette, pixels.", short(default.outline)),
        "contact": described(pixels(), contact, short(default.contact)),
    });
    json!({
        "description": "How the lens surface looks; false draws none.",
        "anyOf": [{ "const": false }, table(&[], properties)],
    })
}

/// The number as one writes it: 0.06 rather than 0.05999999865889549.
fn short(value: f32) -> Value {
    value.to_string().parse::<f64>().map_or(NONE, Value::from)
}
