//! `lenspeel explain`.

use serde_json::{Value, json};

use crate::call::{Folder, call, project};

const SPEC: &str = "lens-specs/order/hides-chain.toml";
const MOVED: &str = "lens-specs/movers/magnify-over-wireframe.toml";

fn explain(more: &[&str]) -> String {
    explain_of(SPEC, more)
}

fn explain_of(spec: &str, more: &[&str]) -> String {
    call(&[&["explain", &project(spec), "--backend", "cpu"], more].concat()).good()
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
    for part in [
        "order, lowest first",
        "1. a (line ",
        "`hides` in line ",
        "regions that occur: 7; ",
        "hidden: b, for c hides it",
    ] {
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

/// A ball in a box: `open` takes the front of the box away, `pale` is seen through, `keep` is not there for the ball.
const LOOKS: &str = "[camera]\neye = [0, 0, 5]\ntarget = [0, 0, 0]\n[image]\nsize = [60, 60]\n\
    [[lens]]\nname = 'pale'\nshape.halfspace = { point = [0, 0, 0], normal = [0, 0, -1] }\n\
    filters = [{ opacity = { value = 0.5 } }]\nonly = { nodes = ['ball'] }\n\
    [[lens]]\nname = 'open'\nshape.halfspace = { point = [0, 0, 0], normal = [0, 0, -1] }\n\
    filters = [{ erase = { nodes = ['box'] } }]\nexcept = { nodes = ['ball'] }\n";

#[test]
fn what_is_taken_away_and_seen_through_is_counted() {
    let folder = Folder::new("explain-looks");
    let model = project("lens-specs/models/ball-in-box.glb");
    let spec = folder.write("looks.toml", &format!("[scene]\nfile = '{model}'\n{LOOKS}"));
    let text = call(&["explain", &spec]).good();
    let line = |name: &str| {
        let order = text.split(&format!(". {name} (")).nth(1).unwrap_or_else(|| panic!("{text}"));
        order
            .split("in view: ")
            .nth(1)
            .and_then(|rest| rest.lines().next())
            .unwrap_or_else(|| panic!("{text}"))
            .to_owned()
    };
    assert!(line("open").starts_with("takes something away in "), "{text}");
    assert!(line("pale").starts_with("on what is seen through in "), "{text}");
    assert!(text.contains("pale; seen through in "), "{text}");
    let json: Value = serde_json::from_str(&call(&["explain", &spec, "--format", "json"]).good()).expect("JSON");
    let pale = &json["order"][0]["in_view"];
    assert_eq!((json["order"][0]["lens"].as_str(), pale["removes"]["pixels"].as_u64()), (Some("pale"), Some(0)));
    let through = pale["seen_through"]["pixels"].as_u64().expect("a number");
    assert!(through > 50, "{through}");
    let erased = json["order"][1]["in_view"]["removes"]["pixels"].as_u64().expect("a number");
    assert!(erased > through, "{erased} of {through}");
    let pixel = call(&["explain", &spec, "--pixel", "30,30"]).good();
    assert!(pixel.contains("not in open: its `except` in line 17 names this node or material"), "{pixel}");
    assert!(pixel.contains("not in pale: its `only` in line 12 names neither this node nor its material"), "{pixel}");
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

/// As recorded, but for the folder of the project.
fn check_snapshot(name: &str, text: &str) {
    insta::assert_snapshot!(name, text.replace(env!("CARGO_MANIFEST_DIR"), "."));
}

#[test]
fn accounts_are_as_recorded() {
    check_snapshot("order-and-shares", &explain_of("lens-specs/compose.toml", &["--size", "160x90"]));
    check_snapshot("shares-json", &explain_of("lens-specs/rules/empty-set.toml", &["--format", "json"]));
    check_snapshot("moved-pixel", &explain_of(MOVED, &["--pixel", "60,40"]));
    check_snapshot("moved-pixel-json", &explain_of(MOVED, &["--pixel", "60,40", "--format", "json"]));
    check_snapshot("ruled-pixel", &explain_of("lens-specs/rules/pair.toml", &["--pixel", "48,36"]));
}

#[test]
fn graphs_tell_hides_overrides_and_undecided_pairs_apart() {
    let folder = Folder::new("explain-graph");
    let model = project("lens-specs/models/cubes.glb");
    let lens = |name: &str, more: &str| {
        format!(
            "[[lens]]\nname = '{name}'\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nfilters = ['normals']\n{more}\n"
        )
    };
    let lenses = [
        lens("low-est_1", ""),
        lens("end", "hides = ['low-est_1']"),
        lens("top", "overlap = 'override'\npriority = 1"),
        lens("off", "enabled = false\nover = ['end']"),
        lens("tie", ""),
    ];
    let spec = folder.write("graph.toml", &format!("[scene]\nfile = '{model}'\n{}", lenses.concat()));
    for format in ["dot", "mermaid"] {
        check_snapshot(&format!("graph-{format}"), &call(&["explain", &spec, "--format", format]).good());
    }
}

#[test]
fn shares_count_every_pixel_once() {
    let account = explain_json(&["--size", "40x30"]);
    assert_eq!(account["view"]["size"], json!([40, 30]));
    assert_eq!(account["view"]["backend"], "cpu");
    let pixels = |value: &Value| value["pixels"].as_u64().expect("a number");
    let regions: u64 = account["regions"].as_array().expect("a list").iter().map(pixels).sum();
    assert!(regions > 0);
    assert_eq!(regions + pixels(&account["view"]["plain"]) + pixels(&account["view"]["nothing"]), 40 * 30);
}

#[test]
fn a_region_that_the_view_does_not_show_is_listed() {
    // The lens lies wholly behind the eye.
    let text = explain_of("lens-specs/camera/lens-behind-eye.toml", &[]);
    assert!(text.contains("not in view"), "{text}");
}

#[test]
fn ids_are_those_of_the_region_map() {
    let folder = Folder::new("explain-ids");
    let (picture, map) = (folder.file("picture.png"), format!("region={}", folder.file("region.png")));
    let spec = project("lens-specs/overlap/three-spheres.toml");
    call(&["render", &spec, "-o", &picture, "--backend", "cpu", "--samples", "1", "--aov", &map]).good();
    let json = explain_of("lens-specs/overlap/three-spheres.toml", &["--format", "json"]);
    let account: Value = serde_json::from_str(&json).expect("JSON");
    let pairs = |regions: &Value| -> Vec<(u64, Value)> {
        let regions = regions.as_array().expect("a list").iter();
        regions.map(|region| (region["id"].as_u64().expect("an id"), region["lenses"].clone())).collect()
    };
    assert_eq!(pairs(&account["regions"]), pairs(&folder.json("region.json")));
}

#[test]
fn one_pixel_is_explained_in_text_and_json() {
    // Where all three lenses are.
    let text = explain(&["--pixel", "46,36"]);
    let hidden = line_of("hides = [\"b\"]", "b", "c");
    let reasons =
        [format!("hidden: b, for c hides it ({hidden})"), format!("a < c: {}", line_of("hides = [\"a\"]", "a", "b"))];
    for part in
        ["pixel 46,36 of 96 x 72 (cpu): 7 layers", "a + b + c", "stack a < c", "<- visible", &reasons[0], &reasons[1]]
    {
        assert!(text.contains(part), "{part}: {text}");
    }
    let pixel = explain_json(&["--pixel", "46,36"]);
    assert_eq!(pixel["pixel"], json!([46, 36]));
    let fragments = pixel["fragments"].as_array().expect("a list");
    assert_eq!(fragments.len(), 1, "the box is opaque");
    assert_eq!(fragments[0]["node"]["name"], "box");
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
    let nodes: Vec<&Value> = removed.iter().map(|fragment| &fragment["node"]["name"]).collect();
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
