//! Wrong usage ends with 2, before anything is read or written.

use crate::call::{Folder, call, project};

#[test]
fn wrong_usage_is_told_from_wrong_input() {
    let folder = Folder::new("usage");
    let (spec, picture) = (project("lens-specs/order/over.toml"), folder.file("picture.png"));
    let render = ["render", &spec, "-o", &picture];
    let wrong: [&[&str]; 18] = [
        &[],
        &["paint"],
        &["render", &spec],
        &["check"],
        &["bench"],
        &["bench", &spec, "--frames", "0"],
        &["bench", &spec, "--size", "10"],
        &["explain", &spec, "--format", "xml"],
        &["explain", &spec, "--pixel", "1;2"],
        &["pick", &spec],
        &["pick", &spec, "1", "2"],
        &[&render[..], &["--view", "lenses"]].concat(),
        &[&render[..], &["--size", "0x10"]].concat(),
        &[&render[..], &["--size", "10"]].concat(),
        &[&render[..], &["--samples", "3"]].concat(),
        &[&render[..], &["--backend", "abacus"]].concat(),
        &[&render[..], &["--aov", "colour=a.png"]].concat(),
        &[&render[..], &["--aov", "depth="]].concat(),
    ];
    for arguments in wrong {
        let call = call(arguments);
        assert_eq!(call.code, Some(2), "{arguments:?}: {}", call.err);
        assert!(!call.err.is_empty(), "{arguments:?} says nothing");
    }
    assert!(folder.names().is_empty());
}

#[test]
fn help_and_version_are_no_mistakes() {
    let help = call(&["help"]).good();
    for command in ["render", "check", "explain", "pick", "bench", "info", "init", "filters", "schema"] {
        assert!(help.contains(command), "{command}: {help}");
    }
    assert!(call(&["--version"]).good().starts_with("lenspeel "));
}

#[test]
fn a_file_that_is_not_there_is_wrong_input() {
    for arguments in [["check", "none.toml"], ["explain", "none.toml"], ["info", "none.glb"], ["init", "none.glb"]] {
        let report = call(&arguments).refused();
        assert!(report.contains(arguments[1]), "{report}");
    }
    #[cfg(feature = "gpu")]
    assert!(call(&["bench", "none.toml"]).refused().contains("none.toml"));
    #[cfg(not(feature = "gpu"))]
    assert!(call(&["bench", &project("lens-specs/order/over.toml")]).refused().contains("`gpu` feature"));
}
