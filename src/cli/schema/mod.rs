//! `lenspeel schema`: a JSON Schema (draft 2020-12) of the spec file, for editors.

mod filters;
mod kinds;
mod lens;
mod listing;
mod shapes;
mod tables;

pub use listing::{Row, keys_markdown, shape_rows};
use serde_json::{Value, json};

use crate::limits::{MAX_RULES, MAX_WRITTEN_LENSES};

/// The schema of a whole spec file.
pub fn schema() -> Value {
    json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "lenspeel spec, version 1",
        "description": "A scene, the lenses over it, and how it is seen.",
        "type": "object",
        "additionalProperties": false,
        "required": ["scene"],
        "properties": {
            "version": { "description": "Of the format.", "const": 1 },
            "scene": tables::scene(),
            "camera": tables::camera(),
            "image": tables::image(),
            "light": tables::light(),
            "lens": kinds::tables("Lenses, in file order.", MAX_WRITTEN_LENSES, lens::lens()),
            "overlap": kinds::tables("Explicit styles for overlaps.", MAX_RULES, lens::overlap()),
            "animation": tables::animation(),
        },
        "$defs": {
            "color": kinds::color(),
            "rotation": kinds::rotation(),
            "shape": shapes::shape(),
            "filter": filters::filter(),
            "matches": lens::matches(),
        },
    })
}

#[cfg(test)]
mod tests;
