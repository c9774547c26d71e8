//! Every operator, in each kind of number.

use super::{bits, colored, number, signed};

#[test]
fn operators_of_floating_point_numbers() {
    let c = [7.5, 2.0, -0.5];
    for (expression, expected) in [
        ("c.x + c.y", 9.5),
        ("c.x - c.y", 5.5),
        ("c.x * c.y", 15.0),
        ("c.x / c.y", 3.75),
        ("c.x % c.y", 1.5),
        ("-c.x % c.y", -1.5),
        ("-c.z", 0.5),
        ("f32(c.x == c.y)", 0.0),
        ("f32(c.x != c.y)", 1.0),
        ("f32(c.x < c.y)", 0.0),
        ("f32(c.y <= c.y)", 1.0),
        ("f32(c.x > c.y)", 1.0),
        ("f32(c.z >= c.y)", 0.0),
        ("f32(c.x > 1.0 && c.y > 1.0)", 1.0),
        ("f32(c.x > 1.0 && c.z > 1.0)", 0.0),
        ("f32(c.z > 1.0 || c.y > 1.0)", 1.0),
        ("f32(!(c.z > 1.0))", 1.0),
        ("f32((c.x > 1.0) & (c.z > 1.0))", 0.0),
        ("f32((c.x > 1.0) | (c.z > 1.0))", 1.0),
        ("f32((c.x > 1.0) != (c.z > 1.0))", 1.0),
    ] {
        assert_eq!(number(expression, c), expected, "{expression}");
    }
}

#[test]
fn unsigned_numbers_wrap_and_divide_by_zero_as_wgsl_says() {
    let words = [7, 3, 33];
    for (expression, expected) in [
        ("a + b", 10),
        ("b - a", 4_u32.wrapping_neg()),
        ("a * 1000000000u", 7_u32.wrapping_mul(1_000_000_000)),
        ("a / b", 2),
        ("a % b", 1),
        ("a / (b - b)", 7),
        ("a % (b - b)", 0),
        ("a & b", 3),
        ("a | 8u", 15),
        ("a ^ b", 4),
        ("~a", !7),
        ("a << n", 14),
        ("a >> n", 3),
        ("u32(a < b)", 0),
        ("u32(a <= 7u)", 1),
        ("u32(a > b)", 1),
        ("u32(a >= 8u)", 0),
        ("u32(a == 7u)", 1),
        ("u32(a != 7u)", 0),
        ("u32(4294967295u > a)", 1),
    ] {
        assert_eq!(bits(expression, words), expected, "{expression}");
    }
}

#[test]
fn signed_numbers_wrap_and_divide_by_zero_as_wgsl_says() {
    let words = [i32::MIN, -3, 33];
    for (expression, expected) in [
        ("$a + $b", i32::MIN.wrapping_sub(3)),
        ("$b - $a", (-3_i32).wrapping_sub(i32::MIN)),
        ("$a * $b", i32::MIN.wrapping_mul(-3)),
        ("$a / ($b + 2i)", i32::MIN),
        ("$a % ($b + 2i)", 0),
        ("$b / ($b + 3i)", -3),
        ("$b % ($b + 3i)", 0),
        ("7i / $b", -2),
        ("7i % $b", 1),
        ("-7i % $b", -1),
        ("-$a", i32::MIN),
        ("$a >> n", i32::MIN >> 1),
        ("$b << n", -6),
        ("select(0i, 1i, $a < $b)", 1),
        ("select(0i, 1i, $a <= $b)", 1),
        ("select(0i, 1i, $a > $b)", 0),
        ("select(0i, 1i, $a >= $b)", 0),
        ("~$b", 2),
    ] {
        assert_eq!(signed(expression, words), expected, "{expression}");
    }
}

#[test]
fn conversions_cut_fractions_off_and_clamp() {
    for (expression, c, expected) in [
        ("f32(i32(c.x))", -2.75, -2.0),
        ("f32(u32(c.x))", 2.75, 2.0),
        ("f32(u32(c.x))", -2.75, 0.0),
        ("f32(i32(c.x))", 1e20, 2_147_483_520.0),
        ("f32(i32(c.x))", -1e20, -2_147_483_648.0),
        ("f32(u32(c.x))", 1e20, 4_294_967_040.0),
        ("f32(bool(c.x))", 0.5, 1.0),
        ("f32(bool(c.x))", 0.0, 0.0),
        ("f32(i32(bool(c.x)))", 3.0, 1.0),
        ("f32(bool(u32(c.x)))", 3.0, 1.0),
        ("bitcast<f32>(bitcast<i32>(c.x))", 0.1, 0.1),
    ] {
        assert_eq!(number(expression, [c, 0.0, 0.0]), expected, "{expression} of {c}");
    }
}

#[test]
fn vectors_and_matrices_multiply_column_by_column() {
    let c = [1.0, 2.0, 3.0];
    for (body, expected) in [
        ("return c * c;", [1.0, 4.0, 9.0]),
        ("return 2.0 * c + 1.0;", [3.0, 5.0, 7.0]),
        ("return c / 2.0 - c;", [-0.5, -1.0, -1.5]),
        ("let m = mat3x3f(c, c + 3.0, c + 6.0); return m * c;", [30.0, 36.0, 42.0]),
        ("let m = mat3x3f(c, c + 3.0, c + 6.0); return c * m;", [14.0, 32.0, 50.0]),
        ("let m = mat3x3f(c, c + 3.0, c + 6.0); return (m * m)[1];", [66.0, 81.0, 96.0]),
        ("let m = mat2x3f(c, c + 3.0); return m * c.xy;", [9.0, 12.0, 15.0]),
        ("let m = mat2x3f(c, c + 3.0); return vec3f(c * m, 0.0);", [14.0, 32.0, 0.0]),
        ("let m = mat2x3f(c, c + 3.0); return (m * mat3x2f(c.xy, c.yz, c.zx))[2];", [7.0, 11.0, 15.0]),
        ("let m = mat3x3f(c, c, c); return (m * 2.0 + m - 0.5 * m)[2];", [2.5, 5.0, 7.5]),
        ("let m = mat2x3f(c, c + 3.0); return vec3f(transpose(m)[1], 0.0);", [2.0, 5.0, 0.0]),
        ("return c.zyx;", [3.0, 2.0, 1.0]),
        ("return c.bbb + vec3f(c.rg, 0.0);", [4.0, 5.0, 3.0]),
        ("return select(c, -c, c > vec3f(1.5));", [1.0, -2.0, -3.0]),
        ("return select(c, -c, c.x > 1.5);", [1.0, 2.0, 3.0]),
        (
            "return vec3f(f32(all(c > vec3f(0.5))), f32(any(c > vec3f(2.5))), f32(all(c > vec3f(1.5))));",
            [1.0, 1.0, 0.0],
        ),
        ("return vec3f(vec3i(c) << vec3u(1u));", [2.0, 4.0, 6.0]),
        ("return vec3f(vec3u(c) % 2u);", [1.0, 0.0, 1.0]),
    ] {
        assert_eq!(colored(body, c), expected, "{body}");
    }
}
