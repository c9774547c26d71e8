//! `lenspeel pick`.

use serde_json::{Value, json};

use crate::call::{call, project};

fn pick(spec: &str, pixel: &str, format: &str) -> String {
    call(&["pick", &project(spec), pixel, "--backend", "cpu", "--format", format]).good()
}

fn pick_json(spec: &str, pixel: &str) -> Value {
    serde_json::from_str(&pick(spec, pixel, "json")).expect("JSON")
}

#[test]
fn the_visible_surface_is_named() {
    let text = pick("lens-specs/order/hides-chain.toml", "46,36", "text");
    for part in ["pixel 46,36", "node      0 box, in", "triangle", "lenses    a + b + c", "stack     a."] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let picked = pick_json("lens-specs/order/hides-chain.toml", "46,36");
    assert_eq!(picked["node"]["name"], "box");
    assert_eq!(picked["lenses"], json!(["a", "b", "c"]));
    assert_eq!(picked["position"], picked["place"], "no lens moves it");
    assert_eq!(picked["moved_by"], json!([]));
}

#[test]
fn erased_surfaces_are_seen_through() {
    // Through the erased front of the box and of the ball to the ball's far side.
    let picked = pick_json("lens-specs/filters/erase.toml", "48,36");
    let explained = call(&[
        "explain",
        &project("lens-specs/filters/erase.toml"),
        "--pixel",
        "48,36",
        "--backend",
        "cpu",
        "--format",
        "json",
    ]);
    let explained: Value = serde_json::from_str(&explained.good()).expect("JSON");
    let visible = explained["fragments"].as_array().expect("a list").iter().find(|f| f["visible"] == true);
    let visible = visible.expect("a visible fragment");
    for key in ["node", "material", "triangle", "depth", "position", "lenses", "stack"] {
        assert_eq!(picked[key], visible[key], "{key}");
    }
    let removed = explained["removed"].as_array().expect("a list");
    assert!(removed.iter().all(|fragment| fragment["depth"].as_f64() < picked["depth"].as_f64()), "{removed:?}");
}

#[test]
fn a_moved_surface_tells_where_it_stands() {
    let picked = pick_json("lens-specs/movers/magnify-over-wireframe.toml", "60,40");
    assert_eq!(picked["moved_by"], json!(["glass"]));
    let point = |key: &str| -> Vec<f64> { serde_json::from_value(picked[key].clone()).expect("three numbers") };
    // Enlarged twice about the lens's centre.
    for ((shown, stands), center) in point("position").iter().zip(point("place")).zip([0.05, 0.1, 0.55]) {
        assert!((shown - (center + 2.0 * (stands - center))).abs() < 1e-5, "{shown} {stands}");
    }
}

#[test]
fn nothing_is_no_mistake_and_outside_is() {
    let spec = "lens-specs/order/hides-chain.toml";
    assert_eq!(pick(spec, "0,0", "text"), "pixel 0,0: nothing is there\n");
    assert_eq!(pick(spec, "0,0", "json"), "null\n");
    let report = call(&["pick", &project(spec), "96,0"]).refused();
    assert!(report.contains("96 x 72") && report.contains("96,0"), "{report}");
}
