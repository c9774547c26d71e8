//! The contact line of lens glass against closed forms: where the surface meets a wall, and nowhere else.

use std::f64::consts::TAU;
use std::path::Path;

use glam::{DVec2, DVec3};
use lenspeel::cpu;
use lenspeel::frame::Frame;
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;
use lenspeel::view::View;

const SIZE: [u32; 2] = [200, 150];
/// Of the line, in pixels.
const WIDTH: f64 = 3.0;
/// Pixels by which the line may be off.
const DOUBT: f64 = 0.25;
const LINE: [u8; 4] = [255, 0, 255, 255];
/// The front of the wall of `panes.glb`: x and y within 1.5 and 1.2.
const WALL: f64 = -1.5;
const CENTER: DVec3 = DVec3::new(0.1, -0.1, WALL + 0.4);
const RADIUS: f64 = 0.8;

/// From all of them every ray near the circle meets the sphere.
const CAMERAS: [&str; 4] = [
    "eye = [0, 0, 2.5]\ntarget = [0, 0, -1.5]",
    "eye = [0.9, 0.6, 2.1]\ntarget = [0, -0.1, -1.5]",
    "eye = [0, 0, 2.5]\ntarget = [0, 0, -1.5]\northographic_height = 2.6",
    "eye = [-0.6, 0.4, 1]\ntarget = [0, 0, -1.5]\northographic_height = 2.8",
];

/// Draws one lens over the wall; its surface is clear but for the line.
fn render(camera: &str, shape: &str, rest: &str, contact: f64) -> (Frame, View) {
    let text = format!(
        "[scene]\nfile = \"panes.glb\"\nhide = [\"red\", \"yellow\", \"green\", \"blue\", \"violet\"]\n\
         [camera]\n{camera}\n[image]\nsize = [{}, {}]\nsamples = 1\n\
         [[lens]]\nname = \"lens\"\nshape.{shape}\n{rest}\n\
         glass = {{ color = \"#ff00ff\", opacity = 0, rim = 0, outline = 0, contact = {contact} }}\n",
        SIZE[0], SIZE[1]
    );
    let models = Path::new(env!("CARGO_MANIFEST_DIR")).join("lens-specs/models");
    let spec = Spec::parse(&text, "contact.toml", &models).unwrap_or_else(|e| panic!("{e}\n{text}"));
    let scene = Scene::open(&spec).expect("the model is part of the project");
    let plan = Plan::new(&spec, &scene).unwrap_or_else(|e| panic!("{e}\n{text}"));
    (cpu::Renderer::new(&scene, &plan).and_then(|cpu| cpu.render(true, &|_| ())).expect("the CPU draws it"), plan.view)
}

fn sphere() -> String {
    format!("sphere = {{ center = [{}, {}, {}], radius = {RADIUS} }}", CENTER.x, CENTER.y, CENTER.z)
}

/// The circle in which a sphere of that radius meets the wall, in pixels.
fn circle(view: &View, radius: f64) -> Vec<DVec2> {
    let from_wall = CENTER.z - WALL;
    let across = (radius * radius - from_wall * from_wall).sqrt();
    let point = |i: u32| {
        let angle = TAU * f64::from(i) / 720.0;
        DVec3::new(CENTER.x + across * angle.cos(), CENTER.y + across * angle.sin(), WALL)
    };
    (0..720).map(|i| view.project(point(i)).expect("in front of the eye")).collect()
}

/// Whether a frame differs from one without line in pixels of a circle, all of them, and no others.
fn check(frame: &Frame, plain: &Frame, circle: &[DVec2]) -> Result<(), String> {
    let mut whole = 0;
    for (i, (drawn, plain)) in (0u32..).zip(frame.pixels.iter().zip(&plain.pixels)) {
        let at = DVec2::new(f64::from(i % SIZE[0]) + 0.5, f64::from(i / SIZE[0]) + 0.5);
        let away = circle.iter().map(|p| p.distance(at)).fold(f64::INFINITY, f64::min);
        if away > 0.5 * WIDTH + 0.5 + DOUBT && drawn != plain {
            return Err(format!("{at} is {away} pixels from the line and has it"));
        }
        if away < 0.5 * WIDTH - 0.5 - DOUBT {
            whole += 1;
            if *drawn != LINE {
                return Err(format!("{at} is {away} pixels from the line and is {drawn:?}"));
            }
        }
    }
    if whole > 200 { Ok(()) } else { Err(format!("the line is only {whole} pixels long")) }
}

#[test]
fn a_sphere_meets_a_wall_in_a_circle() {
    for camera in CAMERAS {
        let (frame, view) = render(camera, &sphere(), "", WIDTH);
        let (plain, _) = render(camera, &sphere(), "", 0.0);
        check(&frame, &plain, &circle(&view, RADIUS)).unwrap_or_else(|e| panic!("{camera}: {e}"));
    }
}

#[test]
fn another_circle_and_no_line_are_noticed() {
    for camera in CAMERAS {
        let (frame, view) = render(camera, &sphere(), "", WIDTH);
        let (plain, _) = render(camera, &sphere(), "", 0.0);
        assert!(check(&frame, &plain, &circle(&view, 1.03 * RADIUS)).is_err(), "{camera}: a larger circle passes");
        assert!(check(&plain, &plain, &circle(&view, RADIUS)).is_err(), "{camera}: no line passes");
    }
}

#[test]
fn the_line_changes_no_map() {
    let rest = "filters = [\"grayscale\"]";
    let (frame, _) = render(CAMERAS[1], &sphere(), rest, 20.0);
    let (plain, _) = render(CAMERAS[1], &sphere(), rest, 0.0);
    assert!(frame.pixels != plain.pixels, "a line of 20 pixels is not seen");
    assert!(frame.aovs == plain.aovs, "maps depend on the line");
}

/// A picture with a line and the same without.
fn pair(shape: &str, rest: &str) -> [Vec<[u8; 4]>; 2] {
    [WIDTH, 0.0].map(|contact| render(CAMERAS[1], shape, rest, contact).0.pixels)
}

#[test]
fn what_the_lens_leaves_alone_has_no_line() {
    let [drawn, plain] = pair(&sphere(), "except = { nodes = [\"wall\"] }");
    assert!(drawn == plain, "a line on what the lens is not there for");
    let [drawn, plain] = pair(&sphere(), "only = { nodes = [\"wall\"] }");
    assert!(drawn != plain, "no line on what the lens is there for");
}

#[test]
fn what_the_lens_takes_away_has_no_line() {
    let [drawn, plain] = pair(&sphere(), "filters = [\"erase\"]");
    let lined = |i: usize| drawn[i] != plain[i];
    let background = plain[0];
    assert!((0..drawn.len()).any(lined), "what is left has a line");
    assert!((0..drawn.len()).all(|i| !lined(i) || plain[i] != background), "a line on nothing");
}

#[test]
fn a_face_that_lies_in_the_wall_is_no_line() {
    let flush = |front: f64| format!("box = {{ min = [-0.6, -0.6, {WALL}], max = [0.6, 0.6, {front}] }}");
    let changed = |shape: &str| {
        let [drawn, plain] = pair(shape, "");
        drawn.iter().zip(&plain).filter(|(a, b)| a != b).count()
    };
    let edge = changed(&flush(-1.0));
    // Four sides of some 60 pixels, drawn where the ray meets them.
    assert!((50..1200).contains(&edge), "the line around a box has {edge} pixels");
}
