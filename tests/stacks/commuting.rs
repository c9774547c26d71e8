//! Whether two filters commute, against what the appearance functions make of random surfaces in either order.

use lenspeel::appearance as wgsl;
use lenspeel::plan::{Op, Plan, commute};
use lenspeel::spec::Spec;
use naga_rust_rt::{Vec2, Vec3, Vec4};

use crate::case::scene;
use crate::random::Random;

const FILTERS: [&str; 29] = [
    "{ opacity = { value = 0.5 } }",
    "{ tint = { color = \"red\", amount = 0.4 } }",
    "{ tint = { color = \"#3040ff80\", amount = 0.7 } }",
    "{ grayscale = { amount = 0.5 } }",
    "{ grayscale = { amount = 0.8 } }",
    "{ invert = { amount = 0.3 } }",
    "{ invert = { amount = 0.7 } }",
    "\"unlit\"",
    "{ unlit = { color = \"orange\" } }",
    "{ material = { color = \"teal\" } }",
    "{ material = { metallic = 0.3 } }",
    "{ material = { roughness = 0.2, metallic = 0.9 } }",
    "{ material = { emissive = \"purple\" } }",
    "{ texture = { file = \"lens-specs/textures/checker.png\" } }",
    "\"normals\"",
    "\"wireframe\"",
    "{ wireframe = { color = \"red\", width = 2.0, fill = 0.2 } }",
    "{ wireframe = { color = \"#0000ff80\", width = 3.0, fill = 0.4 } }",
    "{ points = { size = 4 } }",
    "\"ghost\"",
    "{ ghost = { color = \"red\", strength = 0.5 } }",
    "{ brightness = { amount = 1.7 } }",
    "\"height\"",
    "{ depth = { colormap = \"magma\" } }",
    "{ contours = { spacing = 0.2, width = 2 } }",
    "{ contours = { spacing = 0.3, width = 3, color = \"#00ff80\" } }",
    "{ toon = { levels = 3 } }",
    "{ toon = { levels = 5 } }",
    "\"hatch\"",
];

fn plan() -> Plan {
    let lens = |(i, filter): (usize, &&str)| {
        format!(
            "[[lens]]\nname = \"l{i}\"\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\nfilters = [{filter}]\n"
        )
    };
    let lenses: String = FILTERS.iter().enumerate().map(lens).collect();
    let text = format!("[scene]\nfile = \"a.glb\"\n{lenses}");
    let spec = Spec::parse(&text, "filters.toml", std::path::Path::new("")).unwrap_or_else(|e| panic!("{e}"));
    let mut scene = scene();
    scene.prepare_filters(&spec).unwrap_or_else(|e| panic!("{e}"));
    Plan::new(&spec, &scene).unwrap_or_else(|e| panic!("{e}"))
}

fn surface(random: &mut Random) -> wgsl::Surface {
    let mut number = || random.between(0.1, 0.9) as f32;
    wgsl::Surface {
        position: Vec3::new(number(), number(), number()),
        normal: Vec3::new(0.6, 0.0, 0.8),
        view: Vec3::new(0.0, 0.0, 1.0),
        factor: Vec4::new(number(), number(), number(), number()),
        texel: Vec4::new(number(), number(), number(), number()),
        metallic: number(),
        roughness: number(),
        // So little that there is shade.
        emissive: Vec3::new(0.1 * number(), 0.1 * number(), 0.1 * number()),
        occlusion: 1.0,
        alpha_mode: if number() < 0.5 { wgsl::ALPHA_BLEND.0 } else { wgsl::ALPHA_OPAQUE.0 },
        alpha_cutoff: 0.5,
        opacity: 1.0,
        unlit: 0.0,
        pixel: Vec2::new(10.0 * number(), 10.0 * number()),
        toon: Vec2::new(0.0, 0.0),
        hatch: Vec4::new(0.0, 0.0, 0.0, 0.0),
        hatch_lines: Vec2::new(1.0, 1.0),
    }
}

/// Colour, opacity and coverage after a stack, lowest first, under some light that minds metal and roughness.
/// `edge`: how far the nearest edge is, in pixels; `value`: of the quantity that a filter reads.
fn seen(stack: [&Op; 2], surface: wgsl::Surface, edge: f32, value: f32) -> [f32; 5] {
    let ops = stack.map(Op::shader);
    // Maps of different quantities give different colours.
    let reading = |op: &wgsl::Op| wgsl::Reading {
        texel: Vec4::new(0.2 + 0.01 * op.kind as f32, 0.5, 0.7, 0.8),
        value,
        change: 0.02,
    };
    let surface = ops.iter().fold(surface, |s, op| wgsl::filter_surface(*op, s, reading(op)));
    let base = wgsl::base_color(surface);
    let gloss = 0.1 * surface.roughness;
    let dull = 0.6 * (1.0 - surface.metallic);
    let lit = Vec3::new(base.x * dull + gloss, base.y * dull + gloss, base.z * dull + gloss);
    let color = ops.iter().fold(wgsl::emitted(surface, lit), |c, op| wgsl::filter_color(*op, c));
    let shaded = wgsl::Shaded { color, opacity: wgsl::surface_opacity(surface), coverage: 1.0 };
    let spot = wgsl::Spot { edge, flat_edge: edge + 0.2, rim: edge + 0.3, corner: edge + 0.5, hidden: 0 };
    let s = ops.iter().fold(shaded, |s, op| wgsl::filter_coverage(*op, s, spot));
    [s.color.x, s.color.y, s.color.z, s.opacity, s.coverage]
}

#[test]
fn filters_commute_exactly_where_the_picture_is_the_same() {
    let (plan, mut random) = (plan(), Random::new(30));
    let filters: Vec<(usize, &str)> = FILTERS.into_iter().enumerate().collect();
    for (above, upper) in &filters {
        for (below, lower) in &filters[..*above] {
            let (above, below) = (*above, *below);
            let [a, b] = [below, above].map(|rank| &plan.ops[plan.lenses[rank].ops.start]);
            let same = (0..50).all(|_| {
                let [edge, value] = [2.5, 1.0].map(|most| random.between(0.0, most) as f32);
                let surface = surface(&mut random);
                let [one, other] = [seen([a, b], surface, edge, value), seen([b, a], surface, edge, value)];
                one.iter().zip(other).all(|(x, y)| (x - y).abs() < 1e-5)
            });
            let claimed = commute(&plan.lenses[below], &plan.lenses[above]);
            assert_eq!(claimed, same, "{lower} and {upper}");
        }
    }
}
