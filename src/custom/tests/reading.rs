//! What reading a file finds: functions, parameters, the text for the GPU.

use super::{SURFACE, read};
use crate::custom::{Custom, FieldKind, Given, Value, wgsl};
use crate::spec::Source;

const PARAMS: &str = "struct Params {
    strength: f32, // = 0.5: how strong
    /// = [1, 2, 3]: where
    at: vec3f,
    tone: vec4f,   // = \"#ff000080\"
    count: i32,    // = -3
    mask: u32,     // = 7
    loud: bool,    // = true
    size: vec2f,
}
fn filter_surface(s: Surface, p: Params) -> Surface {
    var r = s;
    r.position = p.at;
    r.base_color = p.tone.rgb;
    r.opacity = p.tone.a;
    r.metallic = p.strength;
    r.roughness = f32(p.count);
    r.unlit = f32(p.mask);
    r.occlusion = select(0.0, 1.0, p.loud);
    r.pixel = p.size;
    return r;
}
fn filter_color(c: vec3f, s: Surface) -> vec3f { return c * s.metallic; }";

fn spec() -> Source {
    Source::new("test.toml", "x")
}

fn given(name: &str, value: Value) -> Given {
    Given { name: name.into(), span: 0..1, value }
}

fn values(custom: &Custom, name: &str, value: Value) -> Result<Vec<u32>, String> {
    custom.values(&spec(), &[given(name, value)]).map_err(|error| error.to_string())
}

#[test]
fn parameters_are_read_with_defaults_and_help() {
    let custom = read(PARAMS);
    let fields: Vec<_> = custom.params().iter().map(|f| (f.name.as_str(), f.kind, f.doc.as_str())).collect();
    let expected = [
        ("strength", FieldKind::Float, "how strong"),
        ("at", FieldKind::Vec3, "where"),
        ("tone", FieldKind::Vec4, ""),
        ("count", FieldKind::Int, ""),
        ("mask", FieldKind::Uint, ""),
        ("loud", FieldKind::Bool, ""),
        ("size", FieldKind::Vec2, ""),
    ];
    assert_eq!(fields, expected);
    let words = custom.values(&spec(), &[]).expect("defaults");
    let result = custom.surface(&SURFACE, &words);
    assert_eq!(result.position, [1.0, 2.0, 3.0]);
    assert_eq!(result.base_color, [1.0, 0.0, 0.0]);
    assert_eq!(result.opacity, 128.0 / 255.0);
    assert_eq!((result.metallic, result.roughness, result.unlit, result.occlusion), (0.5, -3.0, 7.0, 1.0));
    assert_eq!(result.pixel, [0.0; 2]);
    assert_eq!(result.depth, SURFACE.depth);
    assert_eq!(custom.color([2.0, 4.0, 8.0], &SURFACE, &words), [0.5, 1.0, 2.0]);
}

#[test]
fn what_a_spec_gives_is_checked() {
    let custom = read(PARAMS);
    let float = |x: f32| x.to_bits();
    assert_eq!(values(&custom, "strength", Value::Number(2.0)).expect("a number")[0], float(2.0));
    assert_eq!(values(&custom, "count", Value::Number(-7.0)).expect("a whole number")[8], -7_i32 as u32);
    assert_eq!(values(&custom, "at", Value::Text("white".into())).expect("a colour")[1..4], [float(1.0); 3]);
    assert_eq!(
        values(&custom, "size", Value::Numbers(vec![3.0, 4.0])).expect("a pair")[11..],
        [float(3.0), float(4.0)]
    );
    for (name, value, part) in [
        ("strenght", Value::Number(1.0), "the filter has no parameter `strenght` (did you mean `strength`?)"),
        ("strength", Value::Bool(true), "`strength` must be a number, not true (it is: how strong)"),
        ("strength", Value::Number(1e300), "not 1e300, which no f32 holds"),
        ("strength", Value::Number(f64::NAN), "which no f32 holds"),
        ("at", Value::Numbers(vec![1.0]), "`at` must be a list of 3 numbers or a colour, but has 1"),
        ("at", Value::Text("#12345".into()), "not \"#12345\""),
        ("at", Value::Text("#12345678".into()), "has an alpha"),
        ("count", Value::Number(0.5), "`count` must be a whole number of 32 bits, not 0.5"),
        ("count", Value::Number(3e9), "not 3000000000"),
        ("mask", Value::Number(-1.0), "`mask` must be a whole number from 0 to 4294967295, not -1"),
        ("loud", Value::Number(1.0), "`loud` must be true or false, not a number"),
        ("size", Value::Text("red".into()), "`size` must be a list of 2 numbers, not a string"),
    ] {
        let error = values(&custom, name, value).expect_err(name);
        assert!(error.contains(part) && error.starts_with("test.toml:1: "), "{error}");
    }
    let none = read("fn filter_color(c: vec3f, s: Surface) -> vec3f { return c; }");
    assert!(values(&none, "a", Value::Bool(true)).expect_err("no Params").contains("no `struct Params`"));
}

#[test]
fn all_filters_of_a_picture_stand_in_one_shader() {
    let one = read(PARAMS);
    // Names that end in digits, that are the host's, and that look like ours.
    let two = read(
        "struct Params { a: f32, size2: vec2f } struct Pair1 { x1: f32 }
        const custom_words = 3.0;
        fn helper2(custom1_filter_surface: f32) -> f32 { var custom1_fuel = custom1_filter_surface; return custom1_fuel + custom_words; }
        fn custom_surface(x: f32) -> f32 { let custom1_helper2 = x; return custom1_helper2; }
        fn filter_surface(s: Surface, p: Params) -> Surface {
            var r = s; let q = Pair1(p.size2.y);
            for (var i = 0; i < 3; i++) { r.depth += helper2(q.x1) + custom_surface(p.a); }
            return r;
        }",
    );
    let host = format!("@group(0) @binding(0) var<storage> custom_words: array<u32>;\n{}", wgsl(&[&one, &two, &one]));
    let module = naga::front::wgsl::parse_str(&host).unwrap_or_else(|e| panic!("{}", e.emit_to_string(&host)));
    naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty())
        .validate(&module)
        .unwrap_or_else(|e| panic!("{}", e.emit_to_string(&host)));
    for name in ["custom_surface", "custom_color", "custom0_surface", "custom1_surface", "custom2_color"] {
        assert!(module.functions.iter().any(|(_, f)| f.name.as_deref() == Some(name)), "{name} in {host}");
    }
    assert!(!host.contains("fn custom1_color"), "the second file has no `filter_color`");
    assert_eq!(two.surface(&SURFACE, &[1.0_f32.to_bits(), 0, 2.0_f32.to_bits()]).depth, SURFACE.depth + 18.0);
}

#[test]
fn a_file_may_use_our_names_for_its_own() {
    let custom = read(
        "struct Params { load: f32 }
        fn surface(fuel: f32) -> f32 { var größe = fuel; loop { größe += 1.0; if größe > 9.0 { break; } } return größe; }
        fn color(c: vec3f) -> vec3f { return c; }
        fn load() -> f32 { return 1.0; }
        fn fuel() -> f32 { return 2.0; }
        fn own_fuel() -> f32 { return 4.0; }
        fn filter_color(c: vec3f, s: Surface, p: Params) -> vec3f {
            return color(c) + vec3f(surface(1.0), load() + fuel(), own_fuel() + p.load);
        }",
    );
    assert_eq!(custom.color([0.0; 3], &SURFACE, &[0.5_f32.to_bits()]), [10.0, 3.0, 4.5]);
}

#[test]
fn lines_may_end_as_on_windows() {
    let custom = read(
        "struct Params {\r\n  a: f32, // = 2: how much\r\n}\r\nfn filter_color(c: vec3f, s: Surface, p: Params) -> vec3f {\r\n  return c * p.a;\r\n}\r\n",
    );
    assert_eq!((custom.params()[0].doc.as_str(), custom.params()[0].default[0]), ("how much", 2.0_f32.to_bits()));
}

/// Why a file with these declarations, and a filter that changes nothing, is refused.
fn refusal(declarations: &str) -> String {
    let text = format!("{declarations} fn filter_color(c: vec3f, s: Surface) -> vec3f {{ return c; }}");
    Custom::parse(&text, "test.wgsl").expect_err(declarations).to_string()
}

#[test]
fn names_by_which_the_contract_goes_are_taken_and_no_others() {
    // Declared by the file, they would mean the same to the contract's functions, in front of it.
    for declaration in [
        "fn max(a: f32, b: f32) -> f32 { return a; }",
        "fn mix(a: f32, b: f32, t: f32) -> f32 { return a; }",
        "const clamp = 1;",
        "alias f32 = i32;",
        "struct vec3f { a: i32 }",
    ] {
        let error = refusal(declaration);
        assert!(error.starts_with("test.wgsl:1: ") && error.contains("a name of WGSL itself"), "{error}");
    }
    let taken = refusal("fn f(custom_number_x: f32) {}");
    assert!(taken.contains("test.wgsl:1: names with `custom_number_` in them are taken"), "{taken}");
    let custom = read(
        "fn min(x: f32) -> f32 { return x + 1.0; } const z = 2.0; fn read(low: f32) -> f32 { let max = low; return max; }
        fn filter_color(c: vec3f, s: Surface) -> vec3f { return vec3f(min(c.x), z, read(c.y)); }",
    );
    assert_eq!(custom.color([1.0, 3.0, 0.0], &SURFACE, &[]), [2.0, 2.0, 3.0]);
}

#[test]
fn a_byte_order_mark_is_passed_over() {
    let text = "\u{feff}fn filter_color(c: vec3f, s: Surface) -> vec3f { return c; }";
    assert!(read(text).has_color());
    let error = Custom::parse(&text.replace("return c", "return d"), "test.wgsl").expect_err("no `d`");
    assert_eq!(error.labels[0].0, 56..57, "columns count from behind it");
}

#[test]
fn what_modf_gives_may_have_a_name_but_no_variable() {
    let of = |body: &str| format!("fn filter_color(c: vec3f, s: Surface) -> vec3f {{ {body} }}");
    for (body, part) in [
        ("var m = modf(c.x); m.fract += 1.0; return vec3f(m.fract);", "a `var` for what `modf` or `frexp` gives"),
        ("let m = array(frexp(c), frexp(c)); return m[0].fract;", "an array of what `modf` or `frexp` gives"),
    ] {
        let error = Custom::parse(&of(body), "test.wgsl").expect_err("no text for the GPU").to_string();
        assert!(error.starts_with("test.wgsl:1: ") && error.contains(part), "{error}");
    }
    assert_eq!(read(&of("let m = modf(c); return m.fract;")).color([1.5, 2.0, 3.25], &SURFACE, &[]), [0.5, 0.0, 0.25]);
}

#[test]
fn a_file_may_have_one_function_and_the_other_changes_nothing() {
    let surface = read("fn filter_surface(s: Surface) -> Surface { return s; }");
    assert!(surface.has_surface() && !surface.has_color());
    assert_eq!(surface.surface(&SURFACE, &[]), SURFACE);
    assert_eq!(surface.color([1.0, 2.0, 3.0], &SURFACE, &[]), [1.0, 2.0, 3.0]);
}

#[test]
fn a_file_that_leaves_opacity_alone_is_known() {
    let surface = |body: &str| read(&format!("fn filter_surface(s: Surface) -> Surface {{ {body} }}"));
    for body in [
        "return s;",
        "var r = s; r.base_color *= s.opacity; return r;",
        "var r = s; let copy = r; r = copy; r.unlit = copy.opacity; return r;",
    ] {
        assert!(!surface(body).may_change_opacity(), "{body}");
    }
    for body in [
        "var r = s; r.opacity = 0.5; return r;",
        "var r: Surface; r.base_color = s.base_color; return r;",
        "var r = Surface(); return r;",
        "var r : Surface /* zero */; if s.unlit > 2.0 { r = s; } return r;",
        "var r = array<Surface, 2>(); return r[1];",
    ] {
        assert!(surface(body).may_change_opacity(), "{body}");
    }
    let by_helper = "fn clear(r: ptr<function, Surface>) { (*r).opacity = 0.1; }
        fn filter_surface(s: Surface) -> Surface { var r = s; clear(&r); return r; }";
    assert!(read(by_helper).may_change_opacity());
    assert!(!read("fn filter_color(c: vec3f, s: Surface) -> vec3f { return c * s.opacity; }").may_change_opacity());
}

#[test]
fn filters_run_on_many_threads_at_once() {
    let custom = read(
        "fn filter_color(c: vec3f, s: Surface) -> vec3f {
        var n = c; for (var i = 0; i < 50; i++) { n = n * 1.5 - floor(n * 1.5); } return n; }",
    );
    let all = |custom: &Custom| -> Vec<[u32; 3]> {
        (0..200).map(|i| custom.color([0.1 + i as f32 * 0.003, 0.3, 0.7], &SURFACE, &[]).map(f32::to_bits)).collect()
    };
    let expected = all(&custom);
    std::thread::scope(|scope| {
        let threads: Vec<_> = (0..4).map(|_| scope.spawn(|| all(&custom))).collect();
        threads.into_iter().for_each(|thread| assert_eq!(thread.join().expect("no panic"), expected));
    });
}
