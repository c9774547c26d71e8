//! Cuts whose areas are known.

use std::f64::consts::PI;

use glam::{Vec3, Vec4};
use lenspeel::frame::Frame;
use lenspeel::pixel::cap_maker;
use lenspeel::scene::Primitive;

use crate::solids::{LENS, Part, ball, cuboid, halves, planned, second, sheet, turned, with, with_seam};
use crate::{Draw, SHARE, cap_pixels, has_area, maps};

pub type Check = fn(Draw) -> Result<(), String>;

pub const ALL: [(&str, Check); 27] = [
    ("a-ball-cut-by-a-plane", plane),
    ("a-ball-cut-by-a-plane-in-perspective", plane_in_perspective),
    ("a-ball-cut-by-a-sphere", sphere),
    ("a-part-in-a-housing", housing),
    ("balls-in-balls", nested),
    ("two-erasers-that-overlap", two_erasers),
    ("the-eye-inside-a-solid", eye_inside),
    ("a-solid-beyond-near-and-far", beyond_near_and_far),
    ("a-cut-magnified", magnified),
    ("a-cut-over-a-magnifier", over_magnifier),
    ("a-lens-that-cuts-and-magnifies", cut_and_magnified),
    ("a-cut-moved-where-no-lens-is", moved_away),
    ("one-surface-of-a-node-moved", one_surface_moved),
    ("the-inner-surface-of-a-node", inner_surface),
    ("an-inner-surface-that-is-not-cut", inner_surface_not_cut),
    ("surfaces-that-are-closed-together", closed_together),
    ("a-seam-as-good-as-sines-are", seam),
    ("a-sheet-beside-a-solid", sheet_beside),
    ("triangles-turned-round", some_turned),
    ("a-hole-far-from-the-cut", hole_far_off),
    ("solids-of-one-mesh-that-overlap", overlapping),
    ("a-mesh-lens-of-solids-that-overlap", mesh_lens),
    ("lenses-below-the-eraser-leave-its-cap", lower_lens),
    ("own-colours-of-the-nearest-surface", own_colors),
    ("edges-between-caps-of-nodes", edges_between),
    ("the-outline-of-a-cap", outline),
    ("outlines-between-caps-of-nodes", outline_between),
];

/// What both engines draw: they find caps in one way, and differ in the layers around them.
#[cfg(feature = "gpu")]
pub const PEELED: [&str; 4] =
    ["a-ball-cut-by-a-plane", "two-erasers-that-overlap", "a-cut-magnified", "balls-in-balls"];

/// Pixels of a picture's side.
pub const SIDE: u32 = 500;
/// Seen from +z; a picture is so many units high.
const HEIGHT: f64 = 3.0;
pub const ABOVE: &str = "eye = [0, 0, 5]\ntarget = [0, 0, 0]\northographic_height = 3";

/// A lens over all above a height.
pub fn above(z: f64, filter: &str) -> String {
    lens("cut", &format!("box = {{ min = [-3, -3, {z}], max = [3, 3, 3] }}"), filter)
}

fn lens(name: &str, shape: &str, filter: &str) -> String {
    format!("[[lens]]\nname = \"{name}\"\nshape.{shape}\nfilters = [{filter}]\nglass = false\n")
}

pub const CAP: &str = "{ erase = { cap = \"tomato\" } }";

/// Pixels of an area seen from above.
pub fn pixels(area: f64) -> f64 {
    area * (f64::from(SIDE) / HEIGHT).powi(2)
}

fn one_ball() -> Vec<Part> {
    vec![("ball", vec![ball(1.0, 192)])]
}

fn plane(draw: Draw) -> Result<(), String> {
    let frame = draw(&planned(one_ball(), SIDE, ABOVE, &above(0.3, CAP)))?;
    let aovs = maps(&frame)?;
    // It lies in the plane, and faces the viewer.
    let off =
        |at: usize| (aovs.depth[at] - 4.7).abs() > 1e-4 || (Vec3::from(aovs.normals[at]) - Vec3::Z).length() > 1e-5;
    if let Some(at) = (0..aovs.depth.len()).find(|at| cap_maker(aovs.triangles[*at]).is_some() && off(*at)) {
        return Err(format!("pixel {at} has depth {} and normal {:?}", aovs.depth[at], aovs.normals[at]));
    }
    has_area(aovs, 0, pixels(PI * (1.0 - 0.09)))
}

fn plane_in_perspective(draw: Draw) -> Result<(), String> {
    let camera = "eye = [0, 0, 4]\ntarget = [0, 0, 0]\nfov_y = 40";
    let frame = draw(&planned(one_ball(), SIDE, camera, &above(0.3, CAP)))?;
    let scale = 0.5 * f64::from(SIDE) / 20f64.to_radians().tan() / 3.7;
    has_area(maps(&frame)?, 0, PI * (1.0 - 0.09) * scale * scale)
}

/// Where two spheres meet they have a circle in common.
fn sphere(draw: Draw) -> Result<(), String> {
    let cut = lens("cut", "sphere = { center = [0, 0, 1], radius = 0.8 }", CAP);
    let frame = draw(&planned(one_ball(), SIDE, ABOVE, &cut))?;
    let height: f64 = (1.0 + 1.0 - 0.64) / 2.0;
    has_area(maps(&frame)?, 0, pixels(PI * (1.0 - height * height)))
}

/// The walls of a hollow housing, and a part within it that touches none of them.
pub fn housing_and_part() -> Vec<Part> {
    let hollow = with(cuboid(Vec3::ZERO, Vec3::ONE), turned(cuboid(Vec3::ZERO, Vec3::splat(0.8))));
    vec![("housing", vec![hollow]), ("part", vec![cuboid(Vec3::new(0.1, 0.0, 0.0), Vec3::new(0.4, 0.3, 0.5))])]
}

fn housing(draw: Draw) -> Result<(), String> {
    // Turned, so that no edge runs along a row of pixels.
    let camera = format!("{ABOVE}\nup = [0.31, 1, 0]");
    let frame = draw(&planned(housing_and_part(), SIDE, &camera, &above(0.2, CAP)))?;
    let aovs = maps(&frame)?;
    has_area(aovs, 0, pixels(4.0 - 2.56))?;
    has_area(aovs, 1, pixels(0.8 * 0.6))
}

/// The inner one of solids that lie in each other has the cap; and there are more crossings than there is room at first.
fn nested(draw: Draw) -> Result<(), String> {
    const NAMES: [&str; 10] = ["b0", "b1", "b2", "b3", "b4", "b5", "b6", "b7", "b8", "b9"];
    let radius = |i: usize| 1.1 - 0.1 * i as f64;
    let parts = NAMES.iter().enumerate().map(|(i, name)| (*name, vec![ball(radius(i), 192)])).collect();
    let frame = draw(&planned(parts, SIDE, ABOVE, &above(0.0, CAP)))?;
    let aovs = maps(&frame)?;
    for i in 0..NAMES.len() {
        let hole = if i + 1 < NAMES.len() { radius(i + 1) } else { 0.0 };
        has_area(aovs, i, pixels(PI * (radius(i).powi(2) - hole.powi(2))))?;
    }
    Ok(())
}

/// A step: half the ball cut at one height, half at another, with no wall where one eraser lies in the other.
fn two_erasers(draw: Draw) -> Result<(), String> {
    let left = lens("left", "box = { min = [-3, -3, 0.3], max = [0.2, 3, 3] }", CAP);
    let right = lens("right", "box = { min = [0, -3, -0.2], max = [3, 3, 3] }", CAP);
    let frame = draw(&planned(one_ball(), SIDE, ABOVE, &(left + &right)))?;
    let aovs = maps(&frame)?;
    has_area(aovs, 0, pixels(PI / 2.0 * (1.0 - 0.09 + 1.0 - 0.04)))?;
    // Those of `left` within `right` would lie at its height.
    let within = |at: usize| at % SIDE as usize > SIDE as usize / 2 && (aovs.depth[at] - 4.7).abs() < 1e-3;
    let wrong = (0..aovs.depth.len()).filter(|at| cap_maker(aovs.triangles[*at]).is_some() && within(*at)).count();
    if wrong == 0 { Ok(()) } else { Err(format!("{wrong} pixels are closed where nothing is left")) }
}

/// All around the eye a cap at one distance, whatever lies before the near plane.
fn eye_inside(draw: Draw) -> Result<(), String> {
    let camera = "eye = [0.1, 0.2, 0.3]\ntarget = [0, 0, -1]\nfov_y = 80\nnear = 0.2";
    let cut = lens("cut", "sphere = { center = [0.1, 0.2, 0.3], radius = 0.4 }", CAP);
    let opened = planned(one_ball(), 120, camera, &cut);
    let frame = draw(&opened)?;
    let aovs = maps(&frame)?;
    let view = &opened.plan.view;
    for at in 0..aovs.depth.len() {
        let (x, y) = ((at % 120) as f64 + 0.5, (at / 120) as f64 + 0.5);
        let away = view.ray(x, y).at(aovs.depth[at]).distance(view.eye);
        if cap_maker(aovs.triangles[at]).is_none() || (away - 0.4).abs() > 1e-4 {
            return Err(format!("at {x},{y} triangle {} is seen {away} from the eye", aovs.triangles[at]));
        }
    }
    Ok(())
}

/// What lies beyond the far plane, or before the near one, is part of the solid all the same.
fn beyond_near_and_far(draw: Draw) -> Result<(), String> {
    let tall = vec![("bar", vec![cuboid(Vec3::ZERO, Vec3::new(0.5, 0.6, 9.0))])];
    let camera = format!("{ABOVE}\nnear = 4\nfar = 5.5");
    let cut = lens("cut", "box = { min = [-3, -3, -0.2], max = [3, 3, 0.3] }", CAP);
    let opened = planned(tall, SIDE, &camera, &cut);
    let frame = draw(&opened)?;
    let aovs = maps(&frame)?;
    // The one cap that is seen faces away: the bar goes on to the eye before the near plane.
    has_area(aovs, 0, pixels(1.2))?;
    let front = |at: &usize| cap_maker(aovs.triangles[*at]).is_some() && (aovs.depth[*at] - 4.7).abs() < 1e-4;
    let seen = (0..aovs.depth.len()).filter(front).count();
    if seen == cap_pixels(aovs, 0) { Ok(()) } else { Err(format!("only {seen} pixels show the nearer cap")) }
}

fn magnified(draw: Draw) -> Result<(), String> {
    let small = vec![("ball", vec![ball(0.5, 192)])];
    let loupe = lens("loupe", "sphere = { center = [0, 0, 0], radius = 4 }", "{ magnify = { factor = 2 } }");
    let frame = draw(&planned(small, SIDE, ABOVE, &(above(0.15, CAP) + &loupe)))?;
    has_area(maps(&frame)?, 0, pixels(PI * (1.0 - 0.09)))
}

fn over_magnifier(draw: Draw) -> Result<(), String> {
    let small = vec![("ball", vec![ball(0.5, 192)])];
    let loupe = lens("loupe", "sphere = { center = [0, 0, 0], radius = 4 }", "{ magnify = { factor = 2 } }");
    let frame = draw(&planned(small, SIDE, ABOVE, &(loupe + &above(0.3, CAP))))?;
    let aovs = maps(&frame)?;
    let middle = (SIDE / 2 * SIDE + SIDE / 2) as usize;
    if (Vec3::from(aovs.normals[middle]) - Vec3::Z).length() > 1e-5 {
        return Err(format!("the cut faces {:?}", aovs.normals[middle]));
    }
    has_area(aovs, 0, pixels(PI * (1.0 - 0.09)))
}

/// What a lens erases it does not move: the ball is cut where it stands.
fn cut_and_magnified(draw: Draw) -> Result<(), String> {
    let frame =
        draw(&planned(one_ball(), SIDE, ABOVE, &above(0.3, &format!("{CAP}, {{ magnify = {{ factor = 2 }} }}"))))?;
    has_area(maps(&frame)?, 0, pixels(PI * (1.0 - 0.09)))
}

/// A lens that takes whole objects shows the cut where neither it nor the eraser is.
fn moved_away(draw: Draw) -> Result<(), String> {
    let small = vec![("ball", vec![ball(0.3, 192)])];
    let camera = "eye = [4.5, 0, 5]\ntarget = [4.5, 0, 0]\northographic_height = 3";
    let cut = lens("cut", "box = { min = [-0.4, -0.4, 0.1], max = [0.4, 0.4, 0.4] }", CAP);
    let away = lens("away", "sphere = { center = [0, 0, 0], radius = 0.5 }", "{ displace = { offset = [4.5, 0, 0] } }");
    let frame = draw(&planned(small, SIDE, camera, &(cut + &away + "by = \"object\"\n")))?;
    has_area(maps(&frame)?, 0, pixels(PI * (0.09 - 0.01)))
}

const CAP_SECOND: &str = "{ erase = { materials = [\"second\"], cap = \"tomato\" } }";

/// A node is moved as a whole, although one of its surfaces is not cut and lies outside the lens that moves it.
fn one_surface_moved(draw: Draw) -> Result<(), String> {
    let far = cuboid(Vec3::new(0.0, 40.0, 0.0), Vec3::splat(0.1));
    let parts = vec![("ball", vec![far, second(ball(0.5, 192))])];
    let loupe = lens("loupe", "sphere = { center = [0, 0, 0], radius = 4 }", "{ magnify = { factor = 2 } }");
    let frame = draw(&planned(parts, SIDE, ABOVE, &(above(0.15, CAP_SECOND) + &loupe)))?;
    has_area(maps(&frame)?, 0, pixels(PI * (1.0 - 0.09)))
}

/// A surface that lies in another one of its node has a cap though that has none.
fn inner_surface(draw: Draw) -> Result<(), String> {
    let parts = vec![("balls", vec![ball(1.0, 192), second(ball(0.6, 192))])];
    // What is not erased is not seen, or it would hide the cap.
    let frame = draw(&planned(parts, SIDE, ABOVE, &above(0.0, &clear(CAP_SECOND))))?;
    has_area(maps(&frame)?, 0, pixels(PI * 0.36))
}

fn clear(filter: &str) -> String {
    format!("{filter}, {{ opacity = {{ value = 0 }} }}")
}

/// The outer surface's cap goes on through an inner one that stays.
fn inner_surface_not_cut(draw: Draw) -> Result<(), String> {
    let parts = vec![("balls", vec![ball(0.6, 192), second(ball(1.0, 192))])];
    let frame = draw(&planned(parts, SIDE, ABOVE, &above(0.0, &clear(CAP_SECOND))))?;
    has_area(maps(&frame)?, 0, pixels(PI))
}

/// Of surfaces that are open each by itself, the first is cut, wherever closed ones of the same node are.
fn closed_together(draw: Draw) -> Result<(), String> {
    let [top, rest] = halves(second(ball(1.0, 192)), 192 * 48);
    let beside = cuboid(Vec3::new(0.0, 40.0, 0.0), Vec3::splat(0.1));
    let parts = vec![("parts", vec![beside, top, rest])];
    let frame = draw(&planned(parts, SIDE, ABOVE, &above(0.3, CAP_SECOND)))?;
    has_area(maps(&frame)?, 0, pixels(PI * (1.0 - 0.09)))
}

/// The ends of the meridians that close it differ in the last digits.
fn seam(draw: Draw) -> Result<(), String> {
    let frame = draw(&planned(vec![("ball", vec![with_seam(ball(1.0, 192))])], SIDE, ABOVE, &above(0.3, CAP)))?;
    has_area(maps(&frame)?, 0, pixels(PI * (1.0 - 0.09)))
}

/// A sheet goes through the solid, another stands on it, all of one mesh: neither has a cap.
fn sheet_beside(draw: Draw) -> Result<(), String> {
    let through = sheet([[-1.4, 0.31, -1.0], [1.4, 0.31, -1.0], [1.4, 0.29, 1.0], [-1.4, 0.29, 1.0]]);
    let bent = with(
        sheet([[0.9, -1.2, -1.0], [1.3, -1.2, -1.0], [1.3, -1.2, 1.0], [0.9, -1.2, 1.0]]),
        sheet([[1.3, -1.2, -1.0], [1.3, -0.9, -1.0], [1.3, -0.9, 1.0], [1.3, -1.2, 1.0]]),
    );
    let solid = cuboid(Vec3::ZERO, Vec3::new(0.7, 0.8, 0.6));
    let parts = vec![("both", vec![with(solid, bent), through])];
    let frame = draw(&planned(parts, SIDE, &format!("{ABOVE}\nup = [0.31, 1, 0]"), &above(0.2, CAP)))?;
    has_area(maps(&frame)?, 0, pixels(1.4 * 1.6))
}

fn some_turned(draw: Draw) -> Result<(), String> {
    let mut ball = ball(1.0, 192);
    ball.triangles.iter_mut().step_by(11).for_each(|triangle| triangle.swap(0, 1));
    let frame = draw(&planned(vec![("ball", vec![ball])], SIDE, ABOVE, &above(0.3, CAP)))?;
    has_area(maps(&frame)?, 0, pixels(PI * (1.0 - 0.09)))
}

/// Rays leave through a hole as wide as a seventh of the ball, and through the bottom of a box that has none.
fn hole_far_off(draw: Draw) -> Result<(), String> {
    let mut torn = ball(1.0, 192);
    let positions = torn.positions.clone();
    torn.triangles.retain(|triangle| triangle.iter().any(|corner| positions[*corner as usize].z > -0.98));
    let frame = draw(&planned(vec![("ball", vec![torn])], SIDE, ABOVE, &above(0.3, CAP)))?;
    has_area(maps(&frame)?, 0, pixels(PI * (1.0 - 0.09)))?;
    let mut without_bottom = cuboid(Vec3::ZERO, Vec3::splat(0.8));
    let positions = without_bottom.positions.clone();
    without_bottom.triangles.retain(|triangle| triangle.iter().any(|corner| positions[*corner as usize].z > 0.0));
    let camera = format!("{ABOVE}\nup = [0.31, 1, 0]");
    let frame = draw(&planned(vec![("box", vec![without_bottom])], SIDE, &camera, &above(0.3, CAP)))?;
    has_area(maps(&frame)?, 0, pixels(1.6 * 1.6))
}

/// Whichever way each faces.
fn overlapping(draw: Draw) -> Result<(), String> {
    let bars = |second| with(cuboid(Vec3::ZERO, Vec3::new(1.2, 0.5, 0.6)), if second { turned(bar()) } else { bar() });
    for second in [false, true] {
        let camera = format!("{ABOVE}\nup = [0.31, 1, 0]");
        let frame = draw(&planned(vec![("cross", vec![bars(second)])], SIDE, &camera, &above(0.2, CAP)))?;
        has_area(maps(&frame)?, 0, pixels(2.4 + 2.16 - 0.9))?;
    }
    Ok(())
}

/// A mesh lens takes the same solids as caps do: two bars that overlap, one of them inside out, and a hollow box.
fn mesh_lens(draw: Draw) -> Result<(), String> {
    let bars = with(cuboid(Vec3::ZERO, Vec3::new(1.2, 0.5, 0.6)), turned(bar()));
    let at = |half: f32| cuboid(Vec3::new(0.95, 0.95, 0.0), Vec3::splat(half));
    let solids = with(bars, with(at(0.3), turned(at(0.2))));
    let parts = vec![("plate", vec![cuboid(Vec3::ZERO, Vec3::new(1.45, 1.45, 0.05))]), (LENS, vec![solids])];
    let shape = format!("mesh = {{ file = \"made-in-code.glb\", node = \"{LENS}\", convex = \"decompose\" }}");
    let camera = format!("{ABOVE}\nup = [0.31, 1, 0]");
    let frame = draw(&planned(parts, SIDE, &camera, &lens("solids", &shape, "\"invert\"")))?;
    let aovs = maps(&frame)?;
    let is_inside = |at: &usize| aovs.region(*at).is_some_and(|region| !region.set.is_empty());
    let (found, expected) = ((0..aovs.nodes.len()).filter(is_inside).count() as f64, pixels(3.66 + 0.36 - 0.16));
    if (found - expected).abs() <= SHARE * expected { Ok(()) } else { Err(format!("{found}, not {expected} pixels")) }
}

fn bar() -> Primitive {
    cuboid(Vec3::new(0.0, 0.0, 0.1), Vec3::new(0.45, 1.2, 0.55))
}

/// What makes the rest invisible from the cut on, below the eraser, leaves the cap alone; above it does not.
fn lower_lens(draw: Draw) -> Result<(), String> {
    let clear = lens("clear", "box = { min = [-3, -3, -3], max = [3, 3, 0.3] }", "{ opacity = { value = 0 } }");
    let [below, above] = [clear.clone() + &above(0.3, CAP), above(0.3, CAP) + &clear].map(|lenses| {
        let frame = draw(&planned(one_ball(), SIDE, ABOVE, &lenses))?;
        Ok::<_, String>((has_area(maps(&frame)?, 0, pixels(PI * (1.0 - 0.09))), cap_pixels(maps(&frame)?, 0)))
    });
    below?.0?;
    if above?.1 == 0 { Ok(()) } else { Err("a lens above the eraser must act on its cap".into()) }
}

/// The colour of a picture at a place seen from above.
fn color_at(frame: &Frame, x: f64, y: f64) -> [u8; 4] {
    let pixel = |along: f64| ((along / HEIGHT + 0.5) * f64::from(SIDE)) as usize;
    frame.pixels[pixel(-y) * SIDE as usize + pixel(x)]
}

/// A lens over all that shows base colours as they are.
fn unlit() -> String {
    lens("unlit", "box = { min = [-3, -3, -3], max = [3, 3, 3] }", "\"unlit\"")
}

/// A box that is red on its left and blue on its right, and beside it one of two materials.
fn own_colors(draw: Draw) -> Result<(), String> {
    let mut colored = cuboid(Vec3::new(-0.5, 0.0, 0.0), Vec3::new(0.8, 1.0, 0.9));
    let color = |p: &Vec3| if p.x < -0.5 { Vec4::new(1.0, 0.0, 0.0, 1.0) } else { Vec4::new(0.0, 0.0, 1.0, 1.0) };
    colored.colors = Some(colored.positions.iter().map(color).collect());
    let whole = cuboid(Vec3::new(0.9, 0.0, 0.0), Vec3::new(0.4, 1.0, 0.9));
    let positions = whole.positions.clone();
    let [mut left, mut right] = [whole.clone(), second(whole)];
    let is_left = |triangle: &[u32; 3]| triangle.iter().all(|corner| positions[*corner as usize].x < 0.6);
    left.triangles.retain(is_left);
    right.triangles.retain(|triangle| !is_left(triangle));
    let parts = vec![("colored", vec![colored]), ("two", vec![left, right])];
    let own = "{ erase = { cap = \"own\" } }";
    let mut opened = planned(parts, SIDE, ABOVE, &(above(0.2, own) + &unlit()));
    opened.scene.materials[1].base_color = [0.0, 1.0, 0.0, 1.0];
    let frame = draw(&opened)?;
    for (x, y, expected) in [
        (-1.2, 0.1, [255, 0, 0]),
        (0.2, -0.1, [0, 0, 255]),
        (-0.5, 0.9, [188, 0, 188]),
        (0.6, 0.1, [255, 255, 255]),
        (1.2, 0.1, [0, 255, 0]),
    ] {
        let found = color_at(&frame, x, y);
        if (0..3).any(|i| found[i].abs_diff(expected[i]) > 2) {
            return Err(format!("at ({x}, {y}) the cap is {found:?}, not {expected:?}"));
        }
    }
    Ok(())
}

/// Parts that touch, cut by one plane: a line between them, and none within one.
fn edges_between(draw: Draw) -> Result<(), String> {
    let part = |x: f32| cuboid(Vec3::new(x, 0.0, 0.0), Vec3::new(0.5, 1.0, 0.9));
    let edges = lens(
        "lines",
        "box = { min = [-3, -3, -3], max = [3, 3, 3] }",
        "\"unlit\", { edges = { color = \"black\", width = 3 } }",
    );
    let cut = above(0.2, "{ erase = { cap = \"white\" } }");
    for (parts, is_line) in [
        (vec![("left", vec![part(-0.5)]), ("right", vec![part(0.5)])], true),
        (vec![("both", vec![with(part(-0.5), part(0.5))])], false),
    ] {
        let frame = draw(&planned(parts, SIDE, ABOVE, &(cut.clone() + &edges)))?;
        let color = color_at(&frame, 0.0, 0.2);
        if (color[0] < 60) != is_line || color_at(&frame, 0.3, 0.2)[0] < 250 {
            return Err(format!("{color:?} at the border, where a line is {is_line}"));
        }
    }
    Ok(())
}

/// A ring within the cap; what lies beside the cap is not drawn on, and a lens that is soft fades nothing of it.
fn outline(draw: Draw) -> Result<(), String> {
    const WIDTH: f64 = 4.0;
    let eraser = |outline: &str| format!("{{ erase = {{ cap = \"white\"{outline} }} }}");
    let ring = eraser(&format!(", outline = {{ width = {WIDTH}, color = \"#ff0000\" }}"));
    let radius = pixels(1.0 - 0.09).sqrt();
    let expected = PI * (radius * radius - (radius - WIDTH).powi(2));
    let is_red = |color: &&[u8; 4]| color[0] > 150 && color[1] < 90;
    for (lenses, expected) in
        [(above(0.3, &ring), expected), (above(0.3, &ring) + "soft = 0.5\n", expected), (above(0.3, &eraser("")), 0.0)]
    {
        let frame = draw(&planned(one_ball(), SIDE, ABOVE, &lenses))?;
        let red = frame.pixels.iter().filter(is_red).count() as f64;
        if (red - expected).abs() > 0.1 * expected {
            return Err(format!("{red} pixels of the line, not {expected}"));
        }
        let aovs = maps(&frame)?;
        let beside = |(at, color): (usize, &[u8; 4])| cap_maker(aovs.triangles[at]).is_none() && is_red(&color);
        if frame.pixels.iter().enumerate().any(beside) {
            return Err("the line lies beside the cap".into());
        }
    }
    Ok(())
}

/// Where caps of two parts meet, each has half of the line; within a part there is none.
fn outline_between(draw: Draw) -> Result<(), String> {
    let part = |x: f32| cuboid(Vec3::new(x, 0.0, 0.0), Vec3::new(0.5, 1.0, 0.9));
    let cut = above(0.2, "{ erase = { cap = \"white\", outline = { width = 6, color = \"#ff0000\" } } }");
    for (parts, is_line) in [
        (vec![("left", vec![part(-0.5)]), ("right", vec![part(0.5)])], true),
        (vec![("both", vec![with(part(-0.5), part(0.5))])], false),
    ] {
        let frame = draw(&planned(parts, SIDE, ABOVE, &cut))?;
        let pixel = HEIGHT / f64::from(SIDE);
        for (x, is_on_line) in [(-1.5, is_line), (1.5, is_line), (-8.0, false), (8.0, false)] {
            let color = color_at(&frame, x * pixel, 0.2);
            if (color[1] < 90) != is_on_line {
                return Err(format!("{color:?} {x} pixels from the border, where a line is {is_on_line}"));
            }
        }
    }
    Ok(())
}
