//! `lenspeel check`.

use crate::call::{Folder, call, project};

#[test]
fn a_good_spec_passes_strictly() {
    let out = call(&["check", &project("lens-specs/order/over.toml"), "--strict"]).good();
    assert!(out.ends_with("over.toml: good: 2 lenses, 3 regions, 0 warnings\n"), "{out}");
}

#[test]
fn an_undecided_pair_is_named_with_its_remedy_and_fails_when_strict() {
    let spec = project("lens-specs/order/file-order.toml");
    let out = call(&["check", &spec]).good();
    assert!(out.contains("puts a below b: add `over = [\"a\"]` to lens `b`"), "{out}");
    let strict = call(&["check", &spec, "--strict"]);
    assert!(strict.out.contains("add `over = [\"a\"]` to lens `b`"), "{}", strict.out);
    assert!(strict.refused().contains("--strict allows none"));
}

#[test]
fn a_pattern_that_matches_nothing_is_a_warning() {
    let folder = Folder::new("check-pattern");
    let model = project("lens-specs/models/cubes.glb");
    let text = format!(
        "[scene]\nfile = '{model}'\nhide = ['no-such-node']\n[[lens]]\nname = 'a'\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nfilters = ['erase']\n"
    );
    let spec = folder.write("pattern.toml", &text);
    let out = call(&["check", &spec]).good();
    assert!(out.contains("pattern.toml:3: `hide` matches nothing: `no-such-node`"), "{out}");
    call(&["check", &spec, "--strict"]).refused();
}

#[test]
fn a_cycle_is_printed_whole() {
    let folder = Folder::new("check-cycle");
    let lens = |name: &str, over: &str| {
        format!(
            "[[lens]]\nname = '{name}'\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nfilters = ['erase']\nover = ['{over}']\n"
        )
    };
    let model = project("lens-specs/models/cubes.glb");
    let text = format!("[scene]\nfile = '{model}'\n{}{}{}", lens("a", "b"), lens("b", "c"), lens("c", "a"));
    let report = call(&["check", &folder.write("cycle.toml", &text)]).refused();
    for part in ["a", "b", "c", "over = ['b']", "over = ['c']", "over = ['a']"] {
        assert!(report.contains(part), "{part}: {report}");
    }
}

#[test]
fn a_misspelt_key_is_named_with_its_line_and_the_nearest_key() {
    let folder = Folder::new("check-key");
    let report = call(&["check", &folder.write("key.toml", "[scene]\nfille = 'a.glb'\n")]).refused();
    assert!(report.contains("key.toml:2") && report.contains("fille") && report.contains("`file`"), "{report}");
}
