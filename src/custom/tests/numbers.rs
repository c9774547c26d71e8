//! Every built-in function against its closed form.

use super::{bits, colored, number, signed};

fn near(got: f32, want: f32, what: &str) {
    assert!((got - want).abs() <= 1e-6 * want.abs().max(1.0), "{what}: {got} and not {want}");
}

#[test]
fn functions_of_one_number() {
    let x = 0.37_f32;
    for (name, expected) in [
        ("sin", x.sin()),
        ("cos", x.cos()),
        ("tan", x.tan()),
        ("sinh", x.sinh()),
        ("cosh", x.cosh()),
        ("tanh", x.tanh()),
        ("asin", x.asin()),
        ("acos", x.acos()),
        ("atan", x.atan()),
        ("asinh", x.asinh()),
        ("atanh", x.atanh()),
        ("exp", x.exp()),
        ("exp2", x.exp2()),
        ("log", x.ln()),
        ("log2", x.log2()),
        ("sqrt", x.sqrt()),
        ("inverseSqrt", x.sqrt().recip()),
        ("radians", x * std::f32::consts::PI / 180.0),
        ("degrees", x * 180.0 / std::f32::consts::PI),
        ("saturate", x),
        ("length", x),
    ] {
        near(number(&format!("{name}(c.x)"), [x, 0.0, 0.0]), expected, name);
    }
    near(number("acosh(c.x)", [1.5, 0.0, 0.0]), 1.5_f32.acosh(), "acosh");
}

#[test]
fn rounding_and_signs() {
    for (name, x, expected) in [
        ("abs", -1.5, 1.5),
        ("ceil", -1.5, -1.0),
        ("floor", -1.5, -2.0),
        ("trunc", -1.5, -1.0),
        ("round", 2.5, 2.0),
        ("round", 3.5, 4.0),
        ("round", -0.6, -1.0),
        ("fract", -1.25, 0.75),
        ("sign", -3.0, -1.0),
        ("sign", 0.0, 0.0),
        ("sign", 3.0, 1.0),
        ("saturate", 1.5, 1.0),
        ("saturate", -1.5, 0.0),
    ] {
        assert_eq!(number(&format!("{name}(c.x)"), [x, 0.0, 0.0]), expected, "{name}({x})");
    }
}

#[test]
fn functions_of_several_numbers() {
    let c = [0.6, 2.0, 0.25];
    for (expression, expected) in [
        ("min(c.x, c.y)", 0.6),
        ("max(c.x, c.y)", 2.0),
        ("clamp(c.x, c.z, c.y)", 0.6),
        ("clamp(c.x, 0.7, c.y)", 0.7),
        ("clamp(c.x, c.z, 0.5)", 0.5),
        ("pow(c.x, c.y)", 0.36),
        ("atan2(c.x, -c.y)", 0.6_f32.atan2(-2.0)),
        ("step(c.x, c.y)", 1.0),
        ("step(c.y, c.x)", 0.0),
        ("step(c.y, c.y)", 1.0),
        ("smoothstep(c.z, c.y, c.x)", 0.104),
        ("smoothstep(c.z, c.x, c.y)", 1.0),
        ("mix(c.x, c.y, c.z)", 0.95),
        ("fma(c.x, c.y, c.z)", 1.45),
        ("ldexp(c.x, i32(c.y))", 2.4),
        ("ldexp(c.x, -2)", 0.15),
        ("modf(c.x + c.y).fract", 0.6),
        ("modf(-c.x - c.y).whole", -2.0),
        ("frexp(c.x).fract", 0.6),
        ("f32(frexp(c.y * 4.0).exp)", 4.0),
        ("frexp(-c.y * 4.0).fract", -0.5),
        ("frexp(c.x * 0.0).fract", 0.0),
    ] {
        near(number(expression, c), expected, expression);
    }
}

#[test]
fn functions_of_vectors() {
    let c = [1.0, 2.0, 2.0];
    for (body, expected) in [
        ("return vec3f(dot(c, c), length(c), distance(c, c.zxy));", [9.0, 3.0, 2.0_f32.sqrt()]),
        ("return normalize(c);", [1.0 / 3.0, 2.0 / 3.0, 2.0 / 3.0]),
        ("return cross(c, vec3f(0.0, 0.0, 1.0));", [2.0, -1.0, 0.0]),
        ("return reflect(c, vec3f(0.0, 1.0, 0.0));", [1.0, -2.0, 2.0]),
        ("return faceForward(c, vec3f(0.0, -1.0, 0.0), vec3f(0.0, 1.0, 0.0));", [1.0, 2.0, 2.0]),
        ("return faceForward(c, vec3f(0.0, 1.0, 0.0), vec3f(0.0, 1.0, 0.0));", [-1.0, -2.0, -2.0]),
        ("return refract(vec3f(0.6, -0.8, 0.0), vec3f(0.0, 1.0, 0.0), 1.0);", [0.6, -0.8, 0.0]),
        ("return refract(vec3f(0.6, -0.8, 0.0) * c.x, vec3f(0.0, 1.0, 0.0), 2.0);", [0.0, 0.0, 0.0]),
        ("return refract(vec3f(0.6, -0.8, 0.0) * c.x, vec3f(0.0, 1.0, 0.0), 0.5);", [0.3, -0.953_939_2, 0.0]),
        ("return vec3f(vec3i(dot(vec3i(c), vec3i(c)), dot(vec2i(c.xy), vec2i(-3, 1)), 0));", [9.0, -1.0, 0.0]),
        ("return vec3f(determinant(mat2x2f(c.xy, c.zx)), 0.0, 0.0);", [-3.0, 0.0, 0.0]),
        ("return vec3f(determinant(mat3x3f(c, c.yzx * 2.0, c.zxx)));", [-6.0, -6.0, -6.0]),
        ("return modf(c + 0.25).fract + modf(c + 0.25).whole;", [1.25, 2.25, 2.25]),
        ("return vec3f(frexp(c).exp);", [1.0, 2.0, 2.0]),
        ("return mix(c, c + 1.0, 0.5);", [1.5, 2.5, 2.5]),
        ("return mix(c, vec3f(0.0), c - 1.0);", [1.0, 0.0, 0.0]),
        ("return clamp(c, vec3f(1.5), vec3f(1.75));", [1.5, 1.75, 1.75]),
    ] {
        let got = colored(body, c);
        (0..3).for_each(|i| near(got[i], expected[i], body));
    }
}

#[test]
fn the_determinant_of_four_rows() {
    // Upper triangular with one exchange of rows: minus the product of the diagonal.
    let body = "let m = mat4x4f(vec4f(0.0, c.x, 0.0, 0.0), vec4f(c.y, 5.0, 0.0, 0.0),
        vec4f(1.0, 2.0, c.z, 0.0), vec4f(9.0, 8.0, 7.0, 3.0)); return vec3f(determinant(m));";
    assert_eq!(colored(body, [2.0, 5.0, 7.0])[0], -210.0);
}

#[test]
fn functions_of_bits() {
    let words = [0x00f0_0a00, 0xffff_ffff, 0];
    for (expression, expected) in [
        ("countTrailingZeros(a)", 9),
        ("countLeadingZeros(a)", 8),
        ("countOneBits(a)", 6),
        ("reverseBits(a)", 0x0050_0f00),
        ("firstTrailingBit(a)", 9),
        ("firstLeadingBit(a)", 23),
        ("firstTrailingBit(n)", u32::MAX),
        ("firstLeadingBit(n)", u32::MAX),
        ("countTrailingZeros(n)", 32),
        ("extractBits(a, 8u, 4u)", 10),
        ("extractBits(b, 30u, 9u)", 3),
        ("extractBits(a, 40u, 4u)", 0),
        ("extractBits(a, 8u, 0u)", 0),
        ("insertBits(a, b, 0u, 4u)", 0x00f0_0a0f),
        ("insertBits(a, n, 4u, 28u)", 0),
        ("insertBits(a, b, 32u, 4u)", 0x00f0_0a00),
        ("abs(a)", 0x00f0_0a00),
        ("min(a, b)", 0x00f0_0a00),
        ("max(a, b)", u32::MAX),
        ("clamp(b, 1u, 9u)", 9),
        ("dot4U8Packed(a, 0x01010101u)", 250),
        ("pack4xU8(vec4u(1u, 2u, 3u, 260u))", 0x0403_0201),
        ("pack4xU8Clamp(vec4u(1u, 2u, 3u, 260u))", 0xff03_0201),
        ("unpack4xU8(a).y", 10),
        ("pack4x8unorm(vec4f(0.0, 1.0, 0.5, 2.0))", 0xff80_ff00),
        ("pack4x8snorm(vec4f(0.0, 1.0, -1.0, -2.0))", 0x8181_7f00),
        ("pack2x16unorm(vec2f(1.0, 0.0))", 0xffff),
        ("pack2x16snorm(vec2f(-1.0, 1.0))", 0x7fff_8001),
        ("bitcast<u32>(unpack4x8unorm(b).w)", 1.0_f32.to_bits()),
        ("bitcast<u32>(unpack4x8snorm(b + 0x82u).x)", (-1.0_f32).to_bits()),
        ("bitcast<u32>(unpack2x16unorm(b).x)", 1.0_f32.to_bits()),
        ("bitcast<u32>(unpack2x16snorm(0x8001u).x)", (-1.0_f32).to_bits()),
    ] {
        assert_eq!(bits(expression, words), expected, "{expression}");
    }
}

#[test]
fn functions_of_signed_numbers() {
    let words = [-12, 5, 0];
    for (expression, expected) in [
        ("abs($a)", 12),
        ("sign($a)", -1),
        ("min($a, $b)", -12),
        ("max($a, $b)", 5),
        ("clamp($a, -3i, $b)", -3),
        ("firstLeadingBit($a)", 3),
        ("firstLeadingBit($b)", 2),
        ("extractBits($a, 2u, 3u)", -3),
        ("extractBits($b, 0u, 3u)", -3),
        ("extractBits($b, 0u, 4u)", 5),
    ] {
        assert_eq!(signed(expression, words), expected, "{expression}");
    }
    assert_eq!(signed("unpack4xI8(a).x", words), -12);
    assert_eq!(signed("dot4I8Packed(a, b)", words), -60);
    assert_eq!(bits("pack4xI8(vec4i(-1, 2, 300, 4))", [0; 3]), 0x042c_02ff);
    assert_eq!(bits("pack4xI8Clamp(vec4i(-1, 2, 300, -300))", [0; 3]), 0x807f_02ff);
}
