//! Filter files on the GPU against the interpreter: the same surfaces through both, in a compute shader.

mod calls;
mod generate;
#[path = "../support/random.rs"]
mod random;
#[path = "../support/trials.rs"]
mod trials;

use std::process::ExitCode;

use calls::{Filters, WORDS, input_numbers};
use lenspeel::gpu::Headless;
use random::Random;

/// Of one number against the other, relative above 1. GPUs may compute `pow`, `sin` and the like in few bits.
const TOLERANCE: f32 = 1e-3;

/// Filters that together use most of the language.
const FILTERS: [(&str, &str); 13] = [
    ("stripes", include_str!("../../lens-specs/wgsl/stripes.wgsl")),
    ("rim", include_str!("../../lens-specs/wgsl/rim.wgsl")),
    ("bumps", include_str!("../../lens-specs/wgsl/bumps.wgsl")),
    ("thermal", include_str!("../../lens-specs/wgsl/thermal.wgsl")),
    ("noise", "fn filter_color(c: vec3f, s: Surface) -> vec3f {
        return c * noise3(s.position * 4.0) + vec3f(hash3(vec3i(s.pixel.xyx))); }"),
    ("budget", "fn filter_color(c: vec3f, s: Surface) -> vec3f {
        var n = 0.0; loop { n += 1.0; if n < 0.0 { break; } }
        for (var i = 0; i < 10; i++) { n += 1.0; }
        return vec3f(n, c.yz); }"),
    ("endless", "fn never(x: f32) -> vec3f {
            if x > 0.5 { loop { if x < 0.0 { return vec3f(1.0); } } } else { switch 1 { default: { loop { loop { if x > 0.4 { return vec3f(x); } } } } } } }
        fn filter_color(c: vec3f, s: Surface) -> vec3f { return never(c.x) + 1.0; }"),
    ("places", "struct Cell { at: array<vec3f, 3>, n: u32 }
        fn turn(cell: ptr<function, Cell>, i: i32) { (*cell).at[i] = (*cell).at[i].zxy; (*cell).n += 1u; }
        fn filter_color(c: vec3f, s: Surface) -> vec3f {
            var cell: Cell; cell.at[0] = c; cell.at[1] = s.position; cell.at[2] = s.normal;
            let i = i32(s.pixel.x) - 3; turn(&cell, i); turn(&cell, 1);
            switch cell.n % 3u { case 0u: { return c; } case 1u, 2u: { return cell.at[u32(s.pixel.y)] + cell.at[i]; } default: {} }
            return vec3f(0.0); }"),
    ("copies", "struct Pair { a: vec2f, b: array<f32, 2> }
        fn swapped(p: Pair) -> Pair { var q = p; q.a = p.a.yx; q.b = array(p.b[1], p.b[0]); return q; }
        fn add(to: ptr<function, f32>, x: f32) -> f32 { *to += x; return *to; }
        fn filter_surface(s: Surface) -> Surface {
            var r = s; var pairs = array(Pair(s.pixel, array(s.depth, 1.0)), Pair());
            let before = pairs; let i = u32(s.pixel.x) % 2u;
            pairs[1] = swapped(pairs[0]); let p = &pairs[i]; var x = (*p).b[1u - i]; (*p).b[i] = add(&x, s.depth) + 1.0;
            r.position = vec3f(pairs[0].b[0], pairs[0].b[1], pairs[1].b[0]);
            r.normal = vec3f(pairs[1].b[1], pairs[1].a); r.pixel = before[1].a + before[0].a; return r; }"),
    ("matrices", "fn filter_color(c: vec3f, s: Surface) -> vec3f {
        var m = mat3x3f(c, s.normal, s.view); m[i32(s.pixel.x) - 1] *= 2.0; m[1][u32(s.pixel.y)] += 1.0;
        let n = mat2x3f(c, s.normal); let t = transpose(n) * s.view;
        return m * c + c * transpose(m) * 0.5 - (m - m * m)[0] + vec3f(determinant(m), t) + (n * mat2x2f(t, c.xy))[1]; }"),
    ("numbers", "fn filter_surface(s: Surface) -> Surface { var r = s;
        r.position = sin(s.position) + cos(s.position) * tanh(s.position) + atan2(s.position, s.position.yzx) + exp(-abs(s.position));
        r.normal = fract(s.position) + round(s.position) + sign(s.position) + trunc(s.position) + s.position % vec3f(0.75, -1.25, 2.0);
        r.view = refract(s.view, s.normal, 0.75) + reflect(s.view, s.normal) + faceForward(s.view, s.normal, s.position) + cross(s.view, s.normal);
        r.base_color = mix(s.base_color, s.emissive, s.metallic) + smoothstep(vec3f(0.25), vec3f(0.75), s.base_color) + step(s.emissive, s.base_color);
        r.emissive = pow(s.base_color, vec3f(1.5)) + sqrt(s.emissive) + log2(s.emissive + 1.0) + clamp(s.position, vec3f(-1.0), s.base_color);
        r.metallic = ldexp(s.metallic, i32(s.pixel.x) - 3) + modf(s.depth).whole + frexp(s.depth).fract + f32(frexp(s.depth).exp);
        r.roughness = f32(i32(s.position.x * 1e30)) + f32(u32(s.position.y)) + f32(i32(s.position.z) / 2);
        r.occlusion = select(length(s.position), distance(s.view, s.normal), any(s.position > vec3f(2.0)));
        r.opacity = unpack4x8unorm(u32(s.pixel.x * 4369.0)).y + f32(pack4x8snorm(vec4f(s.pixel, -1.0, 2.0)) >> 8u);
        return r; }"),
    ("integers", "fn filter_color(c: vec3f, s: Surface) -> vec3f {
        let i = vec3i(c * 100.0) - 50; let n = vec3u(s.pixel.xyy);
        let a = i / (i - i.yzx) + i % (i.zxy - 3) + (i << n) + vec3i(reverseBits(n) >> (n + 30u));
        let b = extractBits(a, 2u, 7u) + firstLeadingBit(i) + clamp(i, vec3i(-20), vec3i(20));
        return vec3f(b % 1000); }"),
    // naga's writer makes one name of all three.
    ("names", "fn filter_color_(c: vec3f, s: Surface, p: Params) -> vec3f { return vec3f(7.0); }
        fn filter__color(c: vec3f, s: Surface, p: Params) -> vec3f { return vec3f(8.0); }
        struct Params_ { b: f32, a: f32 }
        struct Params {
            a: f32, // = 1
            b: f32, // = 2
        }
        fn filter_color(c: vec3f, s: Surface, p: Params) -> vec3f { let q = Params_(p.a, p.b); return c * p.b + q.b; }"),
];

fn main() -> ExitCode {
    trials::run(&[
        ("every_filter_gives_on_the_gpu_what_the_interpreter_gives", every_filter_agrees),
        ("what_nests_as_deep_as_it_may_compiles", the_deepest_compile),
        ("random_filters_of_whole_numbers_agree_to_the_bit", random_filters_agree),
        ("a_filter_that_differs_is_found", a_difference_is_found),
    ])
}

/// The first number that differs by more than the tolerance, and which filter, call and number of it that is.
fn difference(cpu: &[f32], gpu: &[f32], tolerance: f32) -> Option<(usize, String)> {
    assert_eq!(cpu.len(), gpu.len());
    // What is no number differs, too.
    let differs = |(a, b): (&f32, &f32)| {
        let distance = (a - b).abs();
        distance.is_nan() || distance > tolerance * a.abs().max(1.0)
    };
    let at = cpu.iter().zip(gpu).position(differs)?;
    let numbers = input_numbers().len();
    let (call, number) = (at % numbers / WORDS, at % WORDS);
    Some((at / numbers, format!("number {number} of call {call}: {} on the CPU, {} on the GPU", cpu[at], gpu[at])))
}

fn every_filter_agrees(device: &Headless) -> Result<(), String> {
    let filters = Filters::read(FILTERS)?;
    let cpu = filters.on_cpu();
    let given = input_numbers();
    for ((name, _), results) in FILTERS.iter().zip(cpu.chunks(given.len())) {
        if results == given {
            return Err(format!("{name} changes nothing"));
        }
    }
    match difference(&cpu, &filters.on_gpu(device)?, TOLERANCE) {
        Some((filter, difference)) => Err(format!("{}: {difference}", FILTERS[filter].0)),
        None => Ok(()),
    }
}

/// A shader compiler has no thread with a large stack.
fn the_deepest_compile(device: &Headless) -> Result<(), String> {
    let nested = |before: &str, behind: &str, n: usize| format!("{}n += 1.0;{}", before.repeat(n), behind.repeat(n));
    let bodies = [
        nested("if c.x >= 0.0 {", "}", 118),
        nested("for (var i = 0; i < 1; i++) {", "}", 39),
        nested("switch 1 { default: {", "}}", 59),
        format!("if c.x < 0.0 {{}} {} else {{ n += 1.0; }}", "else if c.y < 0.0 {} ".repeat(117)),
        format!("n = c.x{};", " + c.y".repeat(60)),
        format!("n = {}c.x{};", "select(c.y, ".repeat(60), ", c.z > 0.5)".repeat(60)),
    ];
    let text = |body: &String| {
        format!("fn filter_color(c: vec3f, s: Surface) -> vec3f {{ var n = 0.0; {body} return vec3f(n); }}")
    };
    let texts: Vec<String> = bodies.iter().map(text).collect();
    let filters = Filters::read(texts.iter().map(|text| ("deep.wgsl", text.as_str())))?;
    match difference(&filters.on_cpu(), &filters.on_gpu(device)?, TOLERANCE) {
        Some((filter, difference)) => Err(format!("{}: {difference}", bodies[filter])),
        None => Ok(()),
    }
}

/// Random filters a shader, and shaders.
const RANDOM_FILTERS: usize = 12;
const SHADERS: usize = 2;

fn random_filters_agree(device: &Headless) -> Result<(), String> {
    let mut random = Random::new(2026);
    for _ in 0..SHADERS {
        let texts: Vec<String> = (0..RANDOM_FILTERS).map(|_| generate::filter(&mut random)).collect();
        let filters = Filters::read(texts.iter().map(|text| ("random.wgsl", text.as_str())))?;
        let cpu = filters.on_cpu();
        let results: std::collections::HashSet<u32> = cpu.iter().map(|x| x.to_bits()).collect();
        if results.len() < 1000 {
            return Err(format!("these filters compute only {} numbers", results.len()));
        }
        if let Some((filter, difference)) = difference(&cpu, &filters.on_gpu(device)?, 0.0) {
            return Err(format!("{difference}\n{}", texts[filter]));
        }
    }
    Ok(())
}

/// The comparison finds a parameter that is off by a hundredth, and nothing before it is.
fn a_difference_is_found(device: &Headless) -> Result<(), String> {
    let mut filters = Filters::read([FILTERS[1]])?;
    let cpu = filters.on_cpu();
    if let Some((_, difference)) = difference(&cpu, &filters.on_gpu(device)?, TOLERANCE) {
        return Err(format!("with the right strength: {difference}"));
    }
    let strength = &mut filters.words[0][3];
    *strength = (f32::from_bits(*strength) * 1.01).to_bits();
    match difference(&cpu, &filters.on_gpu(device)?, TOLERANCE) {
        Some(_) => Ok(()),
        None => Err("a strength that is off by a hundredth goes unnoticed".to_owned()),
    }
}
