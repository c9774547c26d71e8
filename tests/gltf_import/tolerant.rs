//! What glTF allows is opened, and so is what can be done without: with a warning that says what is missing.

use std::path::Path;

use lenspeel::cpu;
use lenspeel::plan::Plan;
use lenspeel::scene::{Budget, Model, Scene};
use lenspeel::spec::Spec;
use serde_json::{Value, json};

use super::builder::*;

/// A square, changed; and what is said of it.
fn opened(change: impl FnOnce(&mut Doc)) -> (Model, Vec<String>) {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}, "mode": 6, "material": 0}));
    doc.push("materials", json!({"name": "Bark", "emissiveFactor": [1, 1, 1], "emissiveTexture": {"index": 0}}));
    doc.push("textures", json!({"source": 0}));
    let image = doc.view(&png(image::DynamicImage::new_rgb8(4, 2)));
    doc.push("images", json!({"bufferView": image, "name": "bark"}));
    change(&mut doc);
    let model = doc.model();
    let warnings = model.warnings.clone();
    (model, warnings)
}

fn triangles(model: &Model) -> usize {
    model.meshes.iter().flat_map(|m| &m.primitives).map(|p| p.triangles.len()).sum()
}

#[test]
fn nothing_is_said_of_a_good_file() {
    let (model, warnings) = opened(|_| ());
    assert_eq!((triangles(&model), warnings.len()), (2, 0), "{warnings:?}");
    assert_eq!(model.used_images(), [0]);
}

#[test]
fn a_scene_may_be_empty() {
    let (model, warnings) = opened(|doc| doc.json["scenes"][0] = json!({"name": "nothing"}));
    assert!(!model.nodes[0].drawn && model.bounds().is_empty());
    assert_eq!(warnings, ["there is nothing to see: the scene has none of the file's 1 node"]);
    let bare = load(br#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{}]}"#, None).expect("valid");
    assert_eq!(bare.warnings, ["there is nothing to see: the file has no nodes"]);
}

#[test]
fn whole_numbers_may_be_written_with_a_point() {
    let text = r#"{"asset": {"version": "2.0"}, "scene": 0.0, "scenes": [{"nodes": [0e0]}],
        "nodes": [{"mesh": 0.0, "translation": [1.0, -2.0, 0.5]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0.0}, "mode": 4.0}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126.0, "type": "VEC3", "count": 30e-1, "byteOffset": -0.0}],
        "bufferViews": [{"buffer": 0.0, "byteLength": 0.36e2}],
        "buffers": [{"byteLength": 36.0, "uri": "data:,%00%00%00%00%00%00%00%00%00%00%00%00%00%00%80%3f%00%00%00%00%00%00%00%00%00%00%00%00%00%00%80%3f%00%00%00%00"}]}"#;
    let model = load(text.replace(r#", "byteOffset": -0.0"#, "").as_bytes(), None).expect("valid");
    assert_eq!(triangles(&model), 1);
    assert_eq!(model.nodes[0].world_from_local.translation, glam::dvec3(1.0, -2.0, 0.5));
}

#[test]
fn transforms_have_the_precision_of_the_file() {
    let (model, _) = opened(|doc| {
        for (at, key) in [691_000.1, 691_000.4].into_iter().zip(["translation", "matrix"]) {
            let matrix = json!([1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, at, 0.25, -5_334_000.7, 1]);
            let value = if key == "matrix" { matrix } else { json!([at, 0.25, -5_334_000.7]) };
            doc.node(json!({"mesh": 0, key: value}));
        }
    });
    let place = |node: usize| model.nodes[node].world_from_local.translation;
    assert!((place(1) - glam::dvec3(691_000.1, 0.25, -5_334_000.7)).length() < 1e-9);
    assert!((place(2) - glam::dvec3(691_000.4, 0.25, -5_334_000.7)).length() < 1e-9);
}

#[test]
fn textures_and_images_may_be_missing() {
    let mut short = png(image::DynamicImage::new_rgb8(8, 8));
    short.truncate(60);
    let image = |value: Value| opened(|doc| doc.json["images"] = json!([value]));
    let texture = |value: Value| opened(|doc| doc.json["textures"] = json!([value]));
    let cases = [
        image(json!({"uri": "bark.png"})),
        image(json!({"name": "bark", "uri": data_uri(&short)})),
        image(json!({"uri": data_uri(b"GIF89a and so on")})),
        image(json!({"name": "bark"})),
        image(json!({"uri": "https://example.com/bark.png"})),
        texture(json!({"name": "empty"})),
        texture(json!({"extensions": {"EXT_texture_webp": {"source": 0}}})),
        opened(|doc| doc.json["textures"] = json!([{"source": 0}, {}])),
    ];
    let mut said = String::new();
    for (model, warnings) in &cases[..7] {
        assert_eq!(triangles(model), 2);
        assert!(model.used_images().is_empty(), "{warnings:?}");
        said += &(warnings.join("\n") + "\n");
    }
    // One that no material uses takes nothing away.
    assert_eq!(cases[7].0.used_images(), [0]);
    insta::assert_snapshot!(said);
}

#[test]
fn primitives_without_geometry_are_left_out() {
    let (model, warnings) = opened(|doc| {
        let fan = doc.json["meshes"][0]["primitives"][0].clone();
        let bare = json!({"attributes": {"COLOR_0": 0}});
        let mut packed = fan.clone();
        packed["extensions"] = json!({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}});
        let zeros = doc.push("accessors", json!({"componentType": F32, "type": "VEC3", "count": 3}));
        packed["attributes"]["POSITION"] = json!(zeros);
        doc.json["meshes"][0]["primitives"] = json!([bare, fan, packed, {"attributes": {"COLOR_0": 0}}]);
        doc.json["extensionsUsed"] = json!(["KHR_draco_mesh_compression"]);
    });
    assert_eq!(triangles(&model), 2);
    insta::assert_snapshot!(warnings.join("\n"));
}

#[test]
fn buffers_that_nothing_reads_may_have_no_bytes() {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}, "mode": 6}));
    let mut json: Value = serde_json::from_slice(&doc.gltf()).expect("JSON");
    json["buffers"].as_array_mut().expect("a list").push(json!({"byteLength": 7}));
    let model = load(&serde_json::to_vec(&json).expect("JSON"), None).expect("valid");
    assert_eq!(triangles(&model), 2);
    json["bufferViews"][0]["buffer"] = json!(1);
    let error = load(&serde_json::to_vec(&json).expect("JSON"), None).expect_err("it has no bytes");
    insta::assert_snapshot!(error);
}

#[test]
fn losses_are_told_in_numbers() {
    let (_, warnings) = opened(|doc| {
        let places = doc.floats(&[[0.0; 3]; 125]);
        let copies = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": places}}});
        doc.node(json!({"mesh": 0, "extensions": copies}));
        doc.node(json!({"mesh": 0, "skin": 0}));
        doc.push("skins", json!({"joints": [0]}));
        doc.json["meshes"][0]["primitives"][0]["targets"] = json!([{"POSITION": 0}, {"POSITION": 0}]);
        doc.json["meshes"][0]["weights"] = json!([0.5, 0]);
        doc.json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
    });
    insta::assert_snapshot!(warnings.join("\n"));
}

#[test]
fn extensions_that_are_not_declared_are_read_and_told() {
    let (model, warnings) = opened(|doc| {
        doc.json["materials"][0]["extensions"] = json!({"KHR_materials_unlit": {}, "KHR_materials_sheen": {}});
        doc.json["nodes"][0]["extras"] = json!({"extensions": {"NOT_an_extension": {}}});
    });
    assert!(model.materials[0].unlit);
    insta::assert_snapshot!(warnings.join("\n"));
}

#[test]
fn hidden_nodes_are_hidden_with_all_below_them() {
    let (model, warnings) = opened(|doc| {
        let child = doc.push("nodes", json!({"name": "Below", "mesh": 0, "translation": [9, 0, 0]}));
        let hidden = json!({"KHR_node_visibility": {"visible": false}});
        doc.node(json!({"name": "Off", "mesh": 0, "children": [child], "extensions": hidden}));
        doc.node(json!({"name": "On", "mesh": 0, "extensions": {"KHR_node_visibility": {"visible": true}}}));
        doc.json["extensionsUsed"] = json!(["KHR_node_visibility"]);
        doc.json["extensionsRequired"] = json!(["KHR_node_visibility"]);
    });
    assert!(warnings.is_empty(), "{warnings:?}");
    let hidden: Vec<bool> = model.nodes.iter().map(|node| node.hidden).collect();
    assert_eq!(hidden, [false, true, true, false]);
    assert!(model.nodes.iter().all(|node| node.drawn));
    assert_eq!(model.bounds().max.x, 1.0);
    let text = "[scene]\nfile = 'm.glb'\n[[lens]]\nname = 'look'\nshape.sphere = { center = [0, 0, 0], radius = 9 }\n\
        filters = [{ show = { nodes = ['Off'] } }]\n";
    let spec = Spec::parse(text, "s.toml", Path::new("")).expect("a spec");
    let scene = Scene::new(vec![model], vec![]);
    let plan = Plan::new(&spec, &scene).expect("a plan");
    let nodes =
        |content| plan.items.iter().filter(|item| item.content == content).map(|item| item.node).collect::<Vec<_>>();
    assert_eq!((nodes(0), nodes(1)), (vec![0, 3], vec![1, 2]));
}

#[test]
fn copies_that_the_cpu_could_not_hold_are_refused_with_numbers() {
    let (model, _) = opened(|doc| {
        for n in 0..999 {
            doc.node(json!({"mesh": 0, "translation": [n, 0, 0]}));
        }
    });
    let spec = Spec::parse("[scene]\nfile = 'm.glb'\n", "s.toml", Path::new("")).expect("a spec");
    let mut scene = Scene::new(vec![model], vec![]);
    let plan = Plan::new(&spec, &scene).expect("a plan");
    assert!(cpu::check_memory(&scene, &plan).is_ok());
    scene.budget = Budget::new(500_000);
    let error = cpu::Renderer::new(&scene, &plan).err().expect("2,000 triangles take more").to_string();
    assert!(error.contains("of 2000 triangles (2 in the files, nodes copy them)"), "{error}");
    assert!(error.contains("it takes about 585.9 KiB of memory, the limit is 488.3 KiB"), "{error}");
}

#[test]
fn one_warning_a_kind() {
    let (_, warnings) = opened(|doc| {
        let points = json!({"attributes": {"POSITION": 0}, "mode": 0});
        for _ in 0..1000 {
            doc.push("meshes", json!({"primitives": [points]}));
        }
    });
    assert_eq!(warnings, ["mesh 1, primitive 0 and 999 more: points left out, only triangles are drawn"]);
}
