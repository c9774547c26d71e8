//! `lenspeel init`.

use std::fs;

use crate::call::{Folder, call, call_with, project};
use crate::model::{triangle, triangles};

fn file_of(spec: &str) -> String {
    let table: toml::Table = spec.parse().expect("TOML");
    table["scene"]["file"].as_str().expect("a path").to_owned()
}

#[test]
fn paths_hold_where_the_spec_is_written() {
    let folder = Folder::new("init-paths");
    for name in ["models", "specs", "specs/deep"] {
        fs::create_dir(folder.file(name)).expect("a folder");
    }
    fs::copy(project("lens-specs/models/cubes.glb"), folder.file("models/a.glb")).expect("copied");
    for (spec, expected) in [
        ("specs/a.toml", "../models/a.glb"),
        ("specs/deep/a.toml", "../../models/a.glb"),
        ("models/a.toml", "a.glb"),
        ("a.toml", "models/a.glb"),
    ] {
        call_with(&["init", "models/a.glb", "-o", spec], |command| _ = command.current_dir(folder.file(""))).good();
        assert_eq!(file_of(&String::from_utf8_lossy(&folder.read(spec))), expected);
        call(&["check", &folder.file(spec)]).good();
    }
    // Nobody knows where what is printed goes.
    for arguments in [vec!["init", "models/a.glb"], vec!["init", "models/a.glb", "-o", "-"]] {
        let printed = call_with(&arguments, |command| _ = command.current_dir(folder.file(""))).good();
        assert_eq!(fs::canonicalize(file_of(&printed)).ok(), fs::canonicalize(folder.file("models/a.glb")).ok());
        call(&["check", &folder.write("specs/printed.toml", &printed)]).good();
    }
}

#[test]
fn a_model_that_no_spec_fits_is_to_blame() {
    let folder = Folder::new("init-bounds");
    for (size, told) in
        [(1e30, "no starter spec fits the model"), (1e37, "node 0 reaches 1.0e37 units from the origin")]
    {
        let model = triangle(&folder, "huge.gltf", size);
        for arguments in [vec!["init", &model], vec!["init", &model, "-o", &folder.file("a.toml")]] {
            let report = call(&arguments).refused();
            assert!(report.contains(&format!("huge.gltf: {told}")), "{report}");
            assert!(!report.contains("│"), "no line of a spec is shown: {report}");
        }
    }
    assert_eq!(folder.names(), ["huge.gltf", "t.bin"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_path_that_no_spec_can_name_is_told() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;

    let folder = Folder::new("init-path");
    let path = std::path::Path::new(&folder.file("")).join(OsStr::from_bytes(b"caf\xe9.glb"));
    fs::copy(project("lens-specs/models/cubes.glb"), &path).expect("copied");
    let init = |arguments: &[&str]| call_with(&["init"], |command| _ = command.arg(&path).args(arguments));
    for arguments in [vec![], vec!["-o", &folder.file("a.toml")]] {
        let report = init(&arguments).refused();
        assert!(report.contains("is not UTF-8"), "{report}");
    }
    assert_eq!(folder.names().len(), 1);
}

#[test]
fn a_model_in_place_of_a_spec_is_told_what_to_do() {
    let folder = Folder::new("init-instead");
    let (json, binary) = (triangle(&folder, "t.gltf", 1.0), project("lens-specs/models/cubes.glb"));
    for model in [&json, &binary] {
        for command in ["check", "explain"] {
            let report = call(&[command, model]).refused();
            assert!(report.contains("a lens spec is expected"), "{report}");
            assert!(report.contains(&format!("`lenspeel init {model} -o SPEC.toml`")), "{report}");
        }
    }
}

#[test]
fn a_hidden_node_is_not_what_a_starter_spec_erases() {
    let folder = Folder::new("init-hidden");
    let nodes = [
        r#"{"name": "large", "mesh": 0, "scale": [2, 2, 2]}"#,
        r#"{"name": "small", "mesh": 0}"#,
        r#"{"name": "hidden", "mesh": 0, "scale": [9, 9, 9], "extensions": {"KHR_node_visibility": {"visible": false}}}"#,
    ];
    let out = call(&["init", &triangles(&folder, "parts.gltf", 1.0, &nodes)]).good();
    assert!(out.contains(r#"erase = { nodes = ["large"] }"#), "{out}");
}
