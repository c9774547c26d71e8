//! The interpreter against closed forms and against Rust, and what reading a file finds in it.

mod language;
mod numbers;
mod operators;
mod reading;

use super::{Custom, SurfaceValue};

/// A surface with nothing special about it.
pub const SURFACE: SurfaceValue = SurfaceValue {
    position: [1.0, 2.0, 3.0],
    normal: [0.0, 1.0, 0.0],
    view: [0.6, 0.8, 0.0],
    base_color: [0.2, 0.4, 0.6],
    metallic: 0.25,
    roughness: 0.5,
    emissive: [0.0, 0.1, 0.0],
    occlusion: 1.0,
    opacity: 0.75,
    unlit: 0.0,
    pixel: [10.0, 20.0],
    depth: 5.0,
};

pub fn read(source: &str) -> Custom {
    Custom::parse(source, "test.wgsl").unwrap_or_else(|error| panic!("{error}\n{source}"))
}

/// What statements with a last `return` of a vec3f make of a colour `c`.
pub fn colored(body: &str, c: [f32; 3]) -> [f32; 3] {
    read(&format!("fn filter_color(c: vec3f, s: Surface) -> vec3f {{ {body} }}")).color(c, &SURFACE, &[])
}

/// An f32 expression of `c`, whose parts are run-time values.
pub fn number(expression: &str, c: [f32; 3]) -> f32 {
    colored(&format!("let c0 = c; return vec3f({expression});"), c)[0]
}

/// The bits of a u32 expression of the bits of three numbers `a`, `b`, `n`.
pub fn bits(expression: &str, [a, b, n]: [u32; 3]) -> u32 {
    let body = format!(
        "let a = bitcast<u32>(c.x); let b = bitcast<u32>(c.y); let n = bitcast<u32>(c.z);
        return vec3f(bitcast<f32>({expression}), 0.0, 0.0);"
    );
    colored(&body, [a, b, n].map(f32::from_bits))[0].to_bits()
}

/// The same of i32.
pub fn signed(expression: &str, words: [i32; 3]) -> i32 {
    let expression =
        format!("bitcast<u32>(({}))", expression.replace("$a", "bitcast<i32>(a)").replace("$b", "bitcast<i32>(b)"));
    bits(&expression, words.map(|word| word as u32)) as i32
}
