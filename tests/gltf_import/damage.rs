//! Damaged bytes end in an error or a model, never in a panic.

use lenspeel::cli::InfoChoice;
use lenspeel::scene::Model;
use serde_json::{Value, json};

use super::builder::*;

/// A GLB with everything the loader reads.
fn rich() -> Vec<u8> {
    let mut doc = Doc::new();
    let position = doc.square();
    let normal = doc.floats(&[[0.0, 0.0, 1.0]; 4]);
    let tangent = doc.floats(&[[1.0, 0.0, 0.0, 1.0]; 4]);
    let uv = doc.floats(&[[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
    let color = doc.accessor(&[9; 16], U8, "VEC4", 4);
    let indices = doc.accessor(&[0, 1, 2, 0, 2, 3], U8, "SCALAR", 6);
    let (places, values) = (doc.view(&[1]), doc.view(&float_bytes(&[[1.0, 0.0, 0.5]])));
    doc.json["accessors"][position]["sparse"] = json!({
        "count": 1, "indices": {"bufferView": places, "componentType": U8}, "values": {"bufferView": values}});
    let image = doc.view(&png(image::DynamicImage::new_rgba8(4, 4)));
    doc.push("images", json!({"bufferView": image, "mimeType": "image/png"}));
    doc.push("textures", json!({"source": 0}));
    let slot = json!({"index": 0, "extensions": {"KHR_texture_transform": {"rotation": 1}}});
    doc.push(
        "materials",
        json!({"pbrMetallicRoughness": {"baseColorTexture": slot}, "normalTexture": slot, "alphaMode": "MASK"}),
    );
    doc.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [{"type": "point"}]}});
    doc.push("cameras", json!({"type": "perspective", "perspective": {"yfov": 1, "znear": 0.5}}));
    doc.show(json!({
        "attributes": {"POSITION": position, "NORMAL": normal, "TANGENT": tangent, "TEXCOORD_0": uv, "COLOR_0": color},
        "indices": indices, "material": 0
    }));
    let parts = json!({"children": [0], "camera": 0, "extensions": {"KHR_lights_punctual": {"light": 0}}});
    let top = doc.push("nodes", parts);
    doc.json["scenes"][0]["nodes"] = json!([top]);
    let (input, output) = (doc.floats(&[[0.0f32], [1.0]]), doc.floats(&[[0.0; 3]; 6]));
    let sampler = json!({"input": input, "output": output, "interpolation": "CUBICSPLINE"});
    let channel = json!({"sampler": 0, "target": {"node": top, "path": "translation"}});
    doc.push("animations", json!({"samplers": [sampler], "channels": [channel]}));
    doc.glb()
}

/// Whether it loads; what loads keeps the promises that the rest of the program builds on.
fn survives(bytes: &[u8]) -> bool {
    let Ok(model) = load(bytes, None) else { return false };
    keeps_promises(&model);
    true
}

fn keeps_promises(model: &Model) {
    for primitive in model.meshes.iter().flat_map(|m| &m.primitives) {
        let count = primitive.positions.len();
        assert!(primitive.positions.iter().all(|p| p.is_finite()));
        assert!(primitive.triangles.iter().flatten().all(|i| (*i as usize) < count));
        assert!(primitive.normals.iter().flatten().all(|n| n.is_normalized()));
        assert!(primitive.material < model.materials.len());
    }
    for (index, node) in model.nodes.iter().enumerate() {
        assert!(node.world_from_local.is_finite());
        assert!(node.children.iter().all(|c| model.nodes[*c].parent == Some(index)));
        assert!(node.mesh.is_none_or(|m| m < model.meshes.len()));
    }
    assert!(model.images.iter().all(|i| i.pixels.len() as u64 == u64::from(i.width) * u64::from(i.height)));
    let mut moved = model.clone();
    if moved.pose(Some(0.5)).is_ok() {
        assert!(moved.nodes.iter().all(|node| node.world_from_local.is_finite()));
    }
    let _ = lenspeel::cli::info_text(model, &InfoChoice::default());
    let _ = lenspeel::cli::init_text(model, "model.glb");
}

#[test]
fn every_cut_is_an_error() {
    let whole = rich();
    assert!(survives(&whole));
    for length in 0..whole.len() {
        assert!(!survives(&whole[..length]), "cut to {length} bytes it still loads");
    }
}

#[test]
fn flipped_bits_never_panic() {
    let whole = rich();
    // xorshift64: the same damage in every run.
    let mut state = 0x9e37_79b9_7f4a_7c15u64;
    let mut random = |below: usize| {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state % below as u64) as usize
    };
    let (mut loaded, mut refused) = (0, 0);
    for _ in 0..3000 {
        let mut bytes = whole.clone();
        for _ in 0..=random(4) {
            let at = random(bytes.len());
            bytes[at] ^= 1 << random(8);
        }
        if survives(&bytes) { loaded += 1 } else { refused += 1 }
    }
    assert!(loaded > 100 && refused > 100, "{loaded} loaded, {refused} refused: the damage is too weak or too strong");
}

#[test]
fn numbers_in_the_json_replaced_by_extremes_never_panic() {
    let whole = rich();
    let length = u32::from_le_bytes(whole[12..16].try_into().expect("four bytes")) as usize;
    let text = std::str::from_utf8(&whole[20..20 + length]).expect("JSON");
    let bin = &whole[20 + length + 8..];
    let numbers = text.char_indices().filter(|(at, c)| c.is_ascii_digit() && text.as_bytes()[at - 1] == b':');
    let mut tried = 0;
    for (at, _) in numbers {
        let end = at + text[at..].find([',', '}', ']']).expect("JSON ends in a brace");
        for value in ["0", "1", "7", "255", "4294967295", "18446744073709551615", "-1", "1e300"] {
            let changed = format!("{}{value}{}", &text[..at], &text[end..]);
            let mut json: serde_json::Value = serde_json::from_str(&changed).expect("still JSON");
            let name = super::builder::data_uri(bin);
            if let Some(buffer) = json["buffers"].get_mut(0) {
                buffer["uri"] = json!(name);
            }
            survives(&serde_json::to_vec(&json).expect("JSON"));
            tried += 1;
        }
    }
    assert!(tried > 300, "only {tried}");
}

/// Every place in some JSON, as a pointer.
fn places(value: &Value, here: &str, found: &mut Vec<String>) {
    found.push(here.to_string());
    match value {
        Value::Array(items) => items.iter().enumerate().for_each(|(i, v)| places(v, &format!("{here}/{i}"), found)),
        Value::Object(entries) => entries.iter().for_each(|(key, v)| places(v, &format!("{here}/{key}"), found)),
        _ => {}
    }
}

#[test]
fn values_in_the_json_replaced_by_other_kinds_never_panic() {
    let whole = rich();
    let length = u32::from_le_bytes(whole[12..16].try_into().expect("four bytes")) as usize;
    let mut json: Value = serde_json::from_slice(&whole[20..20 + length]).expect("JSON");
    json["buffers"][0]["uri"] = json!(data_uri(&whole[20 + length + 8..]));
    json["extensionsUsed"] = json!(["KHR_lights_punctual", "EXT_mesh_gpu_instancing"]);
    json["nodes"][0]["extensions"] = json!({
        "KHR_node_visibility": {"visible": true}, "EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}});
    json["meshes"][0]["weights"] = json!([0.5]);
    json["nodes"][0]["skin"] = json!(0);
    json["skins"] = json!([{"joints": [0]}]);
    let hostile = [
        json!(null),
        json!(true),
        json!(-1),
        json!(1e308),
        json!(u64::MAX),
        json!(4_000_000_000u64),
        json!("\u{1b}[2J../../x"),
        json!([]),
        json!({}),
        json!([[[[]]], null, {"a": {}}]),
        json!({"extensions": {"KHR_texture_transform": {"offset": "x"}, "KHR_node_visibility": 7}}),
    ];
    let mut all = Vec::new();
    places(&json, "", &mut all);
    let mut loaded = 0;
    for place in all.iter().filter(|place| !place.is_empty()) {
        for value in &hostile {
            let mut changed = json.clone();
            *changed.pointer_mut(place).expect("a place of it") = value.clone();
            loaded += usize::from(survives(&serde_json::to_vec(&changed).expect("JSON")));
        }
    }
    assert!(all.len() > 150 && loaded > 100, "{} places, {loaded} loaded", all.len());
}
