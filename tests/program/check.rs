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

/// A spec over the cubes with this text behind its scene; what `check` says of it.
fn check_cubes(name: &str, text: &str) -> String {
    let folder = Folder::new(name);
    let model = project("lens-specs/models/cubes.glb");
    call(&["check", &folder.write("spec.toml", &format!("[scene]\nfile = '{model}'\n{text}"))]).good()
}

#[test]
fn names_that_may_have_been_meant_are_told() {
    let lens = "[[lens]]\nname = 'a'\nshape.sphere = { center = [0, 0, 0], radius = 1 }\n\
        filters = [{ erase = { nodes = ['cube-1-1'] } }]\nonly = { materials = ['corral', 'zzz'] }\n";
    let out = check_cubes("check-meant", lens);
    assert!(
        out.contains("spec.toml:6: `erase` of lens `a` matches nothing: `cube-1-1`; did you mean `cube-1-"),
        "{out}"
    );
    assert!(out.contains("`only` of lens `a` matches nothing: `corral`; did you mean `coral`?"), "{out}");
    assert!(out.contains("`zzz`\n"), "{out}");
    assert!(out.contains("spec.toml:4: lens `a` acts on nothing"), "{out}");
}

#[test]
fn of_very_many_names_that_match_nothing_the_first_are_told() {
    let names: Vec<String> = (0..25).map(|i| format!("'none-{i}'")).collect();
    let lens = "[[lens]]\nname = 'a'\nshape.sphere = { center = [0, 0, 0], radius = 1 }\nfilters = ['invert']\n";
    let hide = format!("hide = [{}]\n", names.join(", "));
    let out = check_cubes("check-many", &(hide + lens));
    assert_eq!(out.matches("`hide` matches nothing").count(), 20, "{out}");
    assert!(out.contains("and 5 more patterns match nothing"), "{out}");
    let rule = "[[overlap]]\nwhen = 'a'\nfilters = [{ erase = { nodes = ['nowhere'] } }]\n";
    let out = check_cubes("check-rule", &format!("{lens}{rule}"));
    assert!(out.contains("spec.toml:9: `erase` of the rule in line 8 matches nothing: `nowhere`"), "{out}");
}

#[test]
fn lenses_that_mean_nothing_are_told() {
    let lens = |name: &str, keys: &str| format!("[[lens]]\nname = '{name}'\n{keys}\nfilters = ['invert']\n");
    let near = "shape.sphere = { center = [0, 0, 0], radius = 1 }";
    let text = "[camera]\neye = [0, 0, 9]\ntarget = [0, 0, 0]\n".to_owned()
        + &lens("good", near)
        + &lens("far", "shape.sphere = { center = [90, 0, 0], radius = 1 }")
        + &lens("half", "shape.halfspace = { point = [90, 0, 0], normal = [-1, 0, 0] }")
        + &lens("behind", "shape.flat = { corners = [[-1, -1, -9], [1, -1, -9], [0, 1, -9]] }")
        + &lens("whole", &format!("{near}\ntranslation = [40, 0, 0]\nby = 'object'"))
        + &lens("off", &format!("{near}\ntranslation = [40, 0, 0]\nenabled = false"))
        + "[[lens]]\nname = 'none'\nfilters = [{ show = { nodes = ['layer-0'] } }, 'erase']\n"
        + near
        + "\n";
    let out = check_cubes("check-nothing", &text);
    for (name, why) in [
        ("far", "meets nothing: nothing that it acts on lies in its volume"),
        ("half", "meets nothing: nothing that it acts on lies in its volume"),
        ("behind", "meets nothing: nothing that it acts on is seen through it"),
        ("whole", "meets nothing: with by"),
        ("none", "brings nothing in"),
    ] {
        assert!(out.contains(&format!("lens `{name}` {why}")), "{name}: {out}");
    }
    assert!(!out.contains("lens `good`") && !out.contains("lens `off`"), "{out}");
}
