//! Random cases: the same seed makes the same case.

mod filter;
mod lens;
mod mesh;
mod rule;
mod scene;
mod shape;

use glam::DVec3;

use crate::case::{Camera, Case, Color, Projection};
use crate::random::Random;

/// One case of so many has nothing but lenses of one convex volume that change what is in its place; all others have
/// every feature at least once. A GPU backend compiles shaders for what a case needs, and there is no time for all mixtures.
const PLAIN: usize = 3;
/// At most so many filters of a case move content: each doubles the ways in which a triangle may be shown.
const MOVERS: usize = 3;
/// Pixels of a picture.
const SIZE: [u32; 2] = [64, 48];
/// One case of so many has many lenses; its picture is smaller, for the engine that draws every layer by itself.
const CROWDED: usize = 20;
const CROWD: usize = 40;
const CROWDED_SIZE: [u32; 2] = [40, 30];

pub fn case(seed: u64) -> Case {
    // Seeds that follow each other start far apart.
    let mut random = Random::new(seed.wrapping_mul(0xd134_2543_de82_ef95));
    let random = &mut random;
    let is_plain = random.index(PLAIN) == 0;
    let is_crowded = random.index(CROWDED) == 0;
    let mut case = Case {
        models: scene::models(random),
        solids: if is_plain { Vec::new() } else { mesh::solids(random) },
        hide: scene::hidden(random),
        cull: random.chance(0.15),
        camera: camera(if is_crowded { CROWDED_SIZE } else { SIZE }, random),
        background: if random.chance(0.15) { [0; 4] } else { opaque(random) },
        lenses: Vec::new(),
        rules: Vec::new(),
    };
    let count = if is_crowded { CROWD } else { 2 + random.index(11) };
    if is_plain {
        lens::add(&mut case, count, 0, random);
        return case;
    }
    let movers = 1 + random.index(MOVERS);
    lens::add(&mut case, count, movers, random);
    lens::fade_one(&mut case, random);
    lens::cap_one(&mut case, random);
    if random.chance(0.4) {
        rule::add(&mut case, random);
    }
    case
}

fn camera(size: [u32; 2], random: &mut Random) -> Camera {
    let is_perspective = random.chance(0.7);
    // Sometimes among the things that it looks at.
    let distance = if random.chance(0.2) { random.between(0.2, 0.9) } else { random.between(1.8, 3.5) };
    let eye = rounded(direction(random) * distance);
    let target = rounded(point(random, 0.3));
    let projection = match is_perspective {
        true => Projection::Perspective(tidy(random.between(25.0, 60.0))),
        false => Projection::Orthographic(tidy(random.between(1.2, 3.0))),
    };
    let near = random.chance(0.3).then(|| tidy(random.between(0.05, 0.9 * distance)));
    let far = random.chance(0.3).then(|| tidy(distance + random.between(0.0, 1.5)));
    Camera { eye, target, up: rounded(direction(random)), projection, near, far, size }
}

fn opaque(random: &mut Random) -> Color {
    std::array::from_fn(|i| if i == 3 { 255 } else { random.index(256) as u8 })
}

fn color(random: &mut Random) -> Color {
    let [r, g, b, _] = opaque(random);
    let alpha = if random.chance(0.15) { 40 + random.index(180) as u8 } else { 255 };
    [r, g, b, alpha]
}

fn pick<'a, T>(random: &mut Random, all: &'a [T]) -> &'a T {
    &all[random.index(all.len())]
}

/// Few digits, so that specs are easy to read; exact in f32 it need not be.
fn tidy(x: f64) -> f64 {
    (1000.0 * x).round() / 1000.0
}

fn rounded(v: DVec3) -> DVec3 {
    DVec3::from_array(v.to_array().map(tidy))
}

/// As a file stores it.
fn single(v: DVec3) -> DVec3 {
    v.as_vec3().as_dvec3()
}

fn point(random: &mut Random, reach: f64) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|_| random.between(-reach, reach)))
}

/// Unit length.
fn direction(random: &mut Random) -> DVec3 {
    loop {
        let p = point(random, 1.0);
        if (0.1..1.0).contains(&p.length()) {
            return p.normalize();
        }
    }
}
