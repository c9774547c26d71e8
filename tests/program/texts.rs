//! `info`, `init`, `filters`, `schema`.

use crate::call::{Folder, call, project};
use crate::model::triangle;

#[test]
fn info_describes_a_model() {
    let out = call(&["info", &project("lens-specs/models/ball-in-box.glb")]).good();
    for part in ["972 triangles shown", "bounds (-1 -1 -1) to (1 1 1)", "ball  mesh 1 ball  960 triangles", "materials"]
    {
        assert!(out.contains(part), "{part}: {out}");
    }
    let report = call(&["info", &project("Cargo.toml")]).refused();
    assert!(report.contains("Cargo.toml"), "{report}");
}

#[test]
fn one_is_told_as_one() {
    let folder = Folder::new("info-one");
    let out = call(&["info", &triangle(&folder, "one.gltf", 1.0)]).good();
    for part in ["1 triangle shown, 1 stored in 1 mesh\n", "3 vertices, 1 node (1 shown)\n", "mesh 0  1 triangle  open"]
    {
        assert!(out.contains(part), "{part}: {out}");
    }
}

#[test]
fn what_init_writes_can_be_checked_and_rendered() {
    for model in ["ball-in-box", "cubes", "gearbox", "hand", "panes", "steps", "textured-quad", "two-rooms"] {
        let folder = Folder::new(&format!("init-{model}"));
        let (spec, picture) = (folder.file("starter.toml"), folder.file("starter.png"));
        call(&["init", &project(&format!("lens-specs/models/{model}.glb")), "-o", &spec]).good();
        let out = call(&["check", &spec, "--strict"]).good();
        assert!(out.contains("good: 2 lenses, 3 regions, 0 warnings"), "{model}: {out}");
        call(&["render", &spec, "-o", &picture, "--size", "32x18", "--samples", "1", "--backend", "cpu"]).good();
        assert_eq!(folder.names(), ["starter.png", "starter.toml"]);
    }
}

#[test]
fn init_replaces_nothing() {
    let folder = Folder::new("init-again");
    let model = project("lens-specs/models/cubes.glb");
    let spec = folder.write("mine.toml", "# mine\n");
    let report = call(&["init", &model, "-o", &spec]).refused();
    assert!(report.contains("mine.toml is there already"), "{report}");
    assert_eq!(folder.read("mine.toml"), b"# mine\n");
}

#[test]
fn init_without_a_file_prints_the_spec() {
    let out = call(&["init", &project("lens-specs/models/cubes.glb")]).good();
    let table: toml::Table = out.parse().expect("TOML");
    assert_eq!(table["lens"].as_array().map(Vec::len), Some(2));
}

#[test]
fn filters_lists_what_is_built() {
    let out = call(&["filters"]).good();
    for name in [
        "wireframe",
        "erase",
        "show",
        "texture",
        "tint",
        "grayscale",
        "invert",
        "unlit",
        "opacity",
        "normals",
        "material",
    ] {
        assert!(out.lines().any(|line| line.trim_start().starts_with(name)), "{name}: {out}");
    }
}

#[test]
fn schema_is_a_json_schema_of_the_format() {
    let schema: serde_json::Value = serde_json::from_str(&call(&["schema"]).good()).expect("JSON");
    assert!(schema["$schema"].as_str().is_some_and(|id| id.contains("json-schema.org")), "{schema}");
    for table in ["scene", "camera", "image", "light", "lens", "overlap"] {
        assert!(schema["properties"].get(table).is_some(), "{table}");
    }
}

#[test]
fn shells_and_man_know_every_command() {
    let commands = ["render", "check", "explain", "pick", "bench", "info", "init", "filters", "shapes", "schema"];
    for shell in ["bash", "zsh", "fish", "elvish", "powershell"] {
        let out = call(&["completions", shell]).good();
        assert!(commands.iter().all(|command| out.contains(command)) && out.contains("set"), "{shell}");
    }
    let page = call(&["man"]).good();
    assert!(page.contains(".TH lenspeel 1"), "{page}");
    assert!(commands.iter().all(|command| page.contains(&format!("lenspeel\\-{command}"))), "{page}");
    for command in commands {
        let page = call(&["man", command]).good();
        assert!(page.contains(&format!(".TH lenspeel-{command} 1")), "{page}");
        assert!(page.contains(&format!("lenspeel {command}")), "{page}");
    }
    assert!(call(&["man", "rendr"]).refused().contains("did you mean `render`"));
}

#[test]
fn info_finds_names_and_writes_json() {
    let model = project("lens-specs/models/ball-in-box.glb");
    let out = call(&["info", &model, "b?ll"]).good();
    assert!(out.contains("mesh 1 ball") && !out.contains("mesh 0"), "{out}");
    let json: serde_json::Value = serde_json::from_str(&call(&["info", &model, "--json"]).good()).expect("JSON");
    assert_eq!((&json["triangles_shown"], &json["bounds"]["max"][0]), (&972.into(), &1.0.into()));
    assert!(json["nodes"].as_array().is_some_and(|nodes| nodes.iter().any(|node| node["name"] == "ball")), "{json}");
}

#[test]
fn what_a_model_lacks_is_told_once_by_each_command() {
    let folder = Folder::new("lacking");
    let json = r#"{"asset": {"version": "2.0"}, "scene": 0, "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}], "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "material": 0}]}],
        "materials": [{"emissiveTexture": {"index": 0}}], "textures": [{"source": 0}], "images": [{"uri": "none.png"}],
        "accessors": [{"componentType": 5126, "type": "VEC3", "count": 3}]}"#;
    let model = folder.write("m.gltf", json);
    let text = "[scene]\nfile = 'm.gltf'\n[scene.alternates]\nagain = 'm.gltf'\n";
    let (spec, picture) = (folder.write("s.toml", text), folder.file("s.png"));
    let count = |text: &str| text.matches("image 0 `none.png`: cannot read").count();
    assert_eq!(count(&call(&["info", &model]).good()), 1);
    let checked = call(&["check", &spec]).good();
    assert!(count(&checked) == 1 && checked.contains("m.gltf: image 0"), "{checked}");
    let rendered = call(&["render", &spec, "-o", &picture, "--size", "16x9", "--backend", "cpu", "--samples", "1"]);
    assert_eq!((rendered.code, count(&rendered.err)), (Some(0), 1), "{}", rendered.err);
    assert!(call(&["check", &spec, "--strict"]).refused().contains("--strict allows none"));
    let refused = call(&["check", &spec, "--memory-limit", "300"]).refused();
    assert!(refused.contains("the limit is 300 B") && refused.contains("--memory-limit"), "{refused}");
}
