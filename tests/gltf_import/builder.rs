//! Writes small glTF files.

use lenspeel::InputError;
use lenspeel::scene::Model;
use lenspeel::spec::SceneChoice;
use serde_json::{Value, json};

pub const U8: u32 = 5121;
pub const U16: u32 = 5123;
pub const U32: u32 = 5125;
pub const F32: u32 = 5126;

/// A glTF file in the making: its JSON and the bytes of its one buffer.
pub struct Doc {
    pub json: Value,
    pub bin: Vec<u8>,
}

impl Doc {
    pub fn new() -> Self {
        let json = json!({
            "asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": []}],
            "nodes": [], "meshes": [], "accessors": [], "bufferViews": [],
        });
        Self { json, bin: Vec::new() }
    }

    /// Appends to a list of the root and returns the new index.
    pub fn push(&mut self, list: &str, value: Value) -> usize {
        if self.json.get(list).is_none() {
            self.json[list] = json!([]);
        }
        let list = self.json[list].as_array_mut().expect("a list");
        list.push(value);
        list.len() - 1
    }

    pub fn view(&mut self, bytes: &[u8]) -> usize {
        let offset = self.bin.len();
        self.bin.extend(bytes);
        self.push("bufferViews", json!({"buffer": 0, "byteOffset": offset, "byteLength": bytes.len()}))
    }

    pub fn accessor(&mut self, bytes: &[u8], component: u32, kind: &str, count: usize) -> usize {
        let view = self.view(bytes);
        self.push("accessors", json!({"bufferView": view, "componentType": component, "type": kind, "count": count}))
    }

    pub fn floats<const N: usize>(&mut self, rows: &[[f32; N]]) -> usize {
        let kind = ["", "SCALAR", "VEC2", "VEC3", "VEC4"][N];
        self.accessor(&float_bytes(rows), F32, kind, rows.len())
    }

    /// The corners of a unit square in the xy plane, as POSITION.
    pub fn square(&mut self) -> usize {
        self.floats(&[[0.0, 0.0, 0.0], [1.0, 0.0, 0.0], [1.0, 1.0, 0.0], [0.0, 1.0, 0.0]])
    }

    /// A mesh of one primitive, and a node of the scene that shows it; returns the node.
    pub fn show(&mut self, primitive: Value) -> usize {
        let mesh = self.push("meshes", json!({"name": "Shape", "primitives": [primitive]}));
        self.node(json!({"name": "Thing", "mesh": mesh}))
    }

    /// A root node of the first scene.
    pub fn node(&mut self, node: Value) -> usize {
        let node = self.push("nodes", node);
        self.json["scenes"][0]["nodes"].as_array_mut().expect("a list").push(json!(node));
        node
    }

    /// As JSON whose buffer is a data URI.
    pub fn gltf(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        if !self.bin.is_empty() {
            json["buffers"] = json!([{"byteLength": self.bin.len(), "uri": data_uri(&self.bin)}]);
        }
        serde_json::to_vec(&json).expect("JSON")
    }

    /// As a GLB file.
    pub fn glb(&self) -> Vec<u8> {
        let mut json = self.json.clone();
        json["buffers"] = json!([{"byteLength": self.bin.len()}]);
        let mut text = serde_json::to_vec(&json).expect("JSON");
        text.resize(text.len().next_multiple_of(4), b' ');
        let mut bin = self.bin.clone();
        bin.resize(bin.len().next_multiple_of(4), 0);
        let length = 12 + 8 + text.len() + 8 + bin.len();
        let mut out = b"glTF".to_vec();
        out.extend(2u32.to_le_bytes());
        out.extend((length as u32).to_le_bytes());
        for (kind, data) in [(b"JSON", text), (b"BIN\0", bin)] {
            out.extend((data.len() as u32).to_le_bytes());
            out.extend(kind);
            out.extend(data);
        }
        out
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

pub fn float_bytes<const N: usize>(rows: &[[f32; N]]) -> Vec<u8> {
    rows.iter().flatten().flat_map(|v| v.to_le_bytes()).collect()
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
