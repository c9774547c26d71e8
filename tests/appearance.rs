//! The appearance functions against closed forms.

use lenspeel::appearance as wgsl;
use naga_rust_rt::{Vec2, Vec3, Vec4};

fn near(a: f32, b: f32, tolerance: f32) -> bool {
    (a - b).abs() <= tolerance
}

fn grey(value: f32) -> Vec3<f32> {
    Vec3::new(value, value, value)
}

fn op(kind: naga_rust_rt::Scalar<u32>, a: [f32; 4], b: [f32; 4]) -> wgsl::Op {
    let vector = |v: [f32; 4]| Vec4::new(v[0], v[1], v[2], v[3]);
    wgsl::Op { kind: kind.0, texture: 0, flags: 0, inner: 0, a: vector(a), b: vector(b), c: vector([0.0; 4]) }
}

fn surface(base: [f32; 3], unlit: f32) -> wgsl::Surface {
    wgsl::Surface {
        position: grey(0.0),
        normal: Vec3::new(0.0, 0.0, 1.0),
        view: Vec3::new(0.0, 0.0, 1.0),
        factor: Vec4::new(base[0], base[1], base[2], 1.0),
        texel: Vec4::new(1.0, 1.0, 1.0, 1.0),
        metallic: 0.0,
        roughness: 1.0,
        emissive: grey(0.0),
        occlusion: 1.0,
        alpha_mode: wgsl::ALPHA_OPAQUE.0,
        alpha_cutoff: 0.5,
        opacity: 1.0,
        unlit,
        pixel: Vec2::new(0.0, 0.0),
        toon: Vec2::new(0.0, 0.0),
        hatch: Vec4::new(0.0, 0.0, 0.0, 0.0),
        hatch_lines: Vec2::new(1.0, 1.0),
    }
}

#[test]
fn srgb_is_that_of_the_standard_and_its_own_inverse() {
    for (encoded, linear) in [(0.0, 0.0), (0.04045, 0.003_130_8), (0.5, 0.214_041), (0.735_357, 0.5), (1.0, 1.0)] {
        assert!(near(wgsl::linear_from_srgb(encoded), linear, 2e-6), "{encoded}");
        assert!(near(wgsl::srgb_from_linear(linear), encoded, 2e-5), "{linear}");
    }
    for i in 0..=255u8 {
        let x = f32::from(i) / 255.0;
        assert!(near(wgsl::srgb_from_linear(wgsl::linear_from_srgb(x)), x, 1e-5), "{x}");
    }
}

/// n panes of one opacity leave (1 - opacity)^n of what lies behind.
#[test]
fn panes_over_each_other_leave_a_power_of_what_is_behind() {
    for opacity in [0.1f32, 0.5, 0.9] {
        let front = (0..64).fold(Vec4::new(0.0, 0.0, 0.0, 0.0), |front, _| wgsl::over(front, grey(0.25), opacity));
        let covered = 1.0 - (1.0 - opacity).powi(64);
        assert!(near(front.w, covered, 1e-5) && near(front.x, 0.25 * covered, 1e-5), "{opacity}: {front:?}");
    }
}

/// Lines lie at whole multiples of the spacing, as wide as they should be wherever the surface is steep or flat.
#[test]
fn contours_lie_at_multiples_of_their_spacing() {
    let (spacing, width) = (0.25, 2.0);
    let contours = op(wgsl::OP_CONTOURS, [1.0, 0.0, 0.0, 1.0], [0.0, 0.0, spacing, width]);
    for change in [0.001f32, 0.01, 0.03] {
        let is_line = |value: f32| {
            let reading = wgsl::Reading { texel: Vec4::new(0.0, 0.0, 0.0, 0.0), value, change };
            wgsl::filter_surface(contours, surface([0.0, 0.0, 1.0], 0.0), reading).factor.x
        };
        for number in -3..=3 {
            let at = number as f32 * spacing;
            assert!(near(is_line(at), 1.0, 1e-4), "{number}: {}", is_line(at));
            for side in [-1.0, 1.0] {
                assert!(near(is_line(at + side * change), 0.5, 2e-3), "half at half the width");
                assert!(is_line(at + side * 1.6 * change) <= 0.0, "nothing beyond");
            }
        }
    }
}

#[test]
fn toon_has_as_many_steps_as_it_says_up_to_the_base_colour() {
    for levels in [2u8, 3, 6] {
        let toon = op(wgsl::OP_TOON, [0.0; 4], [f32::from(levels), 0.0, 0.0, 0.0]);
        let reading = wgsl::Reading { texel: Vec4::new(0.0, 0.0, 0.0, 0.0), value: 0.0, change: 0.0 };
        // Unlit before, it is lit after.
        let s = wgsl::filter_surface(toon, surface([0.4, 0.4, 0.4], 1.0), reading);
        let mut seen: Vec<f32> = (1..=400).map(|i| wgsl::emitted(s, grey(0.5 * i as f32 / 400.0)).x).collect();
        assert!(seen.is_sorted_by(|a, b| *b - *a > -1e-5), "more light is not darker");
        seen.dedup_by(|a, b| near(*a, *b, 1e-4));
        assert_eq!(seen.len(), usize::from(levels), "{seen:?}");
        assert!(near(seen[seen.len() - 1], 0.4, 1e-4));
    }
}

/// Dark colours are only shifted, bright ones never reach one, and brighter stays brighter.
#[test]
fn tone_mapping_keeps_what_is_dark_and_bends_what_is_bright() {
    let mapped = |value: f32| wgsl::tone_mapped(wgsl::TONE_NEUTRAL.0, grey(value)).x;
    assert!(near(mapped(0.5), 0.46, 1e-6) && near(mapped(0.04), 0.01, 1e-6));
    let mut last = -1.0;
    for i in 0..2000 {
        let x = mapped(i as f32 * 0.01);
        assert!(x >= last && x < 1.0, "{i}: {x}");
        last = x;
    }
    assert!(last > 0.99);
    assert_eq!(wgsl::tone_mapped(wgsl::TONE_NONE.0, grey(7.0)).x, 7.0);
}

/// Face on clear, edge on as it was.
#[test]
fn ghosts_are_clear_face_on() {
    let reading = wgsl::Reading { texel: Vec4::new(0.0, 0.0, 0.0, 0.0), value: 0.0, change: 0.0 };
    let seen = |cosine: f32, strength: f32| {
        let side = (1.0 - cosine * cosine).sqrt();
        let s = wgsl::Surface { normal: Vec3::new(side, 0.0, cosine), ..surface([1.0; 3], 0.0) };
        wgsl::filter_surface(op(wgsl::OP_GHOST, [0.0; 4], [strength, 0.0, 0.0, 0.0]), s, reading).opacity
    };
    assert!(near(seen(1.0, 1.0), 0.0, 1e-6) && near(seen(0.0, 1.0), 1.0, 1e-6));
    assert!(near(seen(0.5, 1.0), 0.25, 1e-6) && near(seen(0.5, 0.5), 0.625, 1e-6));
}

/// The tangent of a triangle runs along growing u, and its bitangent up the image, against growing v, however the
/// texture lies.
#[test]
fn tangents_of_triangles_run_along_u_and_up_the_image() {
    let normal = Vec3::new(0.0, 0.0, 1.0);
    // Columns: how u and v grow along x and along y.
    for [ux, vx, uy, vy] in [
        [1.0, 0.0, 0.0, -1.0],
        [-1.0, 0.0, 0.0, -1.0],
        [0.0, -1.0, -1.0, 0.0],
        [0.0, 1.0, -1.0, 0.0],
        [2.0, 0.5, 0.3, 3.0],
    ] {
        let corners = [(0.0f32, 0.0f32), (1.0, 0.2), (0.3, 1.0)];
        let [a, b, c] = corners.map(|(x, y)| Vec3::new(x, y, 0.0));
        let [ta, tb, tc] = corners.map(|(x, y)| Vec2::new(ux * x + uy * y, vx * x + vy * y));
        let tangent = wgsl::triangle_tangent(a, b, c, ta, tb, tc, normal);
        // Of the inverse map: the ways in which u alone and v alone grow.
        let det = ux * vy - uy * vx;
        let (along_u, along_v) = ((vy / det, -vx / det), (-uy / det, ux / det));
        assert!(tangent.x * along_u.0 + tangent.y * along_u.1 > 0.0 && tangent.z == 0.0, "{ux} {vx} {uy} {vy}");
        assert!((tangent.x * along_u.1 - tangent.y * along_u.0).abs() < 1e-5, "{ux} {vx} {uy} {vy}: along u");
        let bitangent = (-tangent.y * tangent.w, tangent.x * tangent.w);
        assert!(bitangent.0 * along_v.0 + bitangent.1 * along_v.1 < 0.0, "{ux} {vx} {uy} {vy}: up the image");
        assert!(tangent.w.abs() == 1.0);
    }
}

/// Half of a filter's work on a soft lens: half of the turn of a normal, and half of all else.
#[test]
fn a_soft_lens_fades_what_a_filter_makes_of_a_surface() {
    let before = surface([0.2, 0.4, 0.6], 0.0);
    let after = wgsl::Surface { normal: Vec3::new(1.0, 0.0, 0.0), occlusion: 0.0, roughness: 0.0, ..before };
    let half = wgsl::faded_surface(before, after, 0.5);
    let side = 0.5f32.sqrt();
    assert!(near(half.normal.x, side, 1e-6) && near(half.normal.y, 0.0, 1e-6) && near(half.normal.z, side, 1e-6));
    assert!(near(half.occlusion, 0.5, 1e-6) && near(half.roughness, 0.5, 1e-6));
    for (amount, normal) in [(0.0, before.normal), (1.0, after.normal)] {
        let end = wgsl::faded_surface(before, after, amount).normal;
        assert!(near(end.x, normal.x, 1e-6) && near(end.z, normal.z, 1e-6), "{amount}: {end:?}");
    }
    // No way leads from a normal to its opposite, and what is not turned stays the same to the bit.
    let opposite = wgsl::Surface { normal: Vec3::new(0.0, 0.0, -1.0), ..before };
    assert_eq!(wgsl::faded_surface(before, opposite, 0.5).normal.z, -1.0);
    let odd = wgsl::Surface { normal: Vec3::new(0.1, 0.2, 0.3), ..before };
    assert_eq!(wgsl::faded_surface(odd, odd, 0.3).normal.y, 0.2);
}
