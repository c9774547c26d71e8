//! The committed models are what the generator writes, byte for byte.

#[path = "../examples/make_scenes/scenes/mod.rs"]
mod scenes;

use std::path::Path;

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
