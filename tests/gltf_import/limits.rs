//! What a file may take and reach.

use std::fs;
use std::path::{Path, PathBuf};

use lenspeel::cli::{InfoChoice, info_json, info_text};
use lenspeel::scene::{Model, OpenOptions, Scene};
use lenspeel::spec::{Pattern, Spec};
use serde_json::{Value, json};

use super::builder::*;

/// An empty folder for one test.
fn folder(name: &str) -> PathBuf {
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("gltf_import").join(name);
    let _ = fs::remove_dir_all(&path);
    fs::create_dir_all(path.join("models/parts")).expect("the build folder takes a folder");
    path
}

/// A square whose buffer is at a URI.
fn beside(uri: &str) -> (Vec<u8>, Vec<u8>) {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}, "mode": 6}));
    doc.json["buffers"] = json!([{"byteLength": doc.bin.len(), "uri": uri}]);
    (serde_json::to_vec(&doc.json).expect("JSON"), doc.bin)
}

#[test]
fn buffers_lie_in_the_folder_of_the_model() {
    let folder = folder("outside");
    let model = folder.join("models/m.gltf");
    let load = |uri: &str, allow_outside: bool| {
        let (json, bin) = beside(uri);
        fs::write(&model, json).expect("written");
        for place in ["secret.bin", "models/in.bin", "models/parts/in.bin"] {
            fs::write(folder.join(place), &bin).expect("written");
        }
        let options = OpenOptions { allow_outside, ..OpenOptions::default() };
        Model::load_with(&model, None, &options).map(|_| ()).map_err(|error| error.to_string())
    };
    for inside in ["in.bin", "parts/in.bin", "./parts/../in.bin", "%69n.bin"] {
        assert_eq!(load(inside, false), Ok(()), "{inside}");
    }
    let absolute = folder.join("secret.bin").display().to_string();
    for outside in ["../secret.bin", "%2e%2e/secret.bin", "..%2Fsecret.bin", "parts/../../secret.bin", &absolute] {
        let error = load(outside, false).expect_err(outside);
        assert!(error.contains("buffer 0: `") && error.contains("leads out of the folder of the model"), "{error}");
        assert!(error.contains("--allow-outside"), "{error}");
        assert_eq!(load(outside, true), Ok(()), "{outside}");
    }
    // Whether something is there is not told either.
    assert!(load("../no-such-file", false).expect_err("outside").contains("leads out"));
}

#[cfg(unix)]
#[test]
fn links_do_not_lead_out_of_the_folder() {
    let folder = folder("links");
    let (json, bin) = beside("link.bin");
    fs::write(folder.join("models/m.gltf"), json).expect("written");
    let options = |allow_outside| OpenOptions { allow_outside, ..OpenOptions::default() };
    let load = |allow| Model::load_with(&folder.join("models/m.gltf"), None, &options(allow));
    let link = folder.join("models/link.bin");
    for (target, inside) in [("models/parts/in.bin", true), ("secret.bin", false)] {
        fs::write(folder.join(target), &bin).expect("written");
        let _ = fs::remove_file(&link);
        std::os::unix::fs::symlink(folder.join(target), &link).expect("linked");
        assert_eq!(load(false).is_ok(), inside, "{target}");
        assert!(load(true).is_ok());
    }
}

/// Fans over one accessor without bytes: small on disk, large in memory.
fn zero_fans(primitives: usize, vertices: u64) -> Vec<u8> {
    let mut doc = Doc::new();
    let zeros = doc.push("accessors", json!({"componentType": F32, "type": "VEC3", "count": vertices}));
    let fan = json!({"attributes": {"POSITION": zeros}, "mode": 6});
    doc.push("meshes", json!({"name": "Fan", "primitives": vec![fan; primitives]}));
    doc.node(json!({"mesh": 0}));
    doc.gltf()
}

#[test]
fn memory_is_counted_before_it_is_taken() {
    let path = folder("memory").join("fans.gltf");
    let load =
        |memory_limit: u64| Model::load_with(&path, None, &OpenOptions { memory_limit, ..OpenOptions::default() });
    fs::write(&path, zero_fans(1000, 1 << 22)).expect("written");
    let error = load(OpenOptions::MEMORY_LIMIT).expect_err("more than 8 GiB");
    let parts = [
        "mesh 0 `Fan`, primitive",
        "with 4194304 vertices and 4194302 triangles",
        "the limit is 8.0 GiB",
        "--memory-limit",
    ];
    parts.iter().for_each(|part| assert!(error.to_string().contains(part), "{part}: {error}"));
    fs::write(&path, zero_fans(10, 1000)).expect("written");
    assert!(load(1 << 20).is_ok());
    assert!(load(100_000).is_err());
    assert!(load(1).is_err());
}

#[test]
fn what_filters_and_mesh_lenses_compute_counts_before_it_is_computed() {
    let path = folder("computed").join("fan.gltf");
    fs::write(&path, zero_fans(1, 60_000)).expect("written");
    let path = path.display().to_string();
    let ball = "sphere = { center = [0, 0, 0], radius = 1 }".to_owned();
    for (shape, filter, part) in [
        (&ball, "'wireframe'", "what lies across the edges of 59998 triangles, for wires: it takes about"),
        (&ball, "'curvature'", "curvature at 60000 vertices: it takes about"),
        (&ball, "'lod'", "1 simplified version of 59998 triangles: it takes about"),
        (&format!("mesh = {{ file = {path:?} }}"), "'invert'", "a lens of 59998 triangles of"),
    ] {
        let text = format!("[scene]\nfile = {path:?}\n[[lens]]\nname = 'a'\nshape.{shape}\nfilters = [{filter}]\n");
        let spec = Spec::parse(&text, "a test", Path::new("")).expect("a spec");
        let options = OpenOptions { memory_limit: 6 << 20, ..OpenOptions::default() };
        let error = Scene::open_with(&spec, &options).expect_err("it takes more").to_string();
        assert!(error.contains(part) && error.contains("the limit is 6.0 MiB"), "{error}");
    }
}

#[test]
fn images_count_before_they_are_decoded() {
    let path = folder("images").join("m.gltf");
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}, "mode": 6, "material": 0}));
    doc.push("materials", json!({"emissiveTexture": {"index": 0}}));
    doc.push("textures", json!({"source": 0}));
    let image = doc.view(&png(image::DynamicImage::new_luma8(1000, 1000)));
    doc.push("images", json!({"bufferView": image, "name": "dark"}));
    fs::write(&path, doc.gltf()).expect("written");
    let load =
        |memory_limit: u64| Model::load_with(&path, None, &OpenOptions { memory_limit, ..OpenOptions::default() });
    let error = load(8 << 20).expect_err("a million pixels take more").to_string();
    assert!(error.contains("image 0 `dark`, with 1000 x 1000 pixels: it takes about 15.3 MiB of memory"), "{error}");
    assert_eq!(load(32 << 20).expect("it fits").images[0].width, 1000);
}

#[test]
fn images_that_do_not_decode_count_no_more() {
    // Each claims so many pixels that two of them would be too many, and ends before they come.
    let whole = png(image::DynamicImage::new_luma8(1000, 1000));
    let torn = [&whole[..whole.len() / 2], b"torn"].concat();
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}, "mode": 6, "material": 0}));
    doc.push("materials", json!({"emissiveTexture": {"index": 0}}));
    doc.push("textures", json!({"source": 0}));
    let image = doc.view(&torn);
    doc.push("images", json!({"bufferView": image, "name": "torn"}));
    let torn_alone = folder("torn").join("m.gltf");
    fs::write(&torn_alone, doc.gltf()).expect("written");
    let text = format!(
        "[scene]\nfile = {path:?}\n[scene.alternates]\na = {path:?}\nb = {path:?}\n",
        path = torn_alone.display().to_string()
    );
    let spec = Spec::parse(&text, "a test", Path::new("")).expect("a spec");
    let options = OpenOptions { memory_limit: 24 << 20, ..OpenOptions::default() };
    let scene = Scene::open_with(&spec, &options).expect("the pixels of the first are given back");
    assert!(scene.models.iter().all(|model| model.warnings.iter().any(|line| line.contains("torn"))));
}

#[test]
fn long_and_hostile_names_are_printed_safely() {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position, "NORMAL": position}, "mode": 6}));
    doc.json["nodes"][0]["name"] = json!("x".repeat(65_536));
    doc.node(json!({"name": "red\u{1b}[31m\nline"}));
    doc.push("materials", json!({"name": "m\u{7}"}));
    let model = doc.model();
    for all in [false, true] {
        let text = info_text(&model, &InfoChoice { all, patterns: vec![] });
        assert!(!text.contains(|c: char| c.is_control() && c != '\n'), "{text}");
        assert!(text.contains("red\\u{1b}[31m\\u{a}line") && text.contains("m\\u{7}"), "{text}");
        assert_eq!(text.contains(&"x".repeat(65_536)), all);
        assert!(all || text.contains("... (65536 characters)"));
    }
    doc.json["nodes"][1]["scale"] = json!([1e300, 1, 1]);
    doc.json["nodes"][1]["children"] = json!([2]);
    doc.push("nodes", json!({"scale": [1e300, 1, 1], "name": "\u{9b}31m"}));
    let error = doc.load().expect_err("too large").to_string();
    assert!(!error.contains(char::is_control) && error.contains("\\u{9b}31m"), "{error}");
}

/// A car with 60 bolts in a chassis, and wheels.
fn car() -> Model {
    let mut doc = Doc::new();
    let position = doc.square();
    doc.show(json!({"attributes": {"POSITION": position}, "mode": 6, "material": 0}));
    doc.push("materials", json!({"name": "Steel"}));
    let bolts: Vec<usize> =
        (0..60).map(|n| doc.push("nodes", json!({"name": format!("Bolt.{n:03}"), "mesh": 0}))).collect();
    let odd: Vec<usize> = (0..60)
        .map(|n| doc.push("nodes", json!({"name": format!("{}part", char::from_u32(0x410 + n).expect("a letter"))})))
        .collect();
    let parts = [bolts, odd].concat();
    doc.node(json!({"name": "Chassis", "children": parts}));
    doc.model()
}

#[test]
fn info_shows_the_names_that_specs_select_by() {
    let model = car();
    let text = info_text(&model, &InfoChoice::default());
    assert!(text.contains("Bolt.*") && text.contains("60 nodes") && !text.contains("Bolt.059"), "{text}");
    assert!(text.contains("--all"), "{text}");
    let all = info_text(&model, &InfoChoice { all: true, patterns: vec![] });
    assert!(all.contains("Bolt.059") && !all.contains("more nodes"), "{all}");
    let of = |pattern: &str| InfoChoice { all: false, patterns: vec![Pattern::new(pattern)] };
    let some = info_text(&model, &of("Bolt.05?"));
    assert_eq!(some.matches("Chassis/").count(), 10, "{some}");
    assert!(some.contains("open") && !some.contains("Steel"), "{some}");
    assert!(info_text(&model, &of("Steel")).contains("materials"));
    assert!(info_text(&model, &of("chassis")).contains("no node and no material"));
    let json: Value = info_json(&model, &InfoChoice::default());
    assert_eq!(json["nodes"].as_array().map(Vec::len), Some(122));
    assert_eq!((&json["nodes"][60]["name"], &json["nodes"][60]["parent"]), (&json!("Bolt.059"), &json!(121)));
    assert_eq!((&json["meshes"][0]["closed"], &json["triangles_shown"]), (&json!(false), &json!(122)));
    assert_eq!(info_json(&model, &of("Bolt.05?"))["nodes"].as_array().map(Vec::len), Some(10));
}
