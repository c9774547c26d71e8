//! The texts of `info` and `init`, as snapshots.

use std::path::Path;

use lenspeel::cli::{InfoChoice, init_text};
use lenspeel::scene::Model;
use lenspeel::spec::{Pattern, Spec};
use serde_json::json;

use super::builder::*;

/// Two named parts, a hundred bolts, a camera, a light, a texture.
fn machine() -> Model {
    let mut doc = Doc::new();
    let position = doc.square();
    let image = doc.view(&png(image::DynamicImage::new_rgb8(4, 2)));
    doc.push("images", json!({"bufferView": image, "name": "rust"}));
    doc.push("textures", json!({"source": 0}));
    let pbr = json!({"baseColorTexture": {"index": 0}, "roughnessFactor": 0.4});
    doc.push("materials", json!({"name": "steel", "pbrMetallicRoughness": pbr, "alphaMode": "BLEND"}));
    doc.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "spot", "name": "lamp", "spot": {}}]}});
    doc.json["extensionsUsed"] = json!(["KHR_lights_punctual", "KHR_materials_sheen"]);
    doc.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 0.75, "znear": 0.5}}));
    let housing = doc.show(json!({"attributes": {"POSITION": position}, "mode": 6, "material": 0}));
    doc.json["nodes"][housing]["name"] = json!("Housing");
    doc.json["nodes"][housing]["scale"] = json!([4, 3, 2]);
    let bolts: Vec<usize> = (0..100)
        .map(|n| doc.push("nodes", json!({"name": format!("Bolt.{n:03}"), "mesh": 0, "translation": [n, 0, 0.5]})))
        .collect();
    doc.node(json!({"name": "Bolts", "children": bolts, "scale": [0.03, 0.03, 0.03]}));
    doc.node(json!({"name": "View", "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}}));
    let (input, output) = (doc.floats(&[[0.5f32], [2.5]]), doc.floats(&[[0.0; 3], [1.0; 3]]));
    let targets = [housing, 101, housing].map(|node| json!({"sampler": 0, "target": {"node": node, "path": "scale"}}));
    let sampler = json!({"input": input, "output": output});
    doc.push("animations", json!({"name": "Breathe", "samplers": [sampler], "channels": targets}));
    let spare = doc.push("nodes", json!({"name": "Spare", "mesh": 0}));
    doc.json["scenes"][0]["name"] = json!("Assembly");
    doc.push("scenes", json!({"name": "Store", "nodes": [spare]}));
    doc.model()
}

fn info_text(model: &Model) -> String {
    lenspeel::cli::info_text(model, &InfoChoice::default())
}

#[test]
fn info_lists_a_model() {
    insta::assert_snapshot!(info_text(&machine()));
}

#[test]
fn info_of_nothing() {
    insta::assert_snapshot!(info_text(&Doc::new().model()));
}

#[test]
fn init_writes_a_spec_that_fits() {
    let text = init_text(&machine(), "models/machine.glb");
    let spec = parse(&text);
    assert_eq!(spec.lenses.len(), 2);
    assert_eq!(spec.lenses[1].over[0].value, Pattern::new("wires"));
    insta::assert_snapshot!(text);
}

fn parse(text: &str) -> Spec {
    Spec::parse(text, "starter.toml", Path::new("")).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

/// Whatever the size and place of a model, and whatever its file is called.
#[test]
fn init_always_parses() {
    for (scale, offset) in [(1.0, 0.0), (1e-6, 0.0), (1e7, -3e8), (1e-3, 5e5), (0.0, 0.0), (1e16, 0.0), (1e-16, 0.0)] {
        let mut doc = Doc::new();
        let position = doc.square();
        doc.show(json!({"attributes": {"POSITION": position}, "mode": 6}));
        doc.json["nodes"][0]["scale"] = json!([scale, scale, scale]);
        doc.json["nodes"][0]["translation"] = json!([offset, 0, 0]);
        assert_eq!(parse(&init_text(&doc.model(), "a \"b\"\\c.glb")).lenses.len(), 2, "{scale} {offset}");
    }
    assert_eq!(parse(&init_text(&Model::default(), "empty.glb")).lenses.len(), 2);
}

#[test]
fn info_of_a_deep_chain_does_not_overflow() {
    let mut doc = Doc::new();
    for n in 1..=50_000 {
        doc.push("nodes", json!({"children": [n]}));
    }
    doc.push("nodes", json!({}));
    doc.json["scenes"][0]["nodes"] = json!([0]);
    let model = doc.model();
    assert!(model.nodes[50_000].drawn);
    assert!(info_text(&model).lines().count() > 50_000);
}
