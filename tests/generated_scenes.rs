//! The committed models are what the generator writes, byte for byte.

#[path = "../examples/make_scenes/scenes/mod.rs"]
mod scenes;

use std::collections::HashMap;
use std::path::Path;

use glam::DVec3;
use lenspeel::scene::Model;

/// The most that the generated files may take together.
const MOST_BYTES: usize = 6_000_000;

fn folder() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/lens-specs/models"))
}

#[test]
fn the_committed_models_are_the_generators_output() {
    let files = scenes::all();
    for file in &files {
        let committed = std::fs::read(folder().join(file.name)).unwrap_or_else(|e| panic!("{}: {e}", file.name));
        let differs = committed.iter().zip(&file.bytes).position(|(a, b)| a != b);
        assert!(
            differs.is_none() && committed.len() == file.bytes.len(),
            "{}: {} bytes committed, {} generated, first difference at {differs:?}; run `cargo run --example make_scenes`",
            file.name,
            committed.len(),
            file.bytes.len(),
        );
    }
    let total: usize = files.iter().map(|f| f.bytes.len()).sum();
    assert!(total <= MOST_BYTES, "{total} bytes of models, at most {MOST_BYTES} allowed");
    let mut generated: Vec<_> = files.iter().map(|f| f.name.to_owned()).collect();
    let listed = std::fs::read_dir(folder()).expect("the folder of models");
    let mut present: Vec<_> = listed.map(|e| e.expect("an entry").file_name().into_string().expect("UTF-8")).collect();
    generated.sort();
    present.sort();
    assert_eq!(present, generated, "every file in the folder is generated, and nothing else lies there");
}

#[test]
fn every_model_loads_without_a_warning() {
    let entries = std::fs::read_dir(folder()).expect("the folder of models");
    let paths = entries.map(|e| e.expect("an entry").path()).filter(|p| p.extension().is_some_and(|e| e == "glb"));
    for path in paths {
        let model = Model::load(&path, None).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert!(model.warnings.is_empty(), "{}: {:?}", path.display(), model.warnings);
        assert!(!model.bounds().is_empty(), "{} draws nothing", path.display());
    }
}

/// Meshes that are open on purpose.
const OPEN: [&str; 10] = ["red", "yellow", "green", "blue", "violet", "repeat", "mirror", "clamp", "screen", "panel"];

#[test]
fn every_solid_is_closed_and_turned_outwards() {
    let entries = std::fs::read_dir(folder()).expect("the folder of models");
    let paths = entries.map(|e| e.expect("an entry").path()).filter(|p| p.extension().is_some_and(|e| e == "glb"));
    for path in paths {
        let model = Model::load(&path, None).unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        for mesh in model.meshes.iter().filter(|m| !OPEN.contains(&m.name.as_str())) {
            let triangles = corners(mesh);
            let what = format!("{} in {}", mesh.name, path.display());
            assert_eq!(unpaired_edges(&triangles), 0, "{what} has edges that two triangles do not share");
            let volume: f64 = triangles.iter().map(|[a, b, c]| a.dot(b.cross(*c)) / 6.0).sum();
            assert!(volume > 0.0, "{what} is inside out: volume {volume}");
        }
    }
}

/// The triangles of all primitives of a mesh.
fn corners(mesh: &lenspeel::scene::Mesh) -> Vec<[DVec3; 3]> {
    let primitives = mesh.primitives.iter();
    primitives.flat_map(|p| p.triangles.iter().map(|t| t.map(|i| p.positions[i as usize].as_dvec3()))).collect()
}

/// Directed edges that are not met exactly once in each direction; vertices count as one where they coincide.
fn unpaired_edges(triangles: &[[DVec3; 3]]) -> usize {
    let key = |p: DVec3| p.to_array().map(|c| (c + 0.0).to_bits());
    let mut edges: HashMap<_, (u32, u32)> = HashMap::new();
    for triangle in triangles {
        for i in 0..3 {
            let (a, b) = (key(triangle[i]), key(triangle[(i + 1) % 3]));
            let entry = edges.entry((a.min(b), a.max(b))).or_default();
            if a < b {
                entry.0 += 1;
            } else {
                entry.1 += 1;
            }
        }
    }
    edges.values().filter(|counts| **counts != (1, 1)).count()
}

#[test]
fn an_opened_solid_is_noticed() {
    let model = Model::load(&folder().join("steps.glb"), None).expect("steps.glb");
    let mut triangles = corners(&model.meshes[0]);
    assert_eq!(unpaired_edges(&triangles), 0);
    triangles.pop();
    assert_eq!(unpaired_edges(&triangles), 3);
}
