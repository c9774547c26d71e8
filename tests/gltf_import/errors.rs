//! What is wrong with a file is said in one sentence that names the place. The texts are a snapshot.

use serde_json::{Value, json};

use super::builder::*;

/// A valid square whose JSON is then broken.
fn broken(change: impl Fn(&mut Value)) -> Vec<u8> {
    let mut doc = Doc::new();
    let position = doc.square();
    let indices = doc.accessor(&[0, 1, 2, 0, 2, 3], U8, "SCALAR", 6);
    doc.show(json!({"attributes": {"POSITION": position}, "indices": indices}));
    doc.node(json!({"name": "Other", "mesh": 0}));
    change(&mut doc.json);
    doc.gltf()
}

/// A material with one texture, whose image is given.
fn with_image(image: Value) -> Vec<u8> {
    broken(|json| {
        json["images"] = json!([image]);
        json["textures"] = json!([{"source": 0}]);
        json["materials"] = json!([{"emissiveTexture": {"index": 0}}]);
    })
}

fn with_light(light: Value) -> Vec<u8> {
    broken(|json| json["extensions"] = json!({"KHR_lights_punctual": {"lights": [light]}}))
}

fn with_camera(camera: Value) -> Vec<u8> {
    broken(|json| json["cameras"] = json!([{"type": "perspective", "perspective": camera}]))
}

/// Everything wrong we can think of, by a name.
fn cases() -> Vec<(&'static str, Vec<u8>)> {
    let mut nan = Doc::new();
    let position = nan.floats(&[[0.0, 0.0, 0.0], [f32::NAN, 0.0, 0.0], [0.0, 1.0, f32::INFINITY]]);
    nan.show(json!({"attributes": {"POSITION": position}}));
    let mut cases = structure_cases();
    cases.extend(accessor_cases());
    cases.extend([
        ("not-finite-position", nan.gltf()),
        ("image-outside", with_image(json!({"uri": "%2e%2e/bark.png"}))),
        (
            "spot-light-inside-out",
            with_light(json!({"type": "spot", "spot": {"innerConeAngle": 1, "outerConeAngle": 0.5}})),
        ),
        ("light-of-no-type", with_light(json!({"type": "laser"}))),
        ("camera-without-depth", with_camera(json!({"yfov": 1, "znear": 2, "zfar": 1}))),
        ("camera-without-view", with_camera(json!({"yfov": 0, "znear": 2}))),
    ]);
    cases
}

fn structure_cases() -> Vec<(&'static str, Vec<u8>)> {
    let required = json!(["KHR_draco_mesh_compression", "KHR_mesh_quantization"]);
    vec![
        ("empty", vec![]),
        ("not-json", b"solid cube".to_vec()),
        ("glb-header-only", b"glTF\x02\0\0\0\x03\0\0\0".to_vec()),
        ("glb-cut-short", Doc::new().glb()[..40].to_vec()),
        ("glb-version-1", b"glTF\x01\0\0\0\x14\0\0\0________".to_vec()),
        ("version-1-in-lists", broken(|json| json["asset"]["version"] = json!("1.0"))),
        ("version-1", br#"{"meshes": {"mesh_0": {"primitives": []}}, "scene": "main"}"#.to_vec()),
        ("version-3", broken(|json| json["asset"]["version"] = json!("3.0"))),
        ("no-version", broken(|json| json["asset"] = json!({}))),
        ("half-an-index", broken(|json| json["nodes"][0]["mesh"] = json!(0.5))),
        ("another-kind-of-file", b"ply\nformat ascii 1.0\n".to_vec()),
        ("another-kind-of-json", br#"{"type": "CityJSON", "version": "1.1"}"#.to_vec()),
        ("a-web-page", b"<!DOCTYPE html><html>404</html>".to_vec()),
        ("required-extension", broken(|json| json["extensionsRequired"] = required.clone())),
        ("own-child", broken(|json| json["nodes"][0]["children"] = json!([0]))),
        (
            "node-cycle",
            broken(|json| {
                json["nodes"][0]["children"] = json!([1]);
                json["nodes"][1]["children"] = json!([0]);
            }),
        ),
        (
            "two-parents",
            broken(|json| {
                json["nodes"][0]["children"] = json!([2]);
                json["nodes"][1]["children"] = json!([2]);
                json["nodes"].as_array_mut().expect("a list").push(json!({"name": "Child"}));
            }),
        ),
        (
            "node-too-large",
            broken(|json| {
                json["nodes"][0]["scale"] = json!([1e300, 1, 1]);
                json["nodes"][0]["children"] = json!([1]);
                json["nodes"][1]["scale"] = json!([1e300, 1, 1]);
            }),
        ),
        ("three-numbers-of-a-quaternion", broken(|json| json["nodes"][0]["rotation"] = json!([0, 0, 1]))),
        (
            "copies-that-are-required",
            broken(|json| {
                json["nodes"][0]["extensions"] = json!({"EXT_mesh_gpu_instancing": {"attributes": {"TRANSLATION": 0}}});
                json["extensionsUsed"] = json!(["EXT_mesh_gpu_instancing"]);
                json["extensionsRequired"] = json!(["EXT_mesh_gpu_instancing"]);
            }),
        ),
        ("mesh-out-of-range", broken(|json| json["nodes"][0]["mesh"] = json!(5))),
        ("scene-out-of-range", broken(|json| json["scene"] = json!(5))),
        ("material-out-of-range", broken(|json| json["meshes"][0]["primitives"][0]["material"] = json!(0))),
        ("unknown-mode", broken(|json| json["meshes"][0]["primitives"][0]["mode"] = json!(9))),
    ]
}

fn accessor_cases() -> Vec<(&'static str, Vec<u8>)> {
    let accessor = |index: usize, key: &'static str, value: Value| {
        broken(move |json| json["accessors"][index][key] = value.clone())
    };
    vec![
        (
            "position-out-of-range",
            broken(|json| {
                json["meshes"][0]["primitives"][0]["attributes"]["POSITION"] = json!(77);
            }),
        ),
        (
            "attribute-too-short",
            broken(|json| {
                json["accessors"]
                    .as_array_mut()
                    .expect("a list")
                    .push(json!({"bufferView": 0, "componentType": F32, "type": "VEC3", "count": 2}));
                json["meshes"][0]["primitives"][0]["attributes"]["NORMAL"] = json!(2);
            }),
        ),
        ("index-past-the-vertices", accessor(0, "count", json!(3))),
        ("four-billion-vertices", accessor(0, "count", json!(4_000_000_000u64))),
        ("one-vertex-too-many", accessor(0, "count", json!(5))),
        ("count-beyond-all-bounds", accessor(0, "count", json!(u64::MAX))),
        (
            "a-hundred-million-zeros",
            broken(|json| {
                json["accessors"][0] = json!({"componentType": F32, "type": "VEC3", "count": 100_000_000});
            }),
        ),
        ("offset-beyond-all-bounds", accessor(0, "byteOffset", json!(u64::MAX))),
        ("float-indices", accessor(1, "componentType", json!(F32))),
        ("scalar-positions", accessor(0, "type", json!("SCALAR"))),
        ("integer-positions", accessor(0, "componentType", json!(U32))),
        ("view-beyond-its-buffer", broken(|json| json["bufferViews"][0]["byteLength"] = json!(1000))),
        ("view-beyond-all-bounds", broken(|json| json["bufferViews"][0]["byteOffset"] = json!(u64::MAX))),
        ("stride-below-element", broken(|json| json["bufferViews"][0]["byteStride"] = json!(8))),
        (
            "sparse-index-out-of-range",
            broken(|json| {
                json["accessors"][0]["sparse"] = json!({
                    "count": 1,
                    "indices": {"bufferView": 1, "byteOffset": 5, "componentType": U8},
                    "values": {"bufferView": 0},
                });
                json["accessors"][0]["count"] = json!(3);
            }),
        ),
    ]
}

#[test]
fn each_fault_is_named() {
    let mut texts = String::new();
    for (name, bytes) in cases() {
        let error = load(&bytes, None).err().map(|e| e.to_string());
        let error = error.unwrap_or_else(|| panic!("{name} loads"));
        texts.push_str(&format!("{name}\n    {error}\n"));
    }
    insta::assert_snapshot!(texts);
}

#[test]
fn the_unbroken_file_loads() {
    let model = load(&broken(|_| ()), None).expect("valid");
    assert_eq!(model.meshes[0].primitives[0].triangles.len(), 2);
}

#[test]
fn buffers_must_be_whole() {
    let text = |buffer: Value| {
        let mut doc = Doc::new();
        doc.json["buffers"] = json!([buffer]);
        doc.load().expect_err("a bad buffer").to_string()
    };
    insta::assert_snapshot!(
        [
            text(json!({"byteLength": 5, "uri": "data:application/octet-stream;base64,AAEC"})),
            text(json!({"byteLength": 5, "uri": "data:application/octet-stream;base64,A?"})),
            text(json!({"byteLength": 5, "uri": "missing.bin", "name": "geometry"})),
            text(json!({"byteLength": 5, "uri": "/etc/hostname"})),
        ]
        .join("\n")
    );
}

#[test]
fn a_missing_file_is_named() {
    let error = lenspeel::scene::Model::load(std::path::Path::new("no/such/model.glb"), None).expect_err("missing");
    assert!(error.message.starts_with("cannot read no/such/model.glb: "), "{error}");
    let folder = lenspeel::scene::Model::load(std::path::Path::new("src"), None).expect_err("a folder");
    assert_eq!(folder.message, "cannot read src: not a file");
}
