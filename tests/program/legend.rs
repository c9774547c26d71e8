//! `lenspeel render --legend`.

use crate::call::{Folder, call, project};

#[test]
fn a_legend_is_drawn_where_it_is_asked_for_and_has_room() {
    let folder = Folder::new("legend");
    let render = |name: &str, spec: &str, more: &[&str]| {
        let picture = folder.file(name);
        let arguments = ["render", &project(spec), "-o", &picture, "--samples", "1", "--backend", "cpu", "-q"];
        let call = call(&[&arguments[..], more].concat());
        assert_eq!(call.code, Some(0), "{}", call.err);
        (image::load_from_memory(&folder.read(name)).expect("a PNG").into_rgba8(), call.err)
    };
    let spec = "lens-specs/filters/height.toml";
    let (bare, _) = render("a.png", spec, &["--size", "320x240"]);
    let (told, err) = render("b.png", spec, &["--size", "320x240", "--legend"]);
    assert_eq!(err, "");
    let differ = |y: u32| (0..320).filter(|x| bare.get_pixel(*x, y) != told.get_pixel(*x, y)).count();
    assert!((0..130).all(|y| differ(y) == 0), "the upper half is as it was");
    assert!((200..225).all(|y| differ(y) > 50), "the legend is below");
    let (set, _) = render("c.png", spec, &["--size", "320x240", "--set", "image.legend=true"]);
    assert!(set == told);
    let (small, err) = render("d.png", spec, &["--size", "32x24", "--legend"]);
    assert_eq!(err, "warning: the picture has no room for 1 entry of its legend\n");
    assert!(small == render("e.png", spec, &["--size", "32x24"]).0);
    let usage = call(&["render", &project(spec), "-o", &folder.file("f.png"), "--legend", "--view", "order"]);
    assert_eq!(usage.code, Some(2));
}
