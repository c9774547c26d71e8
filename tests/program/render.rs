//! `lenspeel render`.

use std::collections::BTreeSet;
use std::fs;

use exr::prelude::read_first_flat_layer_from_file;

use crate::call::{Call, Folder, call, call_with, project};

const SPEC: &str = "lens-specs/overlap/three-spheres.toml";
const SIZE: [u32; 2] = [48, 36];
/// Maps of floats are written in tiles of 64 pixels a side: so many that threads finish them in any order.
const MANY_TILES: &str = "400x300";
const MAPS: [(&str, &str); 5] = [
    ("region", "region.png"),
    ("depth", "depth.exr"),
    ("normal", "normal.exr"),
    ("node", "node.png"),
    ("layers", "layers.png"),
];

/// Renders with the CPU backend, all maps and statistics.
fn render_all(folder: &Folder, size: &str, threads: Option<&str>) -> Call {
    let (spec, picture, stats) = (project(SPEC), folder.file("picture.png"), folder.file("stats.json"));
    let maps: Vec<String> = MAPS.iter().map(|(name, file)| format!("{name}={}", folder.file(file))).collect();
    let mut arguments = vec!["render", &spec, "-o", &picture, "--size", size, "--backend", "cpu", "--stats", &stats];
    maps.iter().for_each(|map| arguments.extend(["--aov", map]));
    call_with(&arguments, |command| {
        if let Some(threads) = threads {
            command.env("RAYON_NUM_THREADS", threads);
        }
    })
}

fn png(folder: &Folder, name: &str) -> image::DynamicImage {
    image::load_from_memory(&folder.read(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
}

/// The channels of an EXR file by name.
fn exr(folder: &Folder, name: &str) -> Vec<(String, Vec<f32>)> {
    let image = read_first_flat_layer_from_file(folder.file(name)).unwrap_or_else(|error| panic!("{name}: {error}"));
    let layer = image.layer_data;
    assert_eq!([layer.size.width(), layer.size.height()], SIZE.map(|side| side as usize), "{name}");
    let channels = layer.channel_data.list.into_iter();
    channels.map(|c| (c.name.to_string(), c.sample_data.values_as_f32().collect())).collect()
}

#[test]
fn a_picture_its_maps_and_its_statistics_are_written() {
    let folder = Folder::new("render-all");
    render_all(&folder, "48x36", None).good();
    let mut files = vec!["picture.png", "region.json", "stats.json"];
    files.extend(MAPS.map(|(_, file)| file));
    files.sort_unstable();
    assert_eq!(folder.names(), files, "all that was asked for and nothing else");

    let picture = png(&folder, "picture.png");
    assert_eq!([picture.width(), picture.height()], SIZE);
    assert!(picture.color().bytes_per_pixel() == 4, "the picture is RGBA of 8 bits");

    let stats = folder.json("stats.json");
    assert_eq!(stats["size"], serde_json::json!(SIZE));
    assert_eq!((&stats["backend"], &stats["reason"]), (&"cpu".into(), &"it was asked for".into()));
    assert_eq!(stats["lenses"], 3);
    assert_eq!(stats["triangles"], 972);
    assert!(stats["seconds"]["render"].as_f64().is_some_and(|seconds| seconds > 0.0), "{stats}");
}

#[test]
fn the_maps_agree_with_each_other() {
    let folder = Folder::new("render-maps");
    render_all(&folder, "48x36", None).good();
    let gray = |name: &str| {
        let map = png(&folder, name);
        assert_eq!(map.color(), image::ColorType::L16, "{name}");
        map.into_luma16().into_raw()
    };
    let (region, node, layers) = (gray("region.png"), gray("node.png"), gray("layers.png"));
    let [(channel, depth)] = &exr(&folder, "depth.exr")[..] else { panic!("one channel of depth") };
    assert_eq!(channel, "Z");
    let normal = exr(&folder, "normal.exr");
    assert_eq!(normal.iter().map(|(name, _)| name.as_str()).collect::<Vec<_>>(), ["B", "G", "R"]);
    for at in 0..region.len() {
        let nothing = region[at] == u16::MAX;
        assert_eq!(nothing, node[at] == 0, "pixel {at}");
        assert_eq!(nothing, depth[at] == f32::INFINITY, "pixel {at}");
        let length = normal.iter().map(|(_, axis)| axis[at] * axis[at]).sum::<f32>().sqrt();
        assert!((length - if nothing { 0.0 } else { 1.0 }).abs() < 1e-3, "pixel {at}: a normal of length {length}");
        assert!(layers[at] >= 1, "pixel {at}");
    }
    let table = folder.json("region.json");
    let listed: BTreeSet<u64> = table.as_array().expect("a list").iter().filter_map(|r| r["id"].as_u64()).collect();
    let found: BTreeSet<u64> =
        region.iter().filter(|id| ![0, u16::MAX].contains(id)).map(|id| u64::from(*id)).collect();
    assert_eq!(listed, found);
    assert_eq!(found.len(), 7, "three spheres that all overlap make seven regions");
    assert_eq!(table[1]["lenses"], serde_json::json!(["a", "b"]));
    let stack = serde_json::json!([{ "lens": "a", "filter": "tint" }, { "lens": "b", "filter": "tint" }]);
    assert_eq!(table[1]["stack"], stack);
}

#[test]
fn every_run_writes_the_same_bytes_whatever_the_number_of_threads() {
    let first = Folder::new("render-first");
    render_all(&first, MANY_TILES, None).good();
    for (test, threads) in [("render-again", None), ("render-1", Some("1")), ("render-2", Some("2"))] {
        let other = Folder::new(test);
        render_all(&other, MANY_TILES, threads).good();
        for name in first.names().iter().filter(|name| *name != "stats.json") {
            assert!(first.read(name) == other.read(name), "{name} differs between {test} and the first run");
        }
    }
}

#[test]
fn size_and_samples_of_the_spec_hold_unless_others_are_given() {
    let folder = Folder::new("render-size");
    let (spec, picture) = (project("lens-specs/image/tall.toml"), folder.file("a.png"));
    call(&["render", &spec, "-o", &picture, "--backend", "cpu"]).good();
    let tall = png(&folder, "a.png");
    assert_eq!([tall.width(), tall.height()], [54, 128]);
    let smooth = folder.file("b.png");
    call(&["render", &spec, "-o", &smooth, "--backend", "cpu", "--samples", "4"]).good();
    assert_ne!(png(&folder, "b.png"), tall, "four samples smooth the edges");
}

#[test]
fn a_wrong_spec_writes_nothing() {
    let folder = Folder::new("render-wrong");
    let wrong = folder.write("wrong.toml", "[scene]\nfile = \"none.glb\"\n");
    let picture = folder.file("picture.png");
    let report = call(&["render", &wrong, "-o", &picture, "--backend", "cpu"]).refused();
    assert!(report.contains("none.glb") && report.contains("wrong.toml:2"), "{report}");
    assert_eq!(folder.names(), ["wrong.toml"]);
}

#[test]
fn what_cannot_be_written_leaves_nothing_behind() {
    let folder = Folder::new("render-unwritable");
    let spec = project(SPEC);
    fs::create_dir(folder.file("taken.png")).expect("a folder");
    for target in ["missing/picture.png", "taken.png"] {
        let target = folder.file(target);
        let report = call(&["render", &spec, "-o", &target, "--size", "8x6", "--backend", "cpu"]).refused();
        assert!(report.contains("folder"), "{report}");
        assert_eq!(folder.names(), ["taken.png"], "{target}");
    }
}

#[test]
fn files_that_would_overwrite_each_other_are_refused_before_anything_is_written() {
    let folder = Folder::new("render-targets");
    let file = |name: &str| folder.file(name);
    let copy = file("copy.toml");
    fs::copy(project(SPEC), &copy).expect("a spec can be copied");
    let before = folder.read("copy.toml");
    for (arguments, what) in [
        (vec!["-o", &copy], "give each its own name"),
        (vec!["-o", &file("a.png"), "--aov", &format!("node={}", file("a.png"))], "give each its own name"),
        (vec!["-o", &file("a.png"), "--aov", &format!("node={}", file("./a.png"))], "give each its own name"),
        (
            vec!["-o", &file("a.png"), "--aov", &format!("region={}", file("r.png")), "--stats", &file("r.json")],
            "give each its own name",
        ),
        (vec!["-o", &file("a.png"), "--stats", &file("none/s.json")], "make it first"),
        (vec!["-o", &file("")], "it is a folder"),
    ] {
        let mut call_arguments = vec!["render", copy.as_str()];
        call_arguments.extend(arguments.iter().map(|a| &**a));
        let report = call(&call_arguments).refused();
        assert!(report.contains(what), "{arguments:?}: {report}");
        assert_eq!(folder.names(), ["copy.toml"], "{arguments:?}");
    }
    assert_eq!(folder.read("copy.toml"), before, "the spec is as it was");
}
