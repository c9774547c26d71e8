//! `--set KEY=VALUE`.

use crate::call::{Call, Folder, call, project};

const SPEC: &str = "lens-specs/overlap/three-spheres.toml";

fn set(command: &str, settings: &[&str], more: &[&str]) -> Call {
    let spec = project(SPEC);
    let settings: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
    call(&[&[command, &spec], &settings[..], more].concat())
}

#[test]
fn a_setting_is_as_if_the_file_said_so() {
    let folder = Folder::new("set-same");
    let render = |spec: &str, name: &str, more: &[&str]| {
        let picture = folder.file(name);
        let arguments = ["render", spec, "-o", &picture, "--size", "24x18", "--samples", "1", "--backend", "cpu", "-q"];
        call(&[&arguments[..], more].concat()).good();
        folder.read(name)
    };
    let lens = |name: &str, center: &str, filters: &str| {
        format!(
            "[[lens]]\nname = '{name}'\nshape.sphere = {{ center = {center}, radius = 0.5 }}\nfilters = [{filters}]\n"
        )
    };
    let model = project("lens-specs/models/cubes.glb");
    let text = |image: &str, a: [&str; 2], b: [&str; 2]| {
        format!("[scene]\nfile = '{model}'\n{image}{}{}", lens("a", a[0], a[1]), lens("b", b[0], b[1]))
    };
    let before = folder.write("a.toml", &text("", ["[0, 0, 0]", "'wireframe'"], ["[1, 0, 0]", "'invert'"]));
    let after = text(
        "[image]\nbackground = \"#ff0000\"\n",
        ["[0, 0.5, 0]", "{ wireframe = { width = 3 } }"],
        ["[0, 0, 0.5]", "'invert', { tint = { amount = 0.5 } }"],
    );
    let after = folder.write("b.toml", &after);
    let settings = [
        "lens.a.center=[9, 9, 9]",
        "lens.a.center=[0,0.5,0]",
        "image.background=\"#ff0000\"",
        "lens.a.filters.wireframe.width=3",
        "lens.1.shape.sphere.center = [0, 0, 0.5]",
        "lens.b.filters=['invert', 'tint']",
        "lens.b.filters.1.tint={ amount = 0.5 }",
    ];
    let settings: Vec<&str> = settings.iter().flat_map(|setting| ["--set", setting]).collect();
    let expected = render(&after, "b.png", &[]);
    assert!(render(&before, "a.png", &settings) == expected);
    assert!(render(&before, "c.png", &settings[2..]) == expected, "the last one holds");
    assert!(render(&before, "d.png", &[]) != expected);
}

#[test]
fn every_command_that_takes_a_spec_takes_settings() {
    let more: [(&str, &[&str]); 4] = [
        ("check", &[]),
        ("explain", &["--size", "8x6"]),
        ("pick", &["1,1", "--size", "8x6"]),
        ("render", &["-o", "/dev/null", "--size", "8x6", "--backend", "cpu"]),
    ];
    for (command, more) in more {
        set(command, &["lens.a.radius=0.25"], more).good();
        assert!(set(command, &["lens.a.radius=-1"], more).refused().contains("above 0"), "{command}");
    }
    #[cfg(feature = "gpu")]
    assert!(set("bench", &["lens.a.radius=-1"], &[]).refused().contains("above 0"));
    assert!(set("check", &["lens.a.enabled=false"], &[]).good().contains("2 lenses"));
}

#[test]
fn reasons_name_the_setting() {
    let out = set("explain", &["lens.c.over=['b']", "lens.c.name=\"d\""], &["--size", "8x6"]).good();
    assert!(out.contains("`over` in --set lens.c.over=['b'] puts b below d"), "{out}");
    assert!(out.contains("d (--set lens.c.name=\"d\")"), "{out}");
    let dot = set("explain", &["lens.c.over=[\"b\"]"], &["--size", "8x6", "--format", "dot"]).good();
    assert!(dot.contains("[label = \"over, --set lens.c.over=['b']\"]"), "{dot}");
}

#[test]
fn faults_are_shown_in_the_setting() {
    for (setting, parts) in [
        ("lens.a.radius=-1", ["[--set:1:15]", "lens.a.radius=-1", "above 0"]),
        (
            "lens.a.radios=1",
            ["[--set:1:8]", "neither lens `a` nor its `sphere` has a key `radios`", "did you mean `radius`"],
        ),
        ("lens.unknown.radius=1", ["[--set:1:6]", "`lens` has no entry `unknown`", "known here"]),
        ("lens.a.center=[1,2", ["[--set:1:", "this is no value", "text stands in quotes"]),
        ("camera.node=Cam", ["[--set:1:", "this is no value", "text stands in quotes"]),
        ("lens.a", ["[--set:1:1]", "KEY=VALUE", "lens.a"]),
        ("=3", ["[--set:1:1]", "this is no key", "=3"]),
        ("lens.a.filters.7=3", ["[--set:1:16]", "has no entry `7`", "lens.a"]),
        ("lens.a.name.x=3", ["[--set:1:13]", "`name` is a string", "holds no `x`"]),
        ("lens.a.over=['none']", ["[--set:1:", "names \"none\"", "over"]),
        ("scene.file='none.glb'", ["[--set:1:", "none.glb", "needed here"]),
        ("imag.size=[1, 1]", ["[--set:1:1]", "has no key `imag`", "`image`"]),
    ] {
        let report = set("check", &[setting], &[]).refused();
        assert!(parts.iter().all(|part| report.contains(part)), "{setting}: {report}");
    }
    // In the file and beside it.
    let report = set("check", &["lens.a.over=['b']", "lens.b.over=['a']"], &[]).refused();
    assert!(report.contains("--set lens.a.over=['b'] (`over`) puts"), "{report}");
    assert!(report.contains("1 │ lens.a.over=['b']") && report.contains("1 │ lens.b.over=['a']"), "{report}");
    let report = set("check", &["lens.b.name='a'"], &[]).refused();
    assert!(report.contains("the first is here") && report.contains("three-spheres.toml:"), "{report}");
    let warned = set("check", &["lens.a.only={ nodes = ['none'] }"], &[]).good();
    assert!(warned.contains("--set lens.a.only={ nodes = ['none'] }: `only`"), "{warned}");
}
