//! `lenspeel explain`.

use serde_json::{Value, json};

use crate::call::{call, project};

const SPEC: &str = "lens-specs/order/hides-chain.toml";

fn explain(more: &[&str]) -> String {
    let spec = project(SPEC);
    call(&[&["explain", &spec], more].concat()).good()
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
    assert_eq!(all["hidden"], json!([{ "lens": "b", "by": "c" }]));
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
    for part in ["pixel 46,36: ", "a + b + c", "stack a < c", "<- visible"] {
        assert!(text.contains(part), "{part}: {text}");
    }
    let pixel = explain_json(&["--pixel", "46,36"]);
    assert_eq!(pixel["pixel"], json!([46, 36]));
    let fragments = pixel["fragments"].as_array().expect("a list");
    assert_eq!(fragments.len(), 1, "the box is opaque");
    assert_eq!(fragments[0]["node"], "box");
    assert_eq!(fragments[0]["lenses"], json!(["a", "b", "c"]));
    assert_eq!(fragments[0]["visible"], true);
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
