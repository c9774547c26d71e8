//! Schemas of the shapes.

use serde_json::{Map, Value, json};

use super::kinds::{described, numbers, points, reference, size, table, text, vector};
use crate::cli::words::sentence;
use crate::spec::{NumberRange, catalogue};

const NONE: Value = Value::Null;

/// One shape: a table with one key.
pub fn shape() -> Value {
    let mut properties = Map::new();
    for (name, schema) in round().into_iter().chain(cornered()).chain(composed()) {
        let help = catalogue::shape(name).map_or("", |row| row.help);
        properties.insert(name.to_owned(), described(schema, &sentence(help), NONE));
    }
    json!({
        "description": "One shape.",
        "type": "object",
        "additionalProperties": false,
        "minProperties": 1,
        "maxProperties": 1,
        "properties": properties,
    })
}

fn point(help: &str) -> Value {
    described(vector(), help, NONE)
}

fn rotation() -> Value {
    reference("rotation")
}

fn round() -> Vec<(&'static str, Value)> {
    let ball = json!({ "center": point("Its centre."), "radius": size() });
    let radii = described(numbers(3, NumberRange::POSITIVE), "Along x, y and z.", NONE);
    let ellipsoid = json!({ "center": point("Its centre."), "radii": radii, "rotation": rotation() });
    let tube = || json!({ "from": point("One end."), "to": point("The other end."), "radius": size() });
    let radius = |help| described(super::kinds::number(NumberRange::NOT_NEGATIVE), help, NONE);
    let cone = json!({
        "from": point("One end."),
        "to": point("The other end."),
        "from_radius": radius("At one end; 0 is a tip."),
        "to_radius": radius("At the other end; 0 is a tip."),
    });
    vec![
        ("sphere", table(&["center", "radius"], ball)),
        ("ellipsoid", table(&["center", "radii"], ellipsoid)),
        ("cylinder", table(&["from", "to", "radius"], tube())),
        ("cone", table(&["from", "to", "from_radius", "to_radius"], cone)),
        ("capsule", table(&["from", "to", "radius"], tube())),
    ]
}

fn cornered() -> Vec<(&'static str, Value)> {
    let planes = json!({ "type": "array", "items": numbers(4, NumberRange::ANY), "minItems": 4 });
    let planes = described(planes, "[nx, ny, nz, d]: the points with n.p <= d for all.", NONE);
    let flat = json!({
        "corners": described(points(3), "Of a convex polygon in one plane.", NONE),
        "depth": described(size(), "How far behind it the lens reaches; default: to the far plane.", NONE),
    });
    let normal = |help| described(vector(), help, NONE);
    let half_space = json!({ "point": point("On its plane."), "normal": normal("Points out of the volume; of any length but zero.") });
    let slab = json!({
        "point": point("Midway between the planes."),
        "normal": normal("Across the planes; of any length but zero."),
        "thickness": size(),
    });
    vec![
        ("halfspace", table(&["point", "normal"], half_space)),
        ("slab", table(&["point", "normal", "thickness"], slab)),
        ("box", cuboid()),
        ("polytope", table(&["planes"], json!({ "planes": planes }))),
        ("hull", table(&["points"], json!({ "points": described(points(4), "Their convex hull.", NONE) }))),
        ("flat", table(&["corners"], flat)),
    ]
}

/// By centre and size, or by two corners.
fn cuboid() -> Value {
    let properties = json!({
        "center": point("Its centre."),
        "size": described(numbers(3, NumberRange::POSITIVE), "Along x, y and z.", NONE),
        "rotation": rotation(),
        "min": point("The lowest corner, instead of center and size."),
        "max": point("The highest corner."),
    });
    let mut schema = table(&[], properties);
    schema["oneOf"] = json!([
        { "required": ["center", "size"], "properties": { "min": false, "max": false } },
        { "required": ["min", "max"], "properties": { "center": false, "size": false, "rotation": false } },
    ]);
    schema
}

fn composed() -> Vec<(&'static str, Value)> {
    let mesh = json!({
        "file": described(text(), "A glTF file with a closed mesh.", NONE),
        "node": described(text(), "With its descendants; default: all.", NONE),
        "convex": described(
            json!({ "enum": ["hull", "decompose"] }),
            "Its convex hull, or its own shape with hollows and holes; default: convex as it stands.",
            NONE,
        ),
    });
    let list = || json!({ "type": "array", "items": reference("shape"), "minItems": 1 });
    vec![("mesh", table(&["file"], mesh)), ("union", list()), ("intersection", list()), ("difference", list())]
}
