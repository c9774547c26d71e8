//! Statements, calls, pointers, and the budget of loops.

use super::{SURFACE, colored, read};
use crate::custom::LOOP_BUDGET;

const C: [f32; 3] = [3.0, 1.0, 2.0];

/// A body of `filter_color`, with functions in front of it.
fn with(functions: &str, body: &str) -> [f32; 3] {
    read(&format!("{functions} fn filter_color(c: vec3f, s: Surface) -> vec3f {{ {body} }}")).color(C, &SURFACE, &[])
}

#[test]
fn loops_break_and_continue() {
    for (body, expected) in [
        ("var n = 0.0; for (var i = 0; i < 10; i++) { n += f32(i); } return vec3f(n);", 45.0),
        ("var n = 0.0; var i = 0; while i < 10 { i++; if i % 2 == 0 { continue; } n += f32(i); } return vec3f(n);", 25.0),
        ("var n = 0.0; loop { n += 1.0; if n > c.x { break; } } return vec3f(n);", 4.0),
        ("var n = 0.0; loop { n += 1.0; continuing { n += 1.0; break if n > c.x; } } return vec3f(n);", 4.0),
        ("for (var i = 0; ; i++) { if f32(i) > c.x { return vec3f(f32(i)); } }", 4.0),
        ("var n = 0.0; for (var i = 0; i < 4; i++) { for (var j = i; j < 4; j++) { if j == 2 { break; } n += 1.0; } }
            return vec3f(n);", 4.0),
        ("var n = 0.0; for (var i = 0; i < 3; i++) { var fresh = 1.0; fresh += f32(i); n += fresh; } return vec3f(n);", 6.0),
        ("var n = 0.0; for (var i = 0; i < 3; i++) { var fresh: f32; fresh += 1.0; n += fresh; } return vec3f(n);", 3.0),
    ] {
        assert_eq!(colored(body, C), [expected; 3], "{body}");
    }
}

#[test]
fn a_switch_takes_one_of_its_cases() {
    let body = "var n = 0.0;
        for (var i = 0; i < 6; i++) {
            switch i {
                case 0, 1: { n += 1.0; }
                case 2: { n += 10.0; break; }
                case 3: { continue; }
                default: { n += 100.0; }
            }
            n += 1000.0;
        }
        return vec3f(n);";
    assert_eq!(colored(body, C)[0], 5212.0);
    let unsigned = "switch u32(c.x) { case 3u: { return c.zzz; } default: { return c.yyy; } }";
    assert_eq!(colored(unsigned, C), [2.0; 3]);
}

#[test]
fn functions_take_values_and_pointers() {
    let add = "fn add(to: ptr<function, vec3f>, i: u32, x: f32) -> f32 { (*to)[i] += x; return (*to)[i]; }";
    assert_eq!(
        with(add, "var v = c; let a = add(&v, 0u, 1.0); let b = add(&v, 1u, a); return v + b;"),
        [9.0, 10.0, 7.0]
    );
    let nested = "struct Deep { a: array<vec2f, 3>, n: f32 }
        fn touch(d: ptr<function, Deep>, i: i32) { (*d).a[i].y = 7.0; let p = &(*d).n; *p += 1.0; }";
    assert_eq!(
        with(nested, "var d: Deep; touch(&d, 2); touch(&d, 0); return vec3f(d.a[0].y, d.a[1].y + d.a[2].y, d.n);"),
        [7.0, 7.0, 2.0]
    );
    // Each call begins with its variables anew, and an argument outlives another call of the same function.
    let fresh = "fn count(x: f32) -> f32 { var n: f32; n += 1.0; var k = 2.0; k += n; return k * x; }";
    assert_eq!(with(fresh, "return vec3f(count(1.0) + count(count(2.0)), count(0.0), 0.0);"), [21.0, 0.0, 0.0]);
    let swap = "fn swap(a: ptr<function, f32>, b: ptr<function, f32>) { let t = *a; *a = *b; *b = t; }";
    assert_eq!(with(swap, "var x = c.x; var y = c.y; swap(&x, &y); return vec3f(x, y, 0.0);"), [1.0, 3.0, 0.0]);
}

#[test]
fn arrays_matrices_and_structs_are_values() {
    for (body, expected) in [
        (
            "var a = array(c.x, c.y, c.z); let i = u32(c.y); a[i] = 9.0; return vec3f(a[0], a[i], a[2]);",
            [3.0, 9.0, 2.0],
        ),
        ("let a = array(c, c + 1.0); return a[u32(c.y)];", [4.0, 2.0, 3.0]),
        ("var m = mat3x3f(); m[1] = c; m[2][0] = 5.0; let i = i32(c.y); return m[i] + m[i + 1];", [8.0, 1.0, 2.0]),
        (
            "var a = array<array<f32, 2>, 2>(); a[1][0] = 4.0; let b = a; a[1][0] = 0.0; return vec3f(b[1][0], a[1][0], b[0][1]);",
            [4.0, 0.0, 0.0],
        ),
        ("var v = c; v.z = v[u32(v.y)]; v.x += 1.0; return v;", [4.0, 1.0, 1.0]),
    ] {
        assert_eq!(colored(body, C), expected, "{body}");
    }
}

#[test]
fn an_index_out_of_range_is_clamped_as_the_gpu_clamps_it() {
    for (index, expected) in [("u32(c.x)", 2.0), ("i32(c.x) + 100", 2.0), ("-i32(c.x)", 2.0), ("i32(c.x) - 3", 3.0)] {
        let value = format!("let a = array(c.x, c.y, c.z); return vec3f(a[{index}]);");
        assert_eq!(colored(&value, C), [expected; 3], "{value}");
        let place = format!("var v = c; v[{index}] = 8.0; return v - c;");
        let changed = colored(&place, C).iter().position(|x| *x != 0.0);
        assert_eq!(changed, Some(if expected == 2.0 { 2 } else { 0 }), "{place}");
    }
}

#[test]
fn constants_of_the_file_are_computed_once() {
    let constants =
        "const A = 2.0; const B = array(vec3f(A), vec3f(A * A, 1.0, 0.0)); const M = mat2x2f(1.0, 2.0, 3.0, 4.0);
        alias Pair = vec2f; const_assert A > 1.0;";
    assert_eq!(with(constants, "return B[u32(c.y)] + vec3f(M * Pair(c.y, 0.0), 0.0);"), [5.0, 3.0, 0.0]);
}

#[test]
fn loops_end_when_the_budget_is_spent() {
    let count = LOOP_BUDGET as f32;
    assert_eq!(colored("var n = 0.0; loop { n += 1.0; if n < 0.0 { break; } } return vec3f(n);", C), [count; 3]);
    assert_eq!(colored("var n = 0.0; while true { n += 1.0; } return vec3f(n);", C), [count; 3]);
    // All loops and functions share it; what comes behind a spent loop still runs.
    let shared = "fn spin() -> f32 { var n = 0.0; for (var i = 0; i < 3000; i++) { n += 1.0; } return n; }";
    assert_eq!(with(shared, "return vec3f(spin(), spin(), spin());"), [3000.0, count - 3001.0, 0.0]);
    let nested =
        "var n = 0.0; for (var i = 0; i < 1000; i++) { for (var j = 0; j < 1000; j++) { n += 1.0; } } return vec3f(n);";
    let outer = (LOOP_BUDGET / 1002) as f32;
    assert!(colored(nested, C)[0] > 1000.0 * outer && colored(nested, C)[0] < count, "{:?}", colored(nested, C));
    // A function that only a loop leaves gives zero.
    let endless = "fn never(x: f32) -> vec3f { loop { if x < 0.0 { return vec3f(1.0); } } }";
    assert_eq!(with(endless, "return never(c.x) + never(-c.x);"), [0.0; 3]);
    // The next call has a budget of its own.
    let filter = read(&format!("{shared} fn filter_color(c: vec3f, s: Surface) -> vec3f {{ return vec3f(spin()); }}"));
    assert_eq!([0; 3].map(|_| filter.color(C, &SURFACE, &[])[0]), [3000.0; 3]);
}

#[test]
fn the_helpers_of_the_contract_do_what_they_say() {
    let body = "return linear_from_srgb(srgb_from_linear(c * 0.25));";
    colored(body, C).iter().zip(C).for_each(|(got, c)| assert!((got - 0.25 * c).abs() < 1e-6));
    assert!((colored("return vec3f(luminance(vec3f(1.0)));", C)[0] - 1.0).abs() < 1e-6);
    let stripes = colored("return vec3f(stripe(2.0, 0.5, 0.0), stripe(2.5, 0.5, 0.0), stripe(2.25, 0.5, 0.1));", C);
    assert_eq!(stripes, [1.0, 0.0, 0.5]);
    assert_eq!(colored("return vec3f(stripe(c.x + 0.3, 0.4, 2.0));", C), [0.4; 3]);
    let noise = |x: f32| colored("return vec3f(noise3(vec3f(c.x, 0.5, 0.25)));", [x, 0.0, 0.0])[0];
    let values: Vec<f32> = (0..200).map(|i| noise(i as f32 * 0.1 - 10.0)).collect();
    assert!(values.iter().all(|x| (0.0..=1.0).contains(x)));
    let (low, high) = values.iter().fold((1.0_f32, 0.0_f32), |(low, high), x| (low.min(*x), high.max(*x)));
    assert!(high - low > 0.3, "noise from {low} to {high} says little");
    assert!(values.windows(2).all(|pair| (pair[1] - pair[0]).abs() < 0.25), "noise jumps");
}
