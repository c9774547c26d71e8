//! Filter files: the examples do what their text says, and every file under `lens-specs/invalid/wgsl` is refused with
//! the whole text of the refusal as a snapshot.

use std::fs;
use std::path::{Path, PathBuf};

use lenspeel::cli::report;
use lenspeel::custom::{Custom, Given, SurfaceValue, Value};
use lenspeel::spec::Source;

/// Columns of the reports.
const WIDTH: usize = 100;
/// A walk that finds fewer has looked in the wrong place.
const LEAST_REFUSED: usize = 60;

fn files(folder: &str) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("the folder is part of the project");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a readable folder").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "wgsl"))
        .collect();
    paths.sort();
    paths
}

fn stem(path: &Path) -> &str {
    path.file_stem().and_then(|stem| stem.to_str()).expect("a plain file name")
}

#[test]
fn every_invalid_filter_is_refused_as_recorded() {
    let mut settings = insta::Settings::clone_current();
    settings.set_omit_expression(true);
    let _bound = settings.bind_to_scope();
    let paths = files("lens-specs/invalid/wgsl");
    assert!(paths.len() >= LEAST_REFUSED, "only {} files", paths.len());
    for path in paths {
        let text = fs::read_to_string(&path).expect("a readable file");
        let name = format!("{}.wgsl", stem(&path));
        match Custom::parse(&text, &name) {
            Ok(_) => panic!("{name} is accepted"),
            Err(error) => insta::assert_snapshot!(stem(&path), report(&error, WIDTH, false)),
        }
    }
}

#[test]
fn files_that_exhaust_a_parser_are_refused() {
    let filter = |body: &str| format!("fn filter_color(c: vec3f, s: Surface) -> vec3f {{ {body} return c; }}");
    let long_sum = filter(&format!("let x = c.x{};", " + c.x".repeat(10_000)));
    let sum = filter(&format!("let x = c.x{};", " + c.x".repeat(1000)));
    let nested = filter(&format!("{}{}", "if c.x > 0.0 { ".repeat(500), "}".repeat(500)));
    let unary = filter(&format!("let x = {}c.x;", "- ".repeat(3000)));
    let long = filter(&"let x = c.x * c.y + c.z;\n".repeat(4000));
    let copies = filter(&format!("var a: array<f32, 1024>; let b = a; {}", "a = b; ".repeat(200)));
    let types = format!("alias A = {}f32{};", "array<".repeat(100), ", 1>".repeat(100)) + &filter("var a: A;");
    for (text, part) in [
        (&long_sum, "words and signs"),
        (&sum, "64 operations deep"),
        (&nested, "brace"),
        (&unary, "64 operations deep"),
        (&long, "a filter file has at most 65536"),
        (&copies, "each loop taken once, and 100000 are the most"),
        (&types, "16 deep"),
    ] {
        let error = Custom::parse(text, "long.wgsl").expect_err(part).to_string();
        assert!(error.contains(part), "{error}");
    }
}

/// However deep: accepted for both backends, or refused at a line of the file. naga counts for itself, and other things.
#[test]
fn what_nests_is_accepted_or_refused_where_it_stands() {
    let nested = |before: &str, middle: &str, behind: &str, n| [&before.repeat(n), middle, &behind.repeat(n)].concat();
    let forms: [(&str, &dyn Fn(usize) -> String); 11] = [
        ("blocks", &|n| nested("{", "", "}", n)),
        ("if", &|n| nested("if c.x > 0.0 {", "", "}", n)),
        ("else if", &|n| format!("if c.x > 0.0 {{}} {}", "else if c.x > 1.0 {} ".repeat(n))),
        ("for", &|n| nested("for (var i = 0; i < 2; i++) {", "", "}", n)),
        ("while", &|n| nested("while c.x > 0.0 {", "", "}", n)),
        ("continuing", &|n| nested("loop { continuing {", "", "break if true; } }", n)),
        ("switch", &|n| nested("switch 1 { default: {", "", "}}", n)),
        ("brackets", &|n| format!("let x = {};", nested("(", "c", ")", n))),
        ("index", &|n| format!("let x = {};", nested("c[i32(", "c.x", ")]", n))),
        ("select", &|n| format!("let x = {};", nested("select(c, ", "c", ", c.x > 0.0)", n))),
        ("not", &|n| format!("let x = {}(c.x > 0.0);", "!".repeat(n))),
    ];
    for (name, form) in forms {
        let mut accepted = 0;
        for n in (4..40).chain((40..140).step_by(3)).chain([500]) {
            let text = format!("fn filter_color(c: vec3f, s: Surface) -> vec3f {{\n{}\nreturn c;\n}}", form(n));
            match Custom::parse(&text, "deep.wgsl") {
                Ok(_) => accepted += 1,
                Err(error) => assert_eq!(error.line(), Some(2), "{n} times {name}: {error}"),
            }
        }
        assert!((10..=70).contains(&accepted), "{name}: {accepted} accepted");
    }
}

#[test]
fn files_that_are_no_text_or_too_large_are_refused_as_a_whole() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
    let refused = |name: &str, bytes: &[u8]| {
        let path = folder.join(name);
        fs::write(&path, bytes).expect("a file");
        let error = Custom::open(&path).expect_err("no filter");
        assert!(error.source_text.is_none() && error.message.contains(name), "{error}");
        error.to_string()
    };
    let latin = refused("latin.wgsl", b"// fine\n// gr\xfcn\nfn filter_color");
    assert!(latin.contains("line 2 is not UTF-8 (save it"), "{latin}");
    // Larger than what is read of it, with a letter across the end of that.
    let large = refused("large.wgsl", "€".repeat(100_000).as_bytes());
    assert!(large.contains("at most 65536 bytes"), "{large}");
    assert!(Custom::open(folder).is_err() && Custom::open(&folder.join("none.wgsl")).is_err());
}

fn example(name: &str) -> Custom {
    let text = fs::read_to_string(format!("lens-specs/wgsl/{name}.wgsl")).expect("an example");
    Custom::parse(&text, name).unwrap_or_else(|error| panic!("{}", report(&error, WIDTH, false)))
}

fn words(custom: &Custom, given: &[(&str, Value)]) -> Vec<u32> {
    let source = Source::new("spec.toml", "");
    let given: Vec<Given> =
        given.iter().map(|(name, value)| Given { name: (*name).into(), span: 0..0, value: value.clone() }).collect();
    custom.values(&source, &given).expect("values of the right types")
}

const SURFACE: SurfaceValue = SurfaceValue {
    position: [0.0; 3],
    normal: [0.0, 0.0, 1.0],
    view: [0.0, 0.0, 1.0],
    base_color: [0.2, 0.4, 0.6],
    metallic: 0.0,
    roughness: 0.5,
    emissive: [0.0; 3],
    occlusion: 1.0,
    opacity: 1.0,
    unlit: 0.0,
    pixel: [0.0; 2],
    depth: 1.0,
};

#[test]
fn all_examples_are_tested_here() {
    let names: Vec<String> = files("lens-specs/wgsl").iter().map(|path| stem(path).to_owned()).collect();
    assert_eq!(names, ["bumps", "rim", "stripes", "thermal"]);
}

#[test]
fn stripes_are_level_and_spaced_as_asked() {
    let stripes = example("stripes");
    let red = Value::Numbers(vec![1.0, 0.0, 0.0]);
    let words = words(&stripes, &[("color", red), ("spacing", Value::Number(0.5)), ("softness", Value::Number(0.0))]);
    let at = |position| stripes.surface(&SurfaceValue { position, ..SURFACE }, &words);
    for (position, painted) in [
        ([0.0, 0.0, 0.0], true),
        ([7.0, 0.07, -3.0], true),
        ([0.0, 0.08, 0.0], false),
        ([0.0, 0.25, 0.0], false),
        ([1.0, 0.5, 2.0], true),
        ([0.0, -1.0, 0.0], true),
        ([0.0, -0.75, 0.0], false),
    ] {
        let expected = if painted { [1.0, 0.0, 0.0] } else { SURFACE.base_color };
        let surface = at(position);
        assert_eq!(surface.base_color, expected, "at {position:?}");
        assert_eq!(SurfaceValue { base_color: SURFACE.base_color, ..surface }, SurfaceValue { position, ..SURFACE });
    }
}

#[test]
fn the_rim_glows_where_the_surface_turns_away() {
    let rim = example("rim");
    let words = words(
        &rim,
        &[("color", Value::Text("white".into())), ("strength", Value::Number(4.0)), ("falloff", Value::Number(2.0))],
    );
    let glow = |normal| rim.surface(&SurfaceValue { normal, emissive: [0.5; 3], ..SURFACE }, &words).emissive;
    assert_eq!(glow([0.0, 0.0, 1.0]), [0.5; 3]);
    assert_eq!(glow([1.0, 0.0, 0.0]), [4.5; 3]);
    let half = glow([0.75_f32.sqrt(), 0.0, 0.5]);
    assert!(half.iter().all(|x| (x - 1.5).abs() < 1e-5), "{half:?}");
}

#[test]
fn bumps_turn_the_normal_away_from_where_the_noise_grows() {
    let bumps = example("bumps");
    let noise =
        Custom::parse("fn filter_color(c: vec3f, s: Surface) -> vec3f { return vec3f(noise3(c)); }", "noise.wgsl");
    let noise = noise.expect("a filter");
    let of = |height| words(&bumps, &[("size", Value::Number(1.0)), ("height", Value::Number(height))]);
    let mut turned = 0.0_f32;
    for i in 0..20 {
        let position = [0.37 * i as f32, 0.2, 0.1];
        let at = |x: f32| noise.color([position[0] + x, position[1], position[2]], &SURFACE, &[])[0];
        let grows = at(0.05) - at(-0.05);
        let normal = bumps.surface(&SurfaceValue { position, ..SURFACE }, &of(0.5)).normal;
        assert!(normal[0] * grows <= 0.0, "{normal:?} where the noise grows by {grows}");
        assert!((normal.iter().map(|x| x * x).sum::<f32>() - 1.0).abs() < 1e-5 && normal[2] > 0.5, "{normal:?}");
        turned = turned.max(normal[0].abs());
        assert_eq!(bumps.surface(&SurfaceValue { position, ..SURFACE }, &of(0.0)).normal, SURFACE.normal);
    }
    assert!(turned > 0.2, "at most {turned}");
}

#[test]
fn heat_runs_from_black_to_white() {
    let thermal = example("thermal");
    let default = words(&thermal, &[]);
    let of = |c| thermal.color(c, &SURFACE, &default);
    assert_eq!(of([0.0; 3]), [0.0; 3]);
    let white = of([1.0; 3]);
    assert!(white.iter().all(|x| (x - 1.0).abs() < 1e-5), "{white:?}");
    let red = of([0.5; 3]);
    assert!(red[0] > 0.7 && red[1] < 0.05 && red[2] < 0.05, "{red:?}");
    assert!(of([0.25; 3])[2] > of([0.25; 3])[0], "violet");
    let half = words(&thermal, &[("amount", Value::Number(0.0))]);
    assert_eq!(thermal.color([0.3, 0.2, 0.1], &SURFACE, &half), [0.3, 0.2, 0.1]);
}

/// The three examples once more, in Rust.
mod twin {
    pub fn stripes(y: f32, base: [f32; 3], color: [f32; 3], [spacing, share, softness]: [f32; 3]) -> [f32; 3] {
        let from_middle = (y / spacing - (y / spacing).round()).abs();
        let amount = ((0.5 * share - from_middle) / softness + 0.5).clamp(0.0, 1.0);
        std::array::from_fn(|i| base[i] + (color[i] - base[i]) * amount)
    }

    pub fn rim(cos: f32, color: [f32; 3], strength: f32, falloff: f32) -> [f32; 3] {
        color.map(|c| strength * (1.0 - cos.clamp(0.0, 1.0)).powf(falloff) * c)
    }

    pub fn thermal(c: [f32; 3], low: f32, high: f32) -> [f32; 3] {
        const STOPS: [[f32; 3]; 5] = [[0.0; 3], [0.35, 0.0, 0.55], [0.9, 0.1, 0.2], [1.0, 0.8, 0.1], [1.0; 3]];
        let luminance = 0.2126 * c[0] + 0.7152 * c[1] + 0.0722 * c[2];
        let at = 4.0 * ((luminance - low) / (high - low)).clamp(0.0, 1.0);
        let below = (at as usize).min(3);
        std::array::from_fn(|i| {
            let encoded = STOPS[below][i] + (STOPS[below + 1][i] - STOPS[below][i]) * (at - below as f32);
            if encoded <= 0.04045 { encoded / 12.92 } else { ((encoded + 0.055) / 1.055).powf(2.4) }
        })
    }
}

fn same(got: [f32; 3], want: [f32; 3]) -> Result<(), proptest::test_runner::TestCaseError> {
    let near = (0..3).all(|i| (got[i] - want[i]).abs() <= 1e-4 * want[i].abs().max(1.0));
    proptest::prop_assert!(near, "{got:?} and not {want:?}");
    Ok(())
}

proptest::proptest! {
    #[test]
    fn the_examples_agree_with_rust_on_random_input(
        c in proptest::array::uniform3(0.0_f32..1.0),
        color in proptest::array::uniform3(0.0_f32..1.0),
        y in -5.0_f32..5.0,
        angle in 0.0_f32..3.0,
        settings in (0.1_f32..2.0, 0.1_f32..0.9, 0.05_f32..0.4),
        ends in (0.0_f32..0.4, 0.5_f32..1.5),
    ) {
        let number = |x: f32| Value::Number(f64::from(x));
        let linear = || Value::Numbers(color.map(f64::from).to_vec());
        let (spacing, share, softness) = settings;

        let stripes = example("stripes");
        let given = [("color", linear()), ("spacing", number(spacing)), ("share", number(share)), ("softness", number(softness))];
        let surface = SurfaceValue { position: [c[0], y, c[1]], base_color: c, ..SURFACE };
        let got = stripes.surface(&surface, &words(&stripes, &given)).base_color;
        same(got, twin::stripes(y, c, color, [spacing, share, softness]))?;

        let rim = example("rim");
        let given = [("color", linear()), ("strength", number(spacing)), ("falloff", number(share * 4.0))];
        let surface = SurfaceValue { normal: [angle.sin(), 0.0, angle.cos()], ..SURFACE };
        let got = rim.surface(&surface, &words(&rim, &given)).emissive;
        same(got, twin::rim(angle.cos(), color, spacing, share * 4.0))?;

        let thermal = example("thermal");
        let given = [("low", number(ends.0)), ("high", number(ends.1))];
        same(thermal.color(c, &SURFACE, &words(&thermal, &given)), twin::thermal(c, ends.0, ends.1))?;
    }
}
