//! A two-stage gearbox. Shafts run along z in the plane y = 0, where housing and lid meet.

use std::f64::consts::{PI, TAU};

use glam::{DMat3, DVec2, DVec3, dvec2, dvec3};

use super::det;
use super::gear::Gear;
use super::glb::{Glb, Look, Place};
use super::loft::{Loop, circle, divided_rectangle, lathe, lathe_ring, solid};
use super::mesh::Mesh;
use super::shapes::{ball, bevelled_box, torus};

const MODULE: f64 = 0.06;
const TEETH: [usize; 4] = [17, 41, 19, 45];
/// x of the three shafts: centre distances follow from the teeth.
const SHAFT_X: [f64; 3] = [-0.5 * MODULE * (17 + 41) as f64, 0.0, 0.5 * MODULE * (19 + 45) as f64];
/// Middle of the housing in x, half its outer size in x and z.
const MIDDLE: f64 = 0.52;
const HALF: DVec2 = dvec2(3.05, 1.12);
const WALL: f64 = 0.14;
const DEPTH: f64 = 1.78;
const FLANGE: f64 = 0.26;
const FLANGE_THICKNESS: f64 = 0.13;
/// z of the two gear planes.
const STAGE_Z: [f64; 2] = [-0.42, 0.38];
const BEARING_Z: f64 = 0.86;

/// Indices of the materials in the file.
struct Paints {
    cast: usize,
    lid: usize,
    steel: usize,
    dark: usize,
    gears: [usize; 4],
    brass: usize,
    seal: usize,
}

pub fn gearbox() -> Vec<u8> {
    let mut glb = Glb::default();
    let paints = materials(&mut glb);
    let root = glb.node("gearbox", Place::default().at(-MIDDLE, 0.0, 0.0));
    let internals = glb.node("internals", Place::default().under(root));
    casing(&mut glb, &paints, root);
    bolts(&mut glb, &paints, root);
    covers(&mut glb, &paints, root);
    shafts(&mut glb, &paints, internals);
    gears(&mut glb, &paints, internals);
    bearings(&mut glb, &paints, internals);
    glb.finish()
}

fn materials(glb: &mut Glb) -> Paints {
    let gears = [
        ("gear-blue", 0x5b_8fc2, 0.5, 0.34),
        ("gear-amber", 0xd9_a441, 0.5, 0.36),
        ("gear-red", 0xc2_5b4a, 0.5, 0.36),
        ("gear-teal", 0x4a_a895, 0.5, 0.36),
    ];
    Paints {
        cast: glb.material(Look::new("cast-paint", 0x3f_5f73, 0.15, 0.52)),
        lid: glb.material(Look::new("lid-paint", 0x4d_7188, 0.15, 0.48)),
        steel: glb.material(Look::new("steel", 0xc9_cdd2, 0.85, 0.28)),
        dark: glb.material(Look::new("black-oxide", 0x35_383d, 0.7, 0.42)),
        gears: gears.map(|(name, hex, metallic, roughness)| glb.material(Look::new(name, hex, metallic, roughness))),
        brass: glb.material(Look::new("brass", 0xd8_b25c, 0.85, 0.3)),
        seal: glb.material(Look::new("rubber", 0x22_2426, 0.0, 0.85)),
    }
}

/// Lower half, upper half, their ribs, feet and fittings.
fn casing(glb: &mut Glb, paints: &Paints, root: usize) {
    let shell = half_shell();
    let lower = glb.mesh("housing", &shell.clone().moved(flip(), DVec3::ZERO), paints.cast);
    let upper = glb.mesh("lid", &shell, paints.lid);
    let housing = glb.node("housing", Place::mesh(lower).under(root).at(MIDDLE, -0.006, 0.0));
    let lid = glb.node("lid", Place::mesh(upper).under(root).at(MIDDLE, 0.006, 0.0));
    let rib = bevelled_box(dvec3(0.13, DEPTH - 0.35, 0.2), 0.045);
    let ribs = [glb.mesh("rib", &rib, paints.cast), glb.mesh("lid-rib", &rib, paints.lid)];
    for (k, (x, side)) in [-2.2, -0.72, 0.9, 2.55].into_iter().flat_map(|x| [(x, 1.0), (x, -1.0)]).enumerate() {
        let place = |y: f64| Place::mesh(ribs[usize::from(y > 0.0)]).at(x - MIDDLE + 0.35, y, side * (HALF.y + 0.03));
        glb.node(&format!("rib-{}", k + 1), place(-0.82).under(housing));
        glb.node(&format!("lid-rib-{}", k + 1), place(0.78).under(lid));
    }
    feet(glb, paints, housing);
    fittings(glb, paints, lid);
}

fn feet(glb: &mut Glb, paints: &Paints, housing: usize) {
    let foot = glb.mesh("foot", &bevelled_box(dvec3(0.9, 0.2, 2.7), 0.07), paints.cast);
    for (k, x) in [-2.2, 2.2].into_iter().enumerate() {
        glb.node(&format!("foot-{}", k + 1), Place::mesh(foot).under(housing).at(x, -DEPTH - 0.04, 0.0));
    }
}

/// An inspection cover with its screws, an oil filler and two lifting eyes on the lid.
fn fittings(glb: &mut Glb, paints: &Paints, lid: usize) {
    let plate = glb.mesh("inspection-cover", &bevelled_box(dvec3(1.5, 0.1, 1.0), 0.045), paints.dark);
    let cover = glb.node("inspection-cover", Place::mesh(plate).under(lid).at(0.75, DEPTH + 0.04, 0.0));
    let screw = glb.mesh("screw", &bolt(0.055, 0.06, 0.16).upright(), paints.steel);
    for (k, (x, z)) in [(-0.62, -0.38), (0.62, -0.38), (0.62, 0.38), (-0.62, 0.38)].into_iter().enumerate() {
        glb.node(&format!("screw-{}", k + 1), Place::mesh(screw).under(cover).at(x, 0.05, z));
    }
    let filler = glb.mesh("oil-filler", &filler_cap(), paints.brass);
    glb.node("oil-filler", Place::mesh(filler).under(lid).at(-0.9, DEPTH - 0.04, 0.0));
    let eye = glb.mesh("lifting-eye", &torus(0.17, 0.05, 40, 14), paints.steel);
    for (k, x) in [-2.1, 2.35].into_iter().enumerate() {
        glb.node(&format!("lifting-eye-{}", k + 1), Place::mesh(eye).under(lid).at(x, DEPTH + 0.1, 0.0));
    }
}

/// The upper half of the casing: a closed solid with walls, open below, with a flange around the opening at y = 0.
fn half_shell() -> Mesh {
    let (height, round) = (DEPTH, 0.42);
    let level = |outset: f64, y: f64| divided_rectangle(HALF + DVec2::splat(outset), 0.5 + outset, y, 9, [16, 4]);
    let inner = |outset: f64, y: f64| level(outset - WALL, y);
    let between = |count: i32| (1..count).map(move |i| f64::from(i) / f64::from(count));
    // Flat roofs are cut into shrinking loops; the corner radius must stay positive.
    let roof = |scale: f64, y: f64| -> Loop {
        level(-round, y).into_iter().map(|p| dvec3(p.x * scale, p.y * scale, y)).collect()
    };
    let ceiling = height - WALL;
    let mut loops: Vec<Loop> = vec![vec![dvec3(0.0, 0.0, ceiling)]];
    // From the inner ceiling down the inner wall, around the flange, up the outer wall to the roof: the walk begins
    // inside, so the inner faces look into the room.
    loops.extend(between(5).map(|t| roof(t, ceiling)));
    loops.push(inner(-round * 0.6, ceiling));
    loops.push(inner(-round * 0.15, ceiling - 0.12));
    let (high, low) = (ceiling - 0.34, 0.0);
    loops.push(inner(0.0, high));
    loops.extend(between(5).map(|t| inner(0.0, det::lerp(high, low, t))));
    loops.push(inner(0.0, low));
    loops.push(level(FLANGE - 0.02, 0.0));
    loops.push(level(FLANGE, 0.02));
    loops.push(level(FLANGE, FLANGE_THICKNESS - 0.025));
    loops.push(level(FLANGE - 0.025, FLANGE_THICKNESS));
    loops.push(level(0.05, FLANGE_THICKNESS));
    loops.push(level(0.0, FLANGE_THICKNESS + 0.05));
    loops.extend(between(5).map(|t| level(0.0, det::lerp(FLANGE_THICKNESS + 0.05, height - round, t))));
    for step in 0..=5 {
        let angle = PI / 2.0 * f64::from(step) / 5.0;
        loops.push(level(-round * (1.0 - det::cos(angle)), height - round * (1.0 - det::sin(angle))));
    }
    loops.extend(between(5).map(|t| roof(1.0 - t, height)));
    loops.push(vec![dvec3(0.0, 0.0, height)]);
    solid(&loops).upright().shaded(42.0)
}

/// Half a turn about x: the upper half becomes the lower one.
fn flip() -> DMat3 {
    DMat3::from_diagonal(dvec3(1.0, -1.0, -1.0))
}

fn filler_cap() -> Mesh {
    lathe(&[(0.0, 0.0), (0.16, 0.0), (0.16, 0.1), (0.24, 0.13), (0.24, 0.24), (0.2, 0.29), (0.0, 0.3)], 40)
        .shaded(50.0)
        .upright()
}

/// A hexagon bolt about z: the head stands on z = 0, the shank goes down.
fn bolt(radius: f64, head: f64, shank: f64) -> Mesh {
    let hexagon = |scale: f64, z: f64| -> Loop {
        (0..24)
            .map(|i| {
                let angle = TAU * f64::from(i) / 24.0;
                let within = angle - (angle / (PI / 3.0)).floor() * (PI / 3.0) - PI / 6.0;
                let r = scale * 1.6 * radius / det::cos(within);
                dvec3(r * det::cos(angle), r * det::sin(angle), z)
            })
            .collect()
    };
    let washer = 2.15 * radius;
    solid(&[
        vec![dvec3(0.0, 0.0, -shank)],
        circle(0.8 * radius, -shank, 24),
        circle(radius, -shank + 0.2 * radius, 24),
        circle(radius, 0.0, 24),
        circle(washer, 0.0, 24),
        circle(washer, 0.3 * radius, 24),
        hexagon(1.0, 0.3 * radius),
        hexagon(1.0, head + 0.1 * radius),
        circle(1.35 * radius, head + 0.35 * radius, 24),
        vec![dvec3(0.0, 0.0, head + 0.35 * radius)],
    ])
    .shaded(40.0)
}

/// The lid's bolts, around the flange.
fn bolts(glb: &mut Glb, paints: &Paints, root: usize) {
    let mesh = glb.mesh("bolt", &bolt(0.062, 0.09, 2.0 * FLANGE_THICKNESS + 0.05).upright(), paints.dark);
    let group = glb.node("bolts", Place::default().under(root).at(MIDDLE, FLANGE_THICKNESS + 0.006, 0.0));
    let (x, z) = (HALF.x + 0.14, HALF.y + 0.14);
    let mut places = vec![(x, 0.0), (-x, 0.0)];
    for side in [z, -z] {
        places.extend([-2.62, -1.15, 0.62, 2.62].map(|x| (x, side)));
    }
    places.extend([(x, 0.75), (x, -0.75), (-x, 0.75), (-x, -0.75)]);
    for (k, (x, z)) in places.into_iter().enumerate() {
        let turn = det::rotation(DVec3::Y, det::radians(37.0 * k as f64));
        glb.node(&format!("bolt-{}", k + 1), Place::mesh(mesh).under(group).at(x, 0.0, z).turned(turn));
    }
}

/// Bearing covers outside the walls, with a rubber seal around the shafts that come out.
fn covers(glb: &mut Glb, paints: &Paints, root: usize) {
    let cover = cover_ring();
    let cover = glb.mesh("cover", &cover, paints.dark);
    let seal = lathe_ring(&[(0.2, 0.16), (0.31, 0.16), (0.31, 0.3), (0.24, 0.33), (0.2, 0.3)], 48).shaded(40.0);
    let seal = glb.mesh("seal", &seal, paints.seal);
    let cap = lathe(&[(0.0, 0.14), (0.3, 0.14), (0.3, 0.26), (0.26, 0.3), (0.0, 0.32)], 48).shaded(50.0);
    let cap = glb.mesh("cap", &cap, paints.steel);
    let screw = glb.mesh("cover-screw", &bolt(0.042, 0.05, 0.1), paints.steel);
    for (k, (x, side)) in SHAFT_X.into_iter().flat_map(|x| [(x, 1.0), (x, -1.0)]).enumerate() {
        let turn = if side > 0.0 { DMat3::IDENTITY } else { flip() };
        let place = Place::mesh(cover).under(root).at(x, 0.0, side * (HALF.y - 0.02)).turned(turn);
        let node = glb.node(&format!("cover-{}", k + 1), place);
        // The input shaft comes out at the front, the output shaft at the back.
        let open = (x == SHAFT_X[0] && side > 0.0) || (x == SHAFT_X[2] && side < 0.0);
        let (name, mesh) = if open { ("seal", seal) } else { ("cap", cap) };
        glb.node(&format!("{name}-{}", k + 1), Place::mesh(mesh).under(node));
        for i in 0..6 {
            let angle = TAU * (f64::from(i) + 0.5) / 6.0;
            let place = Place::mesh(screw).under(node).at(0.48 * det::cos(angle), 0.48 * det::sin(angle), 0.36);
            glb.node(&format!("cover-screw-{}-{}", k + 1, i + 1), place);
        }
    }
}

fn cover_ring() -> Mesh {
    let profile =
        [(0.3, -0.02), (0.56, -0.02), (0.58, 0.0), (0.58, 0.32), (0.54, 0.36), (0.42, 0.36), (0.36, 0.3), (0.3, 0.3)];
    lathe_ring(&profile, 64).shaded(50.0)
}

/// The three shafts with their keys.
fn shafts(glb: &mut Glb, paints: &Paints, internals: usize) {
    let names = ["shaft-in", "shaft-mid", "shaft-out"];
    // Where each one ends, in z: the input reaches out at the front, the output at the back.
    let ends = [(-1.0, 2.05), (-1.0, 1.0), (-2.15, 1.0)];
    let radii = [0.17, 0.2, 0.22];
    for k in 0..3 {
        let mesh = glb.mesh(names[k], &shaft(radii[k], ends[k]), paints.steel);
        glb.node(names[k], Place::mesh(mesh).under(internals).at(SHAFT_X[k], 0.0, 0.0));
    }
    let key = glb.mesh("key", &bevelled_box(dvec3(0.09, 0.1, 0.52), 0.03), paints.brass);
    for (k, (x, y, z)) in [(SHAFT_X[0], 0.17, 1.76), (SHAFT_X[2], 0.2, -1.8)].into_iter().enumerate() {
        glb.node(&format!("key-{}", k + 1), Place::mesh(key).under(internals).at(x, y, z));
    }
}

/// A stepped shaft: thicker between the bearings, chamfered ends.
fn shaft(radius: f64, (low, high): (f64, f64)) -> Mesh {
    let (journal, shoulder, chamfer) = (0.17, 0.7, 0.035);
    let reach = |end: f64| if end.abs() > 1.2 { 0.165 } else { journal };
    let (a, b) = (reach(low), reach(high));
    let profile = [
        (0.0, low),
        (a - chamfer, low),
        (a, low + chamfer),
        (a, -1.05_f64.max(low + 0.2)),
        (journal, -1.05_f64.max(low + 0.2)),
        (journal, -shoulder),
        (radius + 0.03, -shoulder),
        (radius + 0.03, shoulder),
        (journal, shoulder),
        (journal, 1.05_f64.min(high - 0.2)),
        (b, 1.05_f64.min(high - 0.2)),
        (b, high - chamfer),
        (b - chamfer, high),
        (0.0, high),
    ];
    lathe(&profile, 48).shaded(50.0)
}

/// The four gears, turned so that teeth meet gaps.
fn gears(glb: &mut Glb, paints: &Paints, internals: usize) {
    let shaft_of = [0, 1, 1, 2];
    let stage_of = [0, 0, 1, 1];
    let bores = [0.2, 0.23, 0.23, 0.25];
    // Each pinion is turned by its own angle; its wheel follows by the ratio, half a tooth off where they meet.
    let mut turn = [det::radians(8.0), 0.0, 0.0, 0.0];
    turn[1] = meshing(turn[0], TEETH[0], TEETH[1]);
    turn[2] = turn[1];
    turn[3] = meshing(turn[2], TEETH[2], TEETH[3]);
    for k in 0..4 {
        let width = if k % 2 == 0 { 0.46 } else { 0.4 };
        let gear = Gear { teeth: TEETH[k], module: MODULE, width, bore: bores[k] };
        let name = format!("gear-{}", k + 1);
        let mesh = glb.mesh(&name, &gear.mesh(), paints.gears[k]);
        let place = Place::mesh(mesh).under(internals).at(SHAFT_X[shaft_of[k]], 0.0, STAGE_Z[stage_of[k]]);
        glb.node(&name, place.turned(det::rotation(DVec3::Z, turn[k])));
    }
}

/// The turn of a wheel to the right (+x) of a pinion turned by `angle`, so that a gap faces the pinion's tooth.
fn meshing(angle: f64, pinion: usize, wheel: usize) -> f64 {
    PI + PI / wheel as f64 - angle * pinion as f64 / wheel as f64
}

/// Six ball bearings: rings and a set of balls each.
fn bearings(glb: &mut Glb, paints: &Paints, internals: usize) {
    let inner = lathe_ring(&grooved(0.17, 0.245, 1.0), 56).shaded(40.0);
    let outer = lathe_ring(&grooved(0.42, 0.345, -1.0), 56).shaded(40.0);
    let inner = glb.mesh("inner-ring", &inner, paints.steel);
    let outer = glb.mesh("outer-ring", &outer, paints.steel);
    let seat = lathe_ring(&[(0.421, -0.13), (0.5, -0.13), (0.52, -0.11), (0.52, 0.13), (0.421, 0.13)], 56).shaded(40.0);
    let seat = glb.mesh("seat", &seat, paints.cast);
    let ball = glb.mesh("ball", &ball(0.062, 20, 10), paints.brass);
    for (k, (x, side)) in SHAFT_X.into_iter().flat_map(|x| [(x, 1.0), (x, -1.0)]).enumerate() {
        let place = Place::default().under(internals).at(x, 0.0, side * BEARING_Z);
        let node = glb.node(&format!("bearing-{}", k + 1), place);
        glb.node(&format!("inner-ring-{}", k + 1), Place::mesh(inner).under(node));
        glb.node(&format!("outer-ring-{}", k + 1), Place::mesh(outer).under(node));
        glb.node(&format!("seat-{}", k + 1), Place::mesh(seat).under(node).at(0.0, 0.0, side * 0.03));
        for i in 0..10 {
            let angle = TAU * f64::from(i) / 10.0;
            let place = Place::mesh(ball).under(node).at(0.295 * det::cos(angle), 0.295 * det::sin(angle), 0.0);
            glb.node(&format!("ball-{}-{}", k + 1, i + 1), place);
        }
    }
}

/// A ring's profile from radius `back` to `face`, with a groove in the face; `sense` 1 where the face is outside.
fn grooved(back: f64, face: f64, sense: f64) -> Vec<(f64, f64)> {
    let half = 0.1;
    let mut profile = vec![(back, -half), (face, -half)];
    let groove = (-3..=3).map(|i| {
        let t = f64::from(i) / 3.0;
        (face - sense * 0.022 * (1.0 - t * t).sqrt(), 0.055 * t)
    });
    profile.extend(groove);
    profile.extend([(face, half), (back, half)]);
    if sense < 0.0 {
        profile.reverse();
    }
    profile
}
