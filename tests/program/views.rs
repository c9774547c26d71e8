//! `lenspeel render --view`.

use std::path::Path;

use crate::call::{Folder, call, project};

const SPEC: &str = "lens-specs/overlap/three-spheres.toml";
/// Share of the pixels that may differ from a recorded view: another maths library may round a depth or a colour the
/// other way.
const SHARE: f64 = 0.002;

fn draw(folder: &Folder, view: &str, more: &[&str]) -> image::RgbImage {
    let picture = folder.file("view.png");
    let arguments = ["render", &project(SPEC), "-o", &picture, "--backend", "cpu", "--samples", "1", "--view", view];
    call(&[&arguments[..], more].concat()).good();
    image::load_from_memory(&folder.read("view.png")).expect("a PNG").into_rgb8()
}

/// Compares with the picture beside this file, or writes it where `LENSPEEL_UPDATE_GOLDENS` is 1.
fn check(view: &str) {
    let folder = Folder::new(&format!("view-{view}"));
    let drawn = draw(&folder, view, &["--size", "48x36"]);
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/program/views").join(format!("{view}.png"));
    if std::env::var_os("LENSPEEL_UPDATE_GOLDENS").is_some_and(|value| value == "1") {
        drawn.save(&path).expect("the golden can be written");
        return;
    }
    let golden = image::open(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display())).into_rgb8();
    assert_eq!(golden.dimensions(), drawn.dimensions(), "{view}");
    let differ =
        golden.pixels().zip(drawn.pixels()).filter(|(a, b)| a.0.iter().zip(b.0).any(|(a, b)| a.abs_diff(b) > 1));
    let (differ, all) = (differ.count(), golden.pixels().len());
    assert!(differ as f64 <= SHARE * all as f64, "{view}: {differ} of {all} pixels differ");
}

#[test]
fn layers_are_as_recorded() {
    check("layers");
}

#[test]
fn regions_are_as_recorded() {
    check("regions");
}

#[test]
fn the_order_is_as_recorded() {
    check("order");
}

#[test]
fn depth_intervals_are_as_recorded() {
    check("depth-intervals");
}

#[test]
fn another_row_is_another_section() {
    let folder = Folder::new("view-row");
    let middle = draw(&folder, "depth-intervals", &["--size", "48x36"]);
    let other = draw(&folder, "depth-intervals", &["--size", "48x36", "--row", "9"]);
    assert_ne!(middle, other);
    assert_eq!(
        middle,
        draw(&folder, "depth-intervals", &["--size", "48x36", "--row", "18"]),
        "the middle one is the default"
    );
}

#[test]
fn a_row_that_is_not_there_or_not_shown_is_refused() {
    let folder = Folder::new("view-row-wrong");
    let (spec, picture) = (project(SPEC), folder.file("view.png"));
    let view = |view: &str, row: &str| {
        call(&["render", &spec, "-o", &picture, "--size", "48x36", "--view", view, "--row", row]).refused()
    };
    assert!(view("depth-intervals", "36").contains("36 rows"), "the last row is 35");
    assert!(view("regions", "3").contains("depth-intervals"));
    assert!(folder.names().is_empty());
}

#[test]
fn a_view_leaves_the_maps_as_they_are() {
    let folder = Folder::new("view-maps");
    let maps = |name: &str, more: &[&str]| {
        let (spec, picture) = (project(SPEC), folder.file("picture.png"));
        let map = format!("region={}", folder.file(name));
        let arguments = ["render", &spec, "-o", &picture, "--backend", "cpu", "--size", "48x36", "--aov", &map];
        call(&[&arguments[..], more].concat()).good();
        folder.read(name)
    };
    assert_eq!(maps("a.png", &[]), maps("b.png", &["--view", "order"]));
}
