//! Writes small glTF files.

use lenspeel::InputError;
use lenspeel::scene::Model;
use lenspeel::spec::SceneChoice;
use serde_json::{Value, json};

pub use crate::gltf::{Doc, F32, float_bytes};

pub const U8: u32 = 5121;
pub const U16: u32 = 5123;
pub const U32: u32 = 5125;

impl Doc {
    /// The corners of a unit square in the xy plane, as POSITION.
    pub fn square(&mut self) -> usize {
        self.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    }

    /// A mesh of one primitive, and a node of the scene that shows it; returns the node.
    pub fn show(&mut self, primitive: Value) -> usize {
        let mesh = self.push("meshes", json!({"name": "Shape", "primitives": [primitive]}));
        self.node(json!({"name": "Thing", "mesh": mesh}))
    }

    /// As JSON whose buffer is a data URI.
    pub fn gltf(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.bin.is_empty() {
            json["buffers"] = json!([{"byteLength": self.bin.len(), "uri": data_uri(&self.bin)}]);
        }
        serde_json::to_vec(&json).expect("JSON")
    }

    pub fn load(&self) -> Result<Model, InputError> {
        load(&self.gltf(), None)
    }

    pub fn model(&self) -> Model {
        self.load().expect("a valid file")
    }
}

/// Reads a file that names no others.
pub fn load(bytes: &[u8], choice: Option<&SceneChoice>) -> Result<Model, InputError> {
    Model::from_bytes(bytes, "test.gltf", choice, &mut |uri| Err(InputError::new(format!("there is no `{uri}`"))))
}

/// Percent-encoded, which needs no base64 writer.
pub fn data_uri(bytes: &[u8]) -> String {
    let coded: String = bytes.iter().map(|b| format!("%{b:02x}")).collect();
    format!("data:application/octet-stream,{coded}")
}

/// A PNG of the given colour type; `samples` as the encoder takes them.
pub fn png(image: image::DynamicImage) -> Vec<u8> {
    let mut out = std::io::Cursor::new(Vec::new());
    image.write_to(&mut out, image::ImageFormat::Png).expect("encodes");
    out.into_inner()
}
