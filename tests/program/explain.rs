//! `lenspeel explain`.

use serde_json::{Value, json};

use crate::call::{call, project};

const SPEC: &str = "lens-specs/order/hides-chain.toml";

fn explain(more: &[&str]) -> String {
    explain_of(SPEC, more)
}

fn explain_of(spec: &str, more: &[&str]) -> String {
    call(&[&["explain", &project(spec)], more].concat()).good()
}

/// What is said of a `hides` that the spec declares in this line.
fn line_of(declared: &str, below: &str, above: &str) -> String {
    let text = std::fs::read_to_string(project(SPEC)).expect("the spec is there");
    let line = 1 + text.lines().position(|line| line == declared).expect("the spec declares it");
    format!("`hides` in line {line} puts {below} below {above}")
}

fn explain_json(more: &[&str]) -> Value {
    serde_json::from_str(&explain(&[&["--format", "json"], more].concat())).expect("JSON")
}

#[test]
fn text_gives_order_regions_and_reasons() {
    let text = explain(&[]);
    for part in
        ["order, lowest first", "1. a (line ", "`hides` in line ", "regions that occur: 7", "hidden: b, for c hides it"]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
}

#[test]
fn json_says_who_acts_and_who_is_hidden() {
    let account = explain_json(&[]);
    let order: Vec<&Value> = account["order"].as_array().expect("a list").iter().map(|lens| &lens["lens"]).collect();
    assert_eq!(order, ["a", "b", "c"]);
    let all = account["regions"].as_array().expect("a list").iter().find(|r| r["lenses"] == json!(["a", "b", "c"]));
    let all = all.expect("the region of all three");
    let stack: Vec<&Value> = all["stack"].as_array().expect("a list").iter().map(|entry| &entry["lens"]).collect();
    assert_eq!(stack, ["a", "c"], "b is hidden and hides nothing");
    let because = line_of("hides = [\"b\"]", "b", "c");
    assert_eq!(all["hidden"], json!([{ "lens": "b", "by": "c", "because": because }]));
    let chain = format!("{}, {because}", line_of("hides = [\"a\"]", "a", "b"));
    assert_eq!(all["order"], json!([{ "below": "a", "above": "c", "because": chain }]));
}

#[test]
fn graphs_have_every_lens_and_every_edge() {
    let dot = explain(&["--format", "dot"]);
    assert!(dot.starts_with("digraph lenses {") && dot.trim_end().ends_with('}'), "{dot}");
    for edge in ["\"a\" -> \"b\"", "\"b\" -> \"c\""] {
        assert!(dot.contains(edge), "{edge}: {dot}");
    }
    let mermaid = explain(&["--format", "mermaid"]);
    assert!(mermaid.starts_with("graph") || mermaid.starts_with("flowchart"), "{mermaid}");
    assert_eq!(mermaid.matches("hides, line").count(), 2, "{mermaid}");
}

#[test]
fn one_pixel_is_explained_in_text_and_json() {
    // Where all three lenses are.
    let text = explain(&["--pixel", "46,36"]);
    let hidden = line_of("hides = [\"b\"]", "b", "c");
    let reasons =
        [format!("hidden: b, for c hides it ({hidden})"), format!("a < c: {}", line_of("hides = [\"a\"]", "a", "b"))];
    for part in ["pixel 46,36: ", "a + b + c", "stack a < c", "<- visible", &reasons[0], &reasons[1]] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let pixel = explain_json(&["--pixel", "46,36"]);
    assert_eq!(pixel["pixel"], json!([46, 36]));
    let fragments = pixel["fragments"].as_array().expect("a list");
    assert_eq!(fragments.len(), 1, "the box is opaque");
    assert_eq!(fragments[0]["node"], "box");
    assert_eq!(fragments[0]["lenses"], json!(["a", "b", "c"]));
    assert_eq!(fragments[0]["visible"], true);
    assert_eq!(fragments[0]["hidden"], json!([{ "lens": "b", "by": "c", "because": hidden }]));
    assert_eq!(fragments[0]["order"][0]["above"], "c");
    assert_eq!(pixel["removed"], json!([]));
    let depths: Vec<f64> =
        pixel["layers"].as_array().expect("a list").iter().filter_map(|layer| layer["depth"].as_f64()).collect();
    assert_eq!(depths.len(), 7, "three lenses cut the ray into seven layers");
    assert!(depths.is_sorted(), "{depths:?}");
}

#[test]
fn a_pixel_outside_is_refused_with_the_size() {
    let report = call(&["explain", &project(SPEC), "--pixel", "96,0"]).refused();
    assert!(report.contains("96 x 72") && report.contains("96,0"), "{report}");
}

#[test]
fn what_lenses_remove_in_front_of_the_visible_is_named() {
    // Through the erased front of the box and of the ball to the ball's far side.
    let text = explain_of("lens-specs/filters/erase.toml", &["--pixel", "48,36"]);
    assert!(text.contains("fragments in front that lenses remove, nearest first: 2"), "{text}");
    assert_eq!(text.matches("in f; stack f; removed by f (erase)").count(), 2, "{text}");
    let json = explain_of("lens-specs/filters/erase.toml", &["--pixel", "48,36", "--format", "json"]);
    let pixel: Value = serde_json::from_str(&json).expect("JSON");
    let removed = pixel["removed"].as_array().expect("a list");
    let nodes: Vec<&Value> = removed.iter().map(|fragment| &fragment["node"]).collect();
    assert_eq!(nodes, ["box", "ball"]);
    let depth = |fragment: &Value| fragment["depth"].as_f64().expect("a number");
    let visible = depth(&pixel["fragments"][0]);
    for fragment in removed {
        assert_eq!(fragment["removed_by"], json!([{ "lens": "f", "filter": "erase" }]));
        assert!(depth(fragment) < visible, "{json}");
    }
}

#[test]
fn replaced_fragments_name_the_lens_that_shows() {
    let text = explain_of("lens-specs/filters/show-over-erase.toml", &["--pixel", "48,36"]);
    assert!(text.contains("removed by low (erase), high (show)"), "{text}");
    let text = explain_of("lens-specs/filters/erase-over-show.toml", &["--pixel", "48,36"]);
    assert!(text.contains("removed by low (show), high (erase)"), "{text}");
}

#[test]
fn one_pixel_has_no_graph() {
    for format in ["dot", "mermaid"] {
        let report = call(&["explain", &project(SPEC), "--pixel", "46,36", "--format", format]).refused();
        assert!(report.contains("one pixel has no graph") && report.contains("--format json"), "{report}");
    }
}
