//! Small models for property tests: a few solids each, named, with plain colours.

use glam::{DVec2, DVec3, DVec4, dvec2, dvec3, dvec4};

use super::Generated;
use super::det;
use super::glb::{Alpha, Glb, Light, Look, Place, Sampling, Spot};
use super::mesh::Mesh;
use super::paint;
use super::shapes::{ball, cuboid, quad};

pub fn all() -> Vec<Generated> {
    vec![
        Generated { name: "ball-in-box.glb", bytes: ball_in_box() },
        Generated { name: "panes.glb", bytes: panes() },
        Generated { name: "steps.glb", bytes: steps() },
        Generated { name: "cubes.glb", bytes: cubes() },
        Generated { name: "two-rooms.glb", bytes: two_rooms() },
        Generated { name: "textured-quad.glb", bytes: textured_quad() },
        Generated { name: "lights.glb", bytes: lights() },
        Generated { name: "vertex-colors.glb", bytes: vertex_colors() },
        Generated { name: "heat.glb", bytes: heat() },
        Generated { name: "cutout.glb", bytes: cutout() },
        Generated { name: "motion.glb", bytes: motion() },
        Generated { name: "bumps.glb", bytes: bumps() },
    ]
}

/// Adds a mesh with a material of its own and a node, all of one name.
fn add(glb: &mut Glb, look: Look, mesh: &Mesh, at: DVec3) -> usize {
    let name = look.name;
    let material = glb.material(look);
    let mesh = glb.mesh(name, mesh, material);
    glb.node(name, Place::mesh(mesh).at(at.x, at.y, at.z))
}

fn plain(name: &'static str, hex: u32) -> Look {
    Look::new(name, hex, 0.0, 0.7)
}

/// An opaque box from -1 to 1 with a ball of radius 0.6 in it.
fn ball_in_box() -> Vec<u8> {
    let mut glb = Glb::default();
    add(&mut glb, plain("box", 0x6f_8fb0), &cuboid(DVec3::ZERO, DVec3::splat(2.0)), DVec3::ZERO);
    add(&mut glb, plain("ball", 0xe0_7a3c), &ball(0.6, 32, 16), DVec3::ZERO);
    glb.finish()
}

/// Five parallel panes of half-transparent colours, farthest first in the file, before an opaque wall.
fn panes() -> Vec<u8> {
    let mut glb = Glb::default();
    add(
        &mut glb,
        plain("wall", 0xd8_d4cc),
        &cuboid(dvec3(0.0, 0.0, -0.1), dvec3(3.0, 2.4, 0.2)),
        dvec3(0.0, 0.0, -1.5),
    );
    let colors =
        [("red", 0xd9_3a3a), ("yellow", 0xe8_c33a), ("green", 0x3a_b058), ("blue", 0x3a_6ad9), ("violet", 0x9a_48c8)];
    for (k, (name, hex)) in colors.into_iter().enumerate() {
        let step = k as f64 - 2.0;
        add(
            &mut glb,
            plain(name, hex).blended(0.5),
            &quad(dvec2(1.2, 1.2)),
            dvec3(0.3 * step, 0.12 * step, 0.5 * step),
        );
    }
    glb.finish()
}

/// Six steps, each a box of its own, that rise away from the eye.
fn steps() -> Vec<u8> {
    let mut glb = Glb::default();
    let paints = [plain("light", 0xd6_c9ae), plain("dark", 0x7c_6a55)].map(|look| glb.material(look));
    for k in 0..6 {
        let height = 0.25 * (k + 1) as f64;
        let step = cuboid(dvec3(0.0, 0.5 * height, 0.0), dvec3(2.0, height, 0.4));
        let name = format!("step-{}", k + 1);
        let mesh = glb.mesh(&name, &step, paints[k % 2]);
        glb.node(&name, Place::mesh(mesh).at(0.0, 0.0, 1.0 - 0.4 * k as f64));
    }
    glb.finish()
}

/// 4 x 4 x 4 cubes of one mesh in three materials, named `cube-x-y-z`; layers of equal y are groups `layer-y`.
fn cubes() -> Vec<u8> {
    let mut glb = Glb::default();
    let cube = cuboid(DVec3::ZERO, DVec3::splat(0.3));
    let meshes = [("coral", 0xe0_6a5a), ("sand", 0xe2_c27a), ("sea", 0x3f_8fa0)].map(|(name, hex)| {
        let material = glb.material(plain(name, hex));
        glb.mesh(name, &cube, material)
    });
    let place = |k: usize| 0.5 * (k as f64 - 1.5);
    for y in 0..4 {
        let layer = glb.node(&format!("layer-{y}"), Place::default().at(0.0, place(y), 0.0));
        for (x, z) in (0..16).map(|i| (i % 4, i / 4)) {
            let cube = Place::mesh(meshes[(x + y + z) % 3]).under(layer).at(place(x), 0.0, place(z));
            glb.node(&format!("cube-{x}-{y}-{z}"), cube);
        }
    }
    glb.finish()
}

/// Two rooms side by side with a doorway between them, a roof, a table in one and a ball in the other.
fn two_rooms() -> Vec<u8> {
    let mut glb = Glb::default();
    let paints =
        [("floor", 0xa8_8a68), ("wall", 0xe6_e0d4), ("roof", 0x8a_4438), ("wood", 0x6a_4a30), ("rubber", 0x2f_7fb8)]
            .map(|(name, hex)| glb.material(plain(name, hex)));
    let mut block = |name: &str, material: usize, min: [f64; 3], max: [f64; 3]| {
        let (min, max) = (DVec3::from_array(min), DVec3::from_array(max));
        let mesh = glb.mesh(name, &cuboid((min + max) * 0.5, max - min), paints[material]);
        glb.node(name, Place::mesh(mesh))
    };
    block("floor", 0, [-2.1, -0.1, -1.1], [2.1, 0.0, 1.1]);
    block("wall-west", 1, [-2.1, 0.0, -1.1], [-2.0, 1.2, 1.1]);
    block("wall-east", 1, [2.0, 0.0, -1.1], [2.1, 1.2, 1.1]);
    block("wall-north", 1, [-2.0, 0.0, -1.1], [2.0, 1.2, -1.0]);
    block("wall-south", 1, [-2.0, 0.0, 1.0], [2.0, 1.2, 1.1]);
    block("divider-back", 1, [-0.05, 0.0, -1.0], [0.05, 1.2, -0.1]);
    block("divider-front", 1, [-0.05, 0.0, 0.5], [0.05, 1.2, 1.0]);
    block("lintel", 1, [-0.05, 0.9, -0.1], [0.05, 1.2, 0.5]);
    block("roof", 2, [-2.15, 1.2, -1.15], [2.15, 1.3, 1.15]);
    block("table-top", 3, [-1.5, 0.4, -0.4], [-0.6, 0.46, 0.3]);
    block("table-foot", 3, [-1.12, 0.0, -0.12], [-0.98, 0.4, 0.02]);
    let rubber = glb.mesh("ball", &ball(0.4, 28, 14), paints[4]);
    glb.node("ball", Place::mesh(rubber).at(1.0, 0.4, 0.0));
    glb.finish()
}

/// One checker on three quads with texture coordinates from -1 to 2: repeated and smooth, mirrored and sharp, clamped.
fn textured_quad() -> Vec<u8> {
    let mut glb = Glb::default();
    let checker = paint::png(paint::rgb(32, 32, checker));
    let modes = [
        ("repeat", Sampling { mag_filter: 9729, min_filter: 9987, wrap_s: Sampling::REPEAT, wrap_t: Sampling::REPEAT }),
        ("mirror", Sampling { mag_filter: 9728, min_filter: 9728, wrap_s: Sampling::MIRROR, wrap_t: Sampling::MIRROR }),
        ("clamp", Sampling { mag_filter: 9728, min_filter: 9985, wrap_s: Sampling::CLAMP, wrap_t: Sampling::CLAMP }),
    ];
    let mut mesh = quad(DVec2::ONE);
    mesh.uv.iter_mut().for_each(|uv| *uv = *uv * 3.0 - 1.0);
    for (k, (name, sampling)) in modes.into_iter().enumerate() {
        let texture = glb.texture(name, &checker, sampling);
        add(&mut glb, plain(name, 0xff_ffff).textured(texture), &mesh, dvec3(1.1 * (k as f64 - 1.0), 0.0, 0.0));
    }
    glb.finish()
}

/// A checker whose four corners differ, so that a flip or a turn shows.
fn checker(u: f64, v: f64) -> paint::Paint {
    let hex = match (u < 0.25, u >= 0.75, v < 0.25, v >= 0.75) {
        (true, _, true, _) => 0xd9_3a3a,
        (_, true, true, _) => 0x3a_b058,
        (true, _, _, true) => 0x3a_6ad9,
        (_, true, _, true) => 0xe8_c33a,
        _ if ((u * 8.0) as u32 + (v * 8.0) as u32).is_multiple_of(2) => 0xf0_ece4,
        _ => 0x2c_3038,
    };
    paint::paint(hex)
}

/// A sphere on a plane under a point, a spot and a directional light.
fn lights() -> Vec<u8> {
    let mut glb = Glb::default();
    add(&mut glb, plain("plane", 0xb8_b8b8), &cuboid(dvec3(0.0, -0.05, 0.0), dvec3(4.0, 0.1, 4.0)), DVec3::ZERO);
    add(&mut glb, Look::new("sphere", 0xe8_e8e8, 0.0, 0.35), &ball(0.6, 40, 20), dvec3(0.0, 0.6, 0.0));
    let light =
        |name, kind, hex, intensity| Light { name, kind, color: det::rgb(hex), intensity, range: None, spot: None };
    let point = Light { range: Some(6.0), ..light("point", "point", 0xff_9a5a, 9.0) };
    glb.light(Place::default().at(-1.4, 1.2, 0.9), point);
    let spot = Spot { inner_cone_angle: 0.25, outer_cone_angle: 0.45 };
    let spot = Light { spot: Some(spot), ..light("spot", "spot", 0x6a_b0ff, 30.0) };
    // Straight down: -z of the node becomes -y.
    let down = det::rotation(DVec3::X, -std::f64::consts::FRAC_PI_2);
    glb.light(Place::default().at(1.2, 2.4, 0.0).turned(down), spot);
    let slanting = det::rotation(DVec3::X, -0.8);
    glb.light(Place::default().turned(slanting), light("sun", "directional", 0xff_f4e0, 0.8));
    glb.finish()
}

/// A colour cube and a ball banded by vertex colours; the ball's material halves its red.
fn vertex_colors() -> Vec<u8> {
    let mut glb = Glb::default();
    let byte = |v: f64| (v * 255.0).round().clamp(0.0, 255.0) as u8;
    let mut cube = cuboid(DVec3::ZERO, DVec3::ONE);
    cube.colors = cube.positions.iter().map(|p| [byte(p.x + 0.5), byte(p.y + 0.5), byte(p.z + 0.5), 255]).collect();
    add(&mut glb, plain("cube", 0xff_ffff), &cube, dvec3(-0.7, 0.0, 0.0));
    let mut globe = ball(0.55, 32, 16);
    globe.colors = globe.positions.iter().map(|p| [255, byte(p.y + 0.5), byte(0.5 - p.y), 255]).collect();
    let mut look = plain("globe", 0xff_ffff);
    look.color[0] = 0.5;
    add(&mut glb, look, &globe, dvec3(0.7, 0.0, 0.0));
    glb.finish()
}

/// A ball with a temperature at each vertex, hottest to the front and the right, on a plate that has none.
fn heat() -> Vec<u8> {
    let mut glb = Glb::default();
    add(&mut glb, plain("plate", 0x8a_94a0), &cuboid(dvec3(0.0, -0.75, 0.0), dvec3(2.2, 0.1, 1.6)), DVec3::ZERO);
    let mut globe = ball(0.7, 48, 24);
    let hot = dvec3(0.4, 0.3, 0.6);
    let heat = |p: &DVec3| 20.0 + 80.0 / (1.0 + 4.0 * (*p - hot).length_squared());
    globe.temperatures = globe.positions.iter().map(|p| [heat(p) as f32]).collect();
    add(&mut glb, plain("ball", 0xd8_d4cc), &globe, DVec3::ZERO);
    glb.finish()
}

/// A screen with round holes (alpha MASK) before an orange ball.
fn cutout() -> Vec<u8> {
    let mut glb = Glb::default();
    let screen = paint::png(paint::rgba(128, 128, |u, v| {
        let cell = dvec2(u, v) * 4.0;
        let hole = (cell - cell.floor() - DVec2::splat(0.5)).length();
        (paint::paint(0x5f_7a6a), det::smoothstep(0.3, 0.36, hole))
    }));
    let texture = glb.texture("screen", &screen, Sampling::SMOOTH);
    let mut look = plain("screen", 0xff_ffff).textured(texture);
    look.alpha = Alpha::Mask(0.5);
    add(&mut glb, look, &quad(dvec2(2.0, 2.0)), DVec3::ZERO);
    add(&mut glb, plain("ball", 0xe0_7a3c), &ball(0.7, 32, 16), dvec3(0.0, 0.0, -1.0));
    glb.finish()
}

/// Two animations of two seconds before a wall: an arm with a ball at its end makes a half turn about the z axis, a box
/// slides to the right on a curve and changes its size, and a camera moves to the right.
fn motion() -> Vec<u8> {
    let mut glb = Glb::default();
    add(&mut glb, plain("wall", 0xb8_b4a8), &cuboid(dvec3(0.0, 0.0, -0.6), dvec3(4.0, 3.0, 0.2)), DVec3::ZERO);
    let paints = [("steel", 0x6f_8fb0), ("rubber", 0xe0_7a3c), ("wood", 0x8a_6a40)]
        .map(|(name, hex)| glb.material(plain(name, hex)));
    let bar = glb.mesh("arm", &cuboid(dvec3(0.45, 0.0, 0.0), dvec3(0.9, 0.12, 0.12)), paints[0]);
    let arm = glb.node("arm", Place::mesh(bar).at(-0.6, 0.2, 0.0));
    let globe = glb.mesh("ball", &ball(0.25, 28, 14), paints[1]);
    glb.node("ball", Place::mesh(globe).under(arm).at(0.9, 0.0, 0.0));
    let block = glb.mesh("box", &cuboid(DVec3::ZERO, DVec3::splat(0.5)), paints[2]);
    let slider = glb.node("box", Place::mesh(block).at(-1.4, -0.9, 0.0));
    let eye = glb.camera("eye", Place::default().at(-1.0, 0.4, 4.0), 0.7);
    glb.animation("swing");
    let half = std::f32::consts::FRAC_1_SQRT_2;
    let turns = [[0.0, 0.0, 0.0, 1.0], [0.0, 0.0, half, half], [0.0, 0.0, 1.0, 0.0]];
    glb.channel(arm, "rotation", "LINEAR", &[0.0, 1.0, 2.0], &turns);
    glb.channel(eye, "translation", "LINEAR", &[0.0, 2.0], &[[-1.0, 0.4, 4.0], [1.0, 0.4, 4.0]]);
    glb.animation("slide");
    let (still, right) = ([0.0; 3], [1.4, 0.0, 0.0]);
    let keys = [still, [-1.4, -0.9, 0.0], still, right, [0.0, -0.9, 0.4], right, still, [1.4, -0.9, 0.0], still];
    glb.channel(slider, "translation", "CUBICSPLINE", &[0.0, 1.0, 2.0], &keys);
    glb.channel(slider, "scale", "STEP", &[0.0, 1.0, 2.0], &[[1.0; 3], [1.0, 1.4, 1.0], [1.6, 0.8, 1.0]]);
    glb.finish()
}

/// Eight panels a unit apart that look alike: a round bump of a normal map, radius 0.35, whatever way the texture lies on
/// them. From left to right as it is, mirrored, turned, and as it is on a mirrored node; the lower row has tangents.
fn bumps() -> Vec<u8> {
    let mut glb = Glb::default();
    let map = paint::png(paint::rgb(128, 128, bump));
    let texture = glb.texture("bump", &map, Sampling { min_filter: 9729, ..Sampling::SMOOTH });
    let mut look = plain("panel", 0xd8_d4cc);
    look.normal_map = Some(texture);
    let material = glb.material(look);
    type Turn = fn(DVec2) -> DVec2;
    // What becomes of texture coordinates, and the tangent that goes with it.
    let lies: [(&str, Turn, DVec4); 3] = [
        ("plain", |uv| uv, dvec4(1.0, 0.0, 0.0, 1.0)),
        ("mirrored", |uv| dvec2(1.0 - uv.x, uv.y), dvec4(-1.0, 0.0, 0.0, -1.0)),
        ("turned", |uv| dvec2(1.0 - uv.y, uv.x), dvec4(0.0, 1.0, 0.0, 1.0)),
    ];
    for (row, suffix) in [(0, ""), (1, "-tangents")] {
        let y = 0.5 - f64::from(row);
        let meshes = lies.map(|(_, turn, tangent)| {
            let mut panel = quad(DVec2::splat(0.9));
            panel.uv.iter_mut().for_each(|uv| *uv = turn(*uv));
            if row == 1 {
                panel.tangents = vec![tangent; 4];
            }
            glb.mesh("panel", &panel, material)
        });
        for (k, mesh) in meshes.into_iter().enumerate() {
            glb.node(&format!("{}{suffix}", lies[k].0), Place::mesh(mesh).at(k as f64 - 1.5, y, 0.0));
        }
        let mirror = Place::mesh(meshes[0]).at(1.5, y, 0.0).scaled(dvec3(-1.0, 1.0, 1.0));
        glb.node(&format!("node{suffix}"), mirror);
    }
    glb.finish()
}

/// The normals of a round bump, +y up the image, as a normal map has them.
fn bump(u: f64, v: f64) -> paint::Paint {
    let at = dvec2(u - 0.5, 0.5 - v) * (0.9 / 0.35);
    let slope = if at.length_squared() < 1.0 { at * 0.8 } else { DVec2::ZERO };
    slope.extend((1.0 - slope.length_squared()).sqrt()).to_array().map(|c| (c * 0.5 + 0.5) * 255.0)
}
