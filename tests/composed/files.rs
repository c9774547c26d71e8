//! A case as files: its spec and its models, in a folder of its own.

use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::case::{Case, Material, Model, Node, Primitive};
use crate::gltf::Doc;
use crate::write;

/// Writes all files of a case; returns the spec's path.
pub fn write(case: &Case, folder: &Path) -> PathBuf {
    let text = |error: std::io::Error| format!("{}: {error}", folder.display());
    std::fs::create_dir_all(folder).map_err(text).expect("a folder for the case");
    for model in case.models.iter().chain(&case.solids) {
        let path = folder.join(&model.name).with_extension("glb");
        std::fs::write(path, glb(model)).map_err(text).expect("a model of the case");
    }
    let spec = folder.join("case.toml");
    std::fs::write(&spec, write::toml(case)).map_err(text).expect("the spec of the case");
    spec
}

fn glb(model: &Model) -> Vec<u8> {
    let mut doc = Doc::new();
    doc.json["extensionsUsed"] = json!(["KHR_materials_unlit"]);
    for material in &model.materials {
        doc.push("materials", self::material(material));
    }
    for (index, node) in model.nodes.iter().enumerate() {
        let mut json = placed(node);
        let children: Vec<usize> = (0..model.nodes.len()).filter(|i| model.nodes[*i].parent == Some(index)).collect();
        if !children.is_empty() {
            json["children"] = json!(children);
        }
        if !node.primitives.is_empty() {
            let primitives: Vec<Value> = node.primitives.iter().map(|p| primitive(&mut doc, p)).collect();
            json["mesh"] = json!(doc.push("meshes", json!({ "primitives": primitives })));
        }
        match node.parent {
            None => doc.node(json),
            Some(_) => doc.push("nodes", json),
        };
    }
    doc.glb()
}

fn placed(node: &Node) -> Value {
    json!({
        "name": node.name,
        "translation": node.translation.to_array(),
        "rotation": node.rotation.to_array(),
        "scale": node.scale.to_array(),
    })
}

/// Every triangle with corners of its own.
fn primitive(doc: &mut Doc, primitive: &Primitive) -> Value {
    let corners: Vec<[f32; 3]> = primitive.triangles.iter().flatten().map(|p| p.as_vec3().to_array()).collect();
    json!({ "attributes": { "POSITION": doc.floats(&corners) }, "material": primitive.material })
}

fn material(material: &Material) -> Value {
    let mode = if material.color[3] < 1.0 { "BLEND" } else { "OPAQUE" };
    let mut json = json!({
        "name": material.name, "alphaMode": mode, "doubleSided": material.double_sided,
        "pbrMetallicRoughness": { "baseColorFactor": material.color, "metallicFactor": 0.0 },
    });
    if material.unlit {
        json["extensions"] = json!({ "KHR_materials_unlit": {} });
    }
    json
}
