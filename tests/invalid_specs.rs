//! Every spec under `lens-specs/invalid` is refused, and the whole text of the refusal is a snapshot.

use std::fs;
use std::path::{Path, PathBuf};

use lenspeel::InputError;
use lenspeel::cli::report;
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;

/// A walk that finds fewer has looked in the wrong place.
const LEAST_SPECS: usize = 130;

/// Tests run in the folder of the package, so that no message depends on where that is.
fn folder() -> PathBuf {
    PathBuf::from("lens-specs/invalid")
}

/// The specs of the folder, by name.
fn specs() -> Vec<PathBuf> {
    let entries = fs::read_dir(folder()).expect("lens-specs/invalid is part of the project");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a readable folder").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    paths.sort();
    paths
}

/// What the program does with a spec before it draws: read it, open what it names, decide.
fn decide(text: &str, name: &str) -> Result<Plan, InputError> {
    let spec = Spec::parse(text, name, &folder())?;
    let scene = Scene::open(&spec)?;
    Plan::new(&spec, &scene)
}

fn refusal(path: &Path, name: &str) -> String {
    let text = fs::read_to_string(path).expect("a readable spec");
    match decide(&text, name) {
        Ok(_) => panic!("{name} is accepted"),
        Err(error) => report(&error, false),
    }
}

#[test]
fn every_invalid_spec_is_refused_as_recorded() {
    let mut settings = insta::Settings::clone_current();
    settings.set_omit_expression(true);
    settings.set_prepend_module_to_snapshot(true);
    let _bound = settings.bind_to_scope();
    for path in specs() {
        let stem = path.file_stem().and_then(|stem| stem.to_str()).expect("a plain file name");
        let name = format!("{stem}.toml");
        insta::assert_snapshot!(stem, refusal(&path, &name));
    }
}

#[test]
fn the_walk_finds_the_specs() {
    let found = specs().len();
    assert!(found >= LEAST_SPECS, "only {found} specs under {}", folder().display());
}

#[test]
fn a_spec_that_is_not_there_or_not_text_is_refused() {
    let missing = Spec::load(Path::new("no-such-spec.toml")).expect_err("there is no such file");
    assert!(missing.to_string().starts_with("cannot read the spec file no-such-spec.toml"), "{missing}");

    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("not-text.toml");
    fs::write(&path, b"[scene]\nfile = \"\xff\"\n").expect("the build folder takes a file");
    let not_text = Spec::load(&path).expect_err("the file is not UTF-8");
    assert!(not_text.to_string().contains("byte 16 is not UTF-8"), "{not_text}");
}
