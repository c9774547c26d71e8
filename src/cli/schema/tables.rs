//! Schemas of the tables around the lenses: scene, camera, image, light, animation.

use serde_json::{Value, json};

use super::kinds::{described, number, patterns, reference, size, table, text, vector};
use crate::spec::{ImageSpec, NumberRange};

const NONE: Value = Value::Null;

pub fn scene() -> Value {
    let which = json!({ "anyOf": [text(), { "type": "integer", "minimum": 0 }] });
    let properties = json!({
        "file": described(text(), "The model, .glb or .gltf, relative to this file.", NONE),
        "scene": described(which, "Which of the file's scenes, by name or index; default: the file's default.", NONE),
        "time": described(number(NumberRange::NOT_NEGATIVE), "Seconds into the file's animations; default: the rest pose.", NONE),
        "hide": described(patterns(), "Node-name patterns that are not drawn.", json!([])),
        "backfaces": described(json!({ "enum": ["show", "as-material"] }), "Triangles seen from behind.", json!("show")),
        "alternates": {
            "description": "Other models in the same space, drawn only by the filter show.",
            "type": "object",
            "additionalProperties": text(),
        },
    });
    described(table(&["file"], properties), "What is seen.", NONE)
}

pub fn camera() -> Value {
    let properties = json!({
        "eye": described(vector(), "Where it stands.", NONE),
        "target": described(vector(), "What it looks at.", NONE),
        "up": described(vector(), "What is up in the picture.", json!([0, 1, 0])),
        "fov_y": described(number(NumberRange::open(0.0, 180.0)), "Vertical field of view, degrees.", json!(45)),
        "orthographic_height": described(size(), "Height of a parallel view, scene units.", NONE),
        "near": described(number(NumberRange::ANY), "Nearest depth drawn; default: fitted.", NONE),
        "far": described(number(NumberRange::ANY), "Farthest depth drawn; default: fitted.", NONE),
        "node": described(text(), "A camera of the file instead.", NONE),
    });
    described(
        table(&[], properties),
        "Default: looks from (1, 0.7, 1.3) at the centre of the bounds, which just fit.",
        NONE,
    )
}

pub fn image() -> Value {
    let side = json!({ "type": "integer", "minimum": 1, "maximum": ImageSpec::LARGEST_SIDE });
    let size = json!({ "type": "array", "items": side, "minItems": 2, "maxItems": 2 });
    let properties = json!({
        "size": described(size, "Width and height, pixels.", json!([1280, 720])),
        "samples": described(json!({ "enum": [1, 4, 9, 16] }), "Per pixel.", json!(4)),
        "background": described(reference("color"), "A colour or \"transparent\".", json!("#1e2227")),
        "tone_mapping": described(
            json!({ "enum": ["none", "neutral"] }),
            "How colours brighter than white are shown: cut off, or bent by Khronos PBR Neutral.",
            json!("none")
        ),
        "legend": described(json!({ "type": "boolean" }), "What false colours and contour lines stand for, over the lower edge of the picture.", json!(false)),
    });
    described(table(&[], properties), "The picture.", NONE)
}

pub fn light() -> Value {
    let brightness = || number(NumberRange::NOT_NEGATIVE);
    let directional = json!({
        "direction": described(vector(), "The way the light travels.", NONE),
        "color": described(reference("color"), "Of the light.", json!("#ffffff")),
        "intensity": described(brightness(), "Factor.", json!(1)),
    });
    let lights = json!({ "type": "array", "items": table(&["direction"], directional) });
    let properties = json!({
        "ambient": described(brightness(), "Light from everywhere.", json!(0)),
        "directional": described(lights, "Lights from far away.", NONE),
    });
    described(table(&[], properties), "Default: the file's lights, else a key, a fill and ambient light.", NONE)
}

pub fn animation() -> Value {
    let key = json!({
        "type": "array",
        "prefixItems": [number(NumberRange::NOT_NEGATIVE), {}],
        "minItems": 2,
        "maxItems": 2,
    });
    let track = json!({
        "target": described(text(), "What moves, such as lens.shell.center.", NONE),
        "keys": { "description": "[seconds, value], in order.", "type": "array", "items": key },
        "ease": described(json!({ "enum": ["linear", "smooth", "step"] }), "Between keys.", json!("linear")),
    });
    let properties = json!({
        "duration": described(number(NumberRange::POSITIVE), "Seconds.", NONE),
        "fps": described(number(NumberRange::POSITIVE), "Images a second.", NONE),
        "track": { "description": "(not built yet)", "type": "array", "items": table(&["target", "keys"], track) },
    });
    described(table(&[], properties), "Image sequences; a still is at 0 s.", NONE)
}
