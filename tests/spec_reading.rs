//! Valid specs mean what they say, and no text makes the reader panic.

use std::path::Path;

use lenspeel::InputError;
use lenspeel::spec::{
    At, Attach, CameraPlace, Color, Condition, Convex, Filter, ImageSpec, ProjectionSpec, Rotation, SceneChoice, Shape,
    ShowWhat, Spec, ToneMapping, WireEdges,
};
use proptest::prelude::*;

/// Every table and most keys that this version draws.
const WHOLE: &str = include_str!("data/whole.toml");

fn parse(text: &str) -> Result<Spec, InputError> {
    Spec::parse(text, "spec.toml", Path::new("folder"))
}

fn whole() -> Spec {
    parse(WHOLE).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn scene_and_image() {
    let spec = whole();
    assert_eq!(spec.scene.file.value, Path::new("folder/models/engine.glb"));
    assert_eq!(spec.scene.scene.map(|choice| choice.value), Some(SceneChoice::Name("Assembly".to_owned())));
    let alternates: Vec<&str> = spec.scene.alternates.iter().map(|(name, _)| name.as_str()).collect();
    assert_eq!(alternates, ["zebra", "bones"], "file order");
    assert_eq!(
        spec.image,
        ImageSpec { size: [640, 480], samples: 9, background: None, tone_mapping: ToneMapping::None, legend: true }
    );
}

#[test]
fn camera_and_light() {
    let spec = whole();
    let camera = spec.camera.expect("the file has a [camera]").value;
    let CameraPlace::Free { eye, target, projection, .. } = camera.place else { panic!("placed by hand") };
    assert_eq!((eye, target), (Some([3.0, 2.0, 4.0]), Some([0.0; 3])));
    assert_eq!(projection, ProjectionSpec::FovY(40.0));
    let light = spec.light.expect("the file has a [light]");
    assert_eq!(light.directional.iter().map(|light| light.intensity).collect::<Vec<_>>(), [2.5, 1.0]);
}

#[test]
fn lenses() {
    let spec = whole();
    let [shell, probe, cut, _] = spec.lenses.as_slice() else { panic!("four lenses") };
    assert_eq!(shell.shape.value, Shape::Sphere { center: [0.0; 3], radius: 0.8 });
    assert!(shell.glass.is_none() && shell.attach.value == Attach::Node("Wheel".to_owned()));
    assert_eq!(shell.rotation, Rotation::Quaternion([0.0, 0.0, 0.0, 2.0]));
    assert_eq!(shell.scale, [2.0; 3]);
    let tint = Filter::Tint { color: Color::rgb(0x3f, 0xa7, 0xff), amount: 0.4 };
    assert_eq!(
        shell.filters[0].value,
        Filter::Wireframe { width: 1.0, color: None, fill: 0.0, hidden: true, edges: WireEdges::All }
    );
    assert_eq!(shell.filters[1].value, tint);
    let Shape::Box { center, size, .. } = probe.shape.value else { panic!("a box") };
    assert_eq!((center, size), ([0.5, 1.0, 1.5], [1.0, 2.0, 3.0]));
    let Filter::Show(ShowWhat::Alternate { name, .. }) = &cut.filters[0].value else { panic!("show") };
    assert_eq!(name.value, "bones");
    assert!(!cut.enabled && cut.priority == -3);
    assert_eq!([probe, cut].map(|lens| lens.glass.map(|glass| glass.contact)), [Some(2.0), Some(0.0)]);
}

#[test]
fn compounds_and_meshes() {
    let spec = whole();
    let ring = &spec.lenses[3].shape;
    let Shape::Difference(list) = &ring.value else { panic!("a difference") };
    assert!(matches!(list[0].value, Shape::Union(_)) && matches!(list[1].value, Shape::Intersection(_)));
    let parts = ring.parts();
    let [ball, meshes @ ..] = parts.as_slice() else { panic!("four parts") };
    assert_eq!(ball.value, Shape::Sphere { center: [0.0; 3], radius: 2.0 });
    let mesh = |part: &&At<Shape>| match &part.value {
        Shape::Mesh(mesh) => (mesh.file.value.clone(), mesh.node.as_ref().map(|n| n.value.clone()), mesh.convex),
        other => panic!("{other:?} is no mesh"),
    };
    let wanted = [("a", Some("Rim"), Convex::AsItStands), ("b", None, Convex::Hull), ("c", None, Convex::Decompose)];
    let wanted =
        wanted.map(|(file, node, convex)| (format!("folder/{file}.glb").into(), node.map(str::to_owned), convex));
    assert_eq!(meshes.iter().map(mesh).collect::<Vec<_>>(), wanted);
    assert!(WHOLE[meshes[2].span.clone()].starts_with("mesh = { file = \"c.glb\""), "the place of a part");
}

#[test]
fn places_are_those_of_the_file() {
    let spec = whole();
    for lens in &spec.lenses {
        assert_eq!(WHOLE[lens.name.span.clone()], format!("\"{}\"", lens.name.value));
    }
    assert!(WHOLE[spec.lenses[0].shape.span.clone()].starts_with("sphere = {"));
    assert_eq!(&WHOLE[spec.lenses[0].over[1].span.clone()], "\"cut-*\"");
}

/// With parentheses around everything.
fn shown(condition: &Condition) -> String {
    match condition {
        Condition::Lens(pattern) => {
            assert_eq!(WHOLE[pattern.span.clone()], pattern.value.0, "the place of a name in a condition");
            pattern.value.0.clone()
        }
        Condition::Not(inner) => format!("!{}", shown(inner)),
        Condition::And(left, right) => format!("({} & {})", shown(left), shown(right)),
        Condition::Or(left, right) => format!("({} | {})", shown(left), shown(right)),
    }
}

#[test]
fn conditions_bind_not_before_and_before_or() {
    let shown: Vec<String> = whole().overlaps.iter().map(|rule| shown(&rule.when.value)).collect();
    assert_eq!(shown, ["((shell & !probe) | (cut-* & shell))", "(!!shell & (probe | cut-1))"]);
}

#[test]
fn a_disabled_lens_may_be_named_by_an_edge() {
    let text = "[scene]\nfile = \"a.glb\"\n[[lens]]\nname = \"a\"\nenabled = false\nshape.sphere = { center = [0, 0, 0], \
                radius = 1 }\n[[lens]]\nname = \"b\"\nover = [\"a\"]\nshape.sphere = { center = [0, 0, 0], radius = 1 }\n";
    assert!(parse(text).is_ok());
}

fn sphere(name: &str, keys: &str) -> String {
    format!("[[lens]]\nname = \"{name}\"\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\n{keys}\n")
}

fn refused(lenses: &str) -> InputError {
    parse(&format!("[scene]\nfile = \"a.glb\"\n{lenses}")).expect_err("it is refused")
}

#[test]
fn what_a_key_names_twice_it_names_once() {
    let text = format!("[scene]\nfile = \"a.glb\"\n{}{}", sphere("a", ""), sphere("b", "over = ['a', '*', 'a', '*']"));
    let over: Vec<String> = parse(&text).expect("a spec").lenses[1].over.iter().map(|p| p.value.0.clone()).collect();
    assert_eq!(over, ["a", "*"]);
}

#[test]
fn patterns_over_very_many_lenses_are_refused_with_the_number() {
    let lenses: String = (0..2000).map(|i| sphere(&format!("l{i}"), "enabled = false")).collect();
    let patterns: Vec<String> = (0..150_000).map(|i| format!("'*{i}'")).collect();
    let error = refused(&(lenses + &sphere("last", &format!("over = [{}]", patterns.join(",")))));
    assert!(error.message.contains("over the names of 2001 lenses") && error.message.contains("268435456"), "{error}");
}

#[test]
fn of_many_unknown_names_the_first_get_suggestions() {
    let names: Vec<String> = (0..30).map(|i| format!("'first{i}'")).collect();
    let error = refused(&(sphere("first", "") + &sphere("b", &format!("over = [{}]", names.join(",")))));
    let helps: Vec<&str> =
        std::iter::once(&error).chain(&error.others).filter_map(|error| error.help.as_deref()).collect();
    let suggested = helps.iter().filter(|help| help.contains("did you mean `first`?")).count();
    assert_eq!((helps.len(), suggested), (30, 20));
}

#[test]
fn planes_of_disabled_lenses_count() {
    let planes = vec!["[1, 0, 0, 1]"; 16_385].join(",");
    let lens = format!("[[lens]]\nname = 'a'\nenabled = false\nshape.polytope = {{ planes = [{planes}] }}\n");
    assert!(refused(&lens).message.contains("16385 planes"), "{}", refused(&lens));
}

#[test]
fn names_are_as_long_as_said() {
    let (long, longer) = ("x".repeat(256), "x".repeat(257));
    let error = refused(&sphere(&longer, "")).message;
    assert!(error.contains("a lens name has at most 256 characters, and this one has 257"), "{error}");
    let alternate = |name: &str| parse(&format!("[scene]\nfile = \"a.glb\"\nalternates.{name} = \"b.glb\"\n"));
    assert!(alternate(&long).is_ok());
    // Two bytes each.
    assert!(alternate(&format!("\"{}\"", "é".repeat(256))).is_ok());
    let error = alternate(&longer).expect_err("it is too long").message;
    assert!(error.contains("the name of an alternate has at most 256 characters, and this one has 257"), "{error}");
}

#[test]
fn a_condition_as_deep_as_allowed_is_read_and_dropped() {
    let rule = |when: String| {
        parse(&format!(
            "[scene]\nfile = \"a.glb\"\n[[lens]]\nname = \"a\"\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\n\
             [[overlap]]\nwhen = \"{when}\"\nfilters = []\n"
        ))
    };
    assert!(rule(format!("{}a", "!".repeat(999))).is_ok());
    assert!(rule(format!("{}a{}", "(".repeat(499), ")".repeat(499))).is_ok());
    let error = rule(format!("a{}", "|a".repeat(100_000))).expect_err("too long");
    assert!(error.message.contains("at most 1000"), "{error}");
}

#[test]
fn deep_nesting_is_an_error_rather_than_an_overflow() {
    let [open, close] = ["{ union = [".repeat(10_000), "] }".repeat(10_000)];
    let text = format!("[scene]\nfile = \"a.glb\"\n[[lens]]\nname = \"a\"\nshape = {open}{close}\n");
    let error = parse(&text).expect_err("too deep");
    assert!(error.message.contains("recursion depth"), "{}", error.message);
}

/// An error's text can always be printed, with its lines.
fn read_and_report(text: &str) {
    if let Err(error) = parse(text) {
        assert!(!lenspeel::cli::report(&error, false).is_empty());
        assert!(!error.message.is_empty());
    }
}

/// Cuts, doubles or replaces a stretch of the whole spec.
fn mutated() -> impl Strategy<Value = String> {
    let piece = prop_oneof![
        Just("nan"),
        Just("-inf"),
        Just("1e400"),
        Just("\"ä\""),
        Just("[]"),
        Just("{}"),
        Just("\n[[lens]]\n"),
        Just("= "),
        Just("0"),
        Just("-1"),
        Just("true"),
        Just("'''"),
        Just("\"!((&*\""),
        Just("1979-05-27"),
        Just(""),
    ];
    let edit = (0..WHOLE.len(), 0usize..24, piece);
    prop::collection::vec(edit, 1..4).prop_map(|edits| {
        let mut bytes = WHOLE.as_bytes().to_vec();
        for (at, length, piece) in edits {
            let start = at.min(bytes.len());
            let end = (start + length).min(bytes.len());
            bytes.splice(start..end, piece.bytes());
        }
        String::from_utf8_lossy(&bytes).into_owned()
    })
}

/// Replaces one value by another of some kind, so that the text stays TOML and the readers see it.
fn value_replaced() -> impl Strategy<Value = String> {
    let values = [
        "nan",
        "-0.0",
        "1e300",
        "1e-300",
        "\"\"",
        "\"x\"",
        "[]",
        "[0, 0, 0]",
        "[0, 0, 0, 0]",
        "{}",
        "{ a = 1 }",
        "true",
        "-9223372036854775808",
        "1979-05-27",
        "[[[]]]",
        "\"#ffffff\"",
        "'&'",
        "\"\\u0000\"",
        "\"*\"",
    ];
    let lines: Vec<usize> = (0..WHOLE.lines().count()).collect();
    (prop::sample::select(lines), prop::sample::select(values.to_vec())).prop_map(|(number, value)| {
        let replace = |(i, line): (usize, &str)| match line.split_once(" = ") {
            Some((key, _)) if i == number => format!("{key} = {value}"),
            _ => line.to_owned(),
        };
        WHOLE.lines().enumerate().map(replace).collect::<Vec<_>>().join("\n")
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 1000, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn arbitrary_text_never_panics(text in any::<String>()) {
        read_and_report(&text);
    }

    #[test]
    fn arbitrary_conditions_never_panic(when in "[a-c!&|()*? ä]{0,24}") {
        let text = format!(
            "[scene]\nfile = \"a.glb\"\n[[lens]]\nname = \"a\"\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\n\
             [[overlap]]\nwhen = \"{when}\"\nfilters = []\n"
        );
        read_and_report(&text);
    }

    #[test]
    fn mutated_specs_never_panic(text in mutated()) {
        read_and_report(&text);
    }

    #[test]
    fn replaced_values_never_panic(text in value_replaced()) {
        read_and_report(&text);
    }
}
