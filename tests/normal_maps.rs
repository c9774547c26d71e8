//! Normal maps against a closed form: panels with a round bump, each with its texture laid, turned or mirrored in its way.

use std::path::Path;

use glam::{Vec2, Vec3};
use lenspeel::cpu;

#[path = "support/open.rs"]
mod open;

/// Pixels of a scene unit in the picture of `normal-maps.toml`.
const SCALE: usize = 40;
/// The bump's radius in the scene, and the sine of its steepest slope.
const RADIUS: f32 = 0.35;
const STEEPEST: f32 = 0.8;
/// Of the eight bits of a texel and its filtering.
const TOLERANCE: f32 = 0.03;

#[test]
fn every_panel_has_the_same_bump() {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("lens-specs/light/normal-maps.toml");
    let text = std::fs::read_to_string(&path).expect("the spec is there");
    let opened = open::open(&path, &text, |_| ()).expect("the spec is good").1;
    let frame = cpu::Renderer::new(&opened.scene, &opened.plan)
        .and_then(|cpu| cpu.render(true, &|_| ()))
        .expect("the CPU draws it");
    assert_eq!(frame.size, [160, 80]);
    let normals = &frame.aovs.as_ref().expect("AOVs were asked for").normals;
    let mut compared = 0;
    for (at, normal) in normals.iter().enumerate() {
        let (x, y) = (at % 160, at / 160);
        let within = |pixel: usize| ((pixel % SCALE) as f32 + 0.5) / SCALE as f32 - 0.5;
        let offset = Vec2::new(within(x), -within(y));
        if (offset.length() - RADIUS).abs() < 0.03 || offset.abs().max_element() > 0.44 {
            continue;
        }
        let slope = if offset.length() < RADIUS { offset / RADIUS * STEEPEST } else { Vec2::ZERO };
        let expected = slope.extend((1.0 - slope.length_squared()).sqrt());
        let there = Vec3::from(*normal);
        let panel = ["plain", "mirrored", "turned", "node"][x / SCALE];
        assert!(there.distance(expected) < TOLERANCE, "{panel} {x},{y}: {expected} is wanted, {there} is there");
        compared += 1;
    }
    assert!(compared > 8000, "only {compared} pixels lie on panels");
}
