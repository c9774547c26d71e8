//! Names that a model gives reach no terminal as they are.

use crate::call::{Folder, call};
use crate::model::triangles;

/// What sets the title of a terminal window, and the one character that begins such sequences, too.
const NAME: &str = "\u{1b}]0;x\u{7}\u{9b}1m";

fn assert_printable(text: &str) {
    assert!(!text.contains(|c: char| c.is_control() && c != '\n'), "{text:?}");
}

#[test]
fn names_of_a_model_do_not_steer_a_terminal() {
    let folder = Folder::new("names");
    let model = triangles(&folder, "m.gltf", 1.0, &[r#"{"name": "\u001b]0;x\u0007\u009b1m", "mesh": 0}"#]);
    let text = "[scene]\nfile = 'm.gltf'\n[camera]\neye = [0.3, 0.3, 5]\ntarget = [0.3, 0.3, 0]\nfov_y = 10\n\
        [[lens]]\nname = 'cut'\nshape.sphere = { center = [0, 0, 0], radius = 0.1 }\nfilters = [{ erase = { cap = 'own' } }]\n";
    let (spec, picture) = (folder.write("s.toml", text), folder.file("a.png"));
    let size = ["--size", "8x6"];
    let rendered = call(&[&["render", &spec, "-o", &picture, "--backend", "cpu"], &size[..]].concat());
    assert_eq!(rendered.code, Some(0), "{}", rendered.err);
    let told = [
        rendered.err,
        call(&["check", &spec]).good(),
        call(&["info", &model]).good(),
        call(&[&["explain", &spec], &size[..]].concat()).good(),
        call(&[&["explain", &spec, "--pixel", "4,3"], &size[..]].concat()).good(),
        call(&[&["pick", &spec, "4,3"], &size[..]].concat()).good(),
    ];
    for text in told {
        assert_printable(&text);
        assert!(text.contains("\\u{1b}]0;x\\u{7}\\u{9b}1m"), "{text}");
    }
    let json = call(&[&["pick", &spec, "4,3", "--format", "json"], &size[..]].concat()).good();
    assert_printable(&json);
    let picked: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(picked["node"]["name"], NAME);
}

#[test]
fn a_line_of_a_spec_is_shown_without_what_would_steer_a_terminal() {
    let folder = Folder::new("names-spec");
    let spec = folder.write("s.toml", &format!("[scene]\nfile = 'none.glb'\n# {NAME}\n"));
    let report = call(&["check", &spec]).refused();
    assert_printable(&report);
    assert!(report.contains("s.toml:3") && report.contains("]0;x"), "{report}");
}
