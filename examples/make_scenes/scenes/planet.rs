//! A layered planet to peel, with a moon. The crust's radius is 1.

use std::f64::consts::{PI, TAU};

use glam::{DVec3, dvec3};

use super::det::{self, smoothstep};
use super::glb::{Glb, Look, Place, Sampling};
use super::noise::{fbm, ridged, value};
use super::paint::{self, Paint, mix, paint, ramp};
use super::shapes::{ball, globe};

pub fn planet() -> Vec<u8> {
    let mut glb = Glb::default();
    let root = glb.node("planet", Place::default());
    let clouds_map = glb.texture("clouds", &paint::png(paint::rgba(1024, 512, clouds)), Sampling::GLOBE);
    let crust_map = glb.texture("crust", &paint::jpeg(&paint::rgb(1024, 512, crust), 90), Sampling::GLOBE);
    let mantle_map = glb.texture("mantle", &paint::jpeg(&paint::rgb(512, 256, mantle), 88), Sampling::GLOBE);
    let core_map = glb.texture("outer-core", &paint::jpeg(&paint::rgb(512, 256, outer_core), 88), Sampling::GLOBE);
    let moon_map = glb.texture("moon", &paint::jpeg(&paint::rgb(512, 256, moon), 88), Sampling::GLOBE);
    let white = |name, texture, roughness| Look::new(name, 0xff_ffff, 0.0, roughness).textured(texture);
    let layers = [
        ("clouds", globe(1.012, 96, 48), white("clouds", clouds_map, 0.95).blended(1.0)),
        ("crust", globe(1.0, 128, 64), white("crust", crust_map, 0.62)),
        ("mantle", globe(0.9, 96, 48), white("mantle", mantle_map, 0.8).glowing(0x38_0c02)),
        ("outer-core", globe(0.6, 80, 40), white("outer-core", core_map, 0.5).glowing(0x8a_3a08)),
        ("inner-core", ball(0.32, 64, 32), Look::new("inner-core", 0xff_e9b8, 0.0, 0.4).glowing(0xff_d27a)),
    ];
    for (name, mesh, look) in layers {
        let material = glb.material(look);
        let mesh = glb.mesh(name, &mesh, material);
        glb.node(name, Place::mesh(mesh).under(root));
    }
    let material = glb.material(white("moon", moon_map, 0.95));
    let mesh = glb.mesh("moon", &globe(0.2, 64, 32), material);
    glb.node("moon", Place::mesh(mesh).at(1.62, 0.62, 0.35));
    glb.finish()
}

/// The point of the unit sphere with these texture coordinates; the same convention as [`globe`].
fn on_sphere(u: f64, v: f64) -> DVec3 {
    let (s, c) = (det::sin(PI * v), det::cos(PI * v));
    dvec3(s * det::cos(TAU * u), c, -s * det::sin(TAU * u))
}

/// A point moved by noise, which turns round blobs into coasts, currents and swirls.
fn warped(seed: u64, p: DVec3, amount: f64) -> DVec3 {
    let bend = |k: u64| fbm(seed + 10 * k, p + DVec3::splat(3.7 * k as f64), 3);
    p + dvec3(bend(1), bend(2), bend(3)) * amount
}

/// Height of the land, the sea level at 0.
fn elevation(p: DVec3) -> f64 {
    let q = warped(40, p * 1.35, 0.55);
    let continents = fbm(7, q * 1.1, 7);
    let mountains = ridged(90, p * 4.2, 5) * smoothstep(0.0, 0.3, continents - 0.08);
    0.8 * (continents - 0.09) + 0.16 * mountains
}

fn crust(u: f64, v: f64) -> Paint {
    let p = on_sphere(u, v);
    let height = elevation(p);
    let latitude = p.y.abs() + 0.09 * fbm(300, p * 5.0, 4);
    let ice = smoothstep(0.88, 0.93, latitude + 0.25 * height.max(0.0));
    let surface = if height < 0.0 { sea(height) } else { land(p, height, latitude) };
    mix(surface, paint(0xf2_f6fa), ice)
}

fn sea(height: f64) -> Paint {
    ramp(&[(-0.55, 0x08_1b3d), (-0.25, 0x0d_3566), (-0.08, 0x15_568c), (-0.02, 0x2f_86ad), (0.0, 0x5f_b5c0)], height)
}

fn land(p: DVec3, height: f64, latitude: f64) -> Paint {
    let moisture = fbm(150, p * 2.4, 5) + 0.75 * det::cos(6.2 * latitude) * 0.5;
    let green = ramp(&[(0.0, 0x5d_8a3c), (0.15, 0x2f_6b33), (0.4, 0x3f_6a3a)], height);
    let dry = ramp(&[(0.0, 0xd9_bf86), (0.2, 0xc4_9a5e), (0.45, 0x9a_7048)], height);
    let lowland = mix(dry, green, smoothstep(-0.22, 0.16, moisture));
    let cold = mix(lowland, paint(0x8c_8f74), smoothstep(0.62, 0.82, latitude));
    let rock = mix(cold, paint(0x7d_6a58), smoothstep(0.24, 0.36, height));
    let snow = mix(rock, paint(0xf4_f4f2), smoothstep(0.4, 0.5, height + 0.12 * latitude));
    paint::scale(snow, 0.97 + 0.06 * value(500, p * 34.0))
}

fn clouds(u: f64, v: f64) -> (Paint, f64) {
    let p = on_sphere(u, v);
    // Belts of latitude stretch the clouds along the parallels, and the warp curls them.
    let q = warped(600, p * dvec3(1.6, 2.6, 1.6), 0.85);
    let belts = 0.16 * det::cos(9.0 * p.y + 0.6);
    let cover = fbm(640, q * 1.5, 6) + belts;
    // Few levels of alpha make the file small and are not seen.
    (paint(0xff_ffff), (0.94 * smoothstep(0.02, 0.4, cover) * 40.0).round() / 40.0)
}

fn mantle(u: f64, v: f64) -> Paint {
    let p = on_sphere(u, v);
    let q = warped(700, p * 2.6, 0.9);
    let veins = ridged(720, q * 1.2, 4);
    ramp(&[(0.0, 0x4a_1410), (0.35, 0x8c_2a14), (0.62, 0xc9_4a18), (0.85, 0xf0_8a2c), (1.0, 0xff_c35a)], veins * 1.15)
}

fn outer_core(u: f64, v: f64) -> Paint {
    let p = on_sphere(u, v);
    let q = warped(800, p * dvec3(2.0, 3.4, 2.0), 1.1);
    ramp(&[(0.0, 0xd0_5a0c), (0.45, 0xf5_9a1e), (0.7, 0xff_c64a), (1.0, 0xff_f0b0)], 0.5 + 0.75 * fbm(820, q, 5))
}

fn moon(u: f64, v: f64) -> Paint {
    let p = on_sphere(u, v);
    let maria = smoothstep(-0.05, 0.25, fbm(900, p * 1.7, 4));
    let ground = mix(paint(0xb9_b5ae), paint(0x6f_6d6c), maria);
    let grain = 0.9 + 0.14 * fbm(910, p * 14.0, 4);
    paint::scale(ground, grain * craters(p))
}

/// Brightness factor of a fixed set of craters: dark floor, bright rim.
fn craters(p: DVec3) -> f64 {
    let mut random = super::noise::Random::new(77);
    let mut factor = 1.0;
    for _ in 0..90 {
        let center = dvec3(random.range(-1.0, 1.0), random.range(-1.0, 1.0), random.range(-1.0, 1.0)).normalize();
        let size = 0.03 + 0.16 * random.unit() * random.unit();
        let distance = (p - center).length() / size;
        let floor = 0.13 * (1.0 - smoothstep(0.6, 0.95, distance));
        let rim = 0.2 * smoothstep(0.7, 1.0, distance) * (1.0 - smoothstep(1.0, 1.35, distance));
        factor *= 1.0 - floor + rim;
    }
    factor
}
