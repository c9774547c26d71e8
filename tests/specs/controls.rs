//! The tester tested: pictures that are wrong in one small way must fail the comparison.

use lenspeel::cpu;
use lenspeel::frame::{Aovs, Frame, NOTHING};
use lenspeel::plan::Region;
use lenspeel::spec::{Shape, Spec};
use libtest_mimic::{Failed, Trial};

use crate::compare::{Reference, compare};
use crate::open::{Opened, open};
use crate::{entry, golden, reference};

/// Two lenses that overlap before a box; a texel is 0.05 wide.
const SPEC: &str = r##"
[scene]
file = "models/ball-in-box.glb"
[camera]
eye = [0, 0, 5]
target = [0, 0, 0]
orthographic_height = 3.6
[image]
size = [96, 72]
samples = 1
[[lens]]
name = "left"
shape.sphere = { center = [-0.3, 0, 1], radius = 0.7 }
filters = [{ unlit = { color = "#ff8800" } }]
glass = false
[[lens]]
name = "right"
shape.sphere = { center = [0.4, 0.1, 1], radius = 0.7 }
filters = [{ unlit = { color = "#0088ff" } }]
glass = false
"##;
const TEXEL: f64 = 0.05;

/// A control: its name, what is done to the picture, and the property that must be seen to differ.
type Control = (&'static str, fn(&Reference) -> Frame, &'static str);

const MUST_FAIL: [Control; 10] = [
    ("a-swapped-pair-of-lenses", |_| render(|spec| spec.lenses.swap(0, 1)), "colour"),
    ("a-lens-shifted-by-one-texel", |_| render(|spec| shift(spec, TEXEL)), "region"),
    ("a-lens-that-is-missing", |_| render(|spec| spec.lenses[1].enabled = false), "region"),
    ("a-picture-off-by-one-row", |right| with(right, shift_rows), "colour"),
    ("one-interior-pixel-of-another-region", |right| with_maps(right, put_plain), "region"),
    ("one-interior-pixel-with-nothing", |right| with_maps(right, |maps| maps.regions[BOTH] = NOTHING), "region"),
    ("one-interior-pixel-of-another-node", |right| with_maps(right, |maps| maps.nodes[BOTH] += 1), "node"),
    ("one-interior-pixel-with-another-layer", |right| with_maps(right, |maps| maps.layers[BOTH] += 1), "layers"),
    ("one-interior-pixel-at-another-depth", |right| with_maps(right, |maps| maps.depth[BOTH] *= 1.001), "depth"),
    ("one-interior-pixel-three-steps-off", |right| with(right, |frame| frame.pixels[BOTH][2] ^= 3), "colour"),
];

/// A pixel inside both lenses, away from the line where their surfaces cross.
const BOTH: usize = 33 * 96 + 53;

pub fn trials() -> Vec<Trial> {
    let mut trials: Vec<Trial> = MUST_FAIL
        .into_iter()
        .map(|control| Trial::test(format!("comparison::{}-fails", control.0), move || must_fail(control)))
        .collect();
    trials.push(Trial::test("comparison::a-picture-agrees-with-itself", agrees_with_itself));
    trials.push(Trial::test("comparison::two-steps-of-colour-agree", two_steps_agree));
    trials.push(Trial::test("comparison::most-pixels-are-interior", most_are_interior));
    trials.push(Trial::test("comparison::another-size-fails", another_size_fails));
    trials.push(Trial::test("comparison::a-wrong-golden-fails", wrong_golden_fails));
    trials.push(Trial::test("comparison::contact-lines-that-are-missing-fail", missing_contact_lines_fail));
    trials
}

fn must_fail((name, wrong, property): Control) -> Result<(), Failed> {
    let right = right();
    let outcome = compare(&right, &wrong(&right))?;
    match outcome.verdict() {
        Ok(()) => Err(format!("{name} passes:\n{outcome}").into()),
        Err(report) if report.contains(&format!("{property} DIFFERS")) => Ok(()),
        Err(report) => Err(format!("{name} fails, but not by its {property}:\n{report}").into()),
    }
}

fn agrees_with_itself() -> Result<(), Failed> {
    let right = right();
    Ok(compare(&right, &right.frame)?.verdict()?)
}

fn two_steps_agree() -> Result<(), Failed> {
    let right = right();
    let near = with(&right, |frame| frame.pixels.iter_mut().for_each(|pixel| pixel[1] = pixel[1].saturating_sub(2)));
    Ok(compare(&right, &near)?.verdict()?)
}

fn most_are_interior() -> Result<(), Failed> {
    let near_edge = right().color.near_edge;
    let interior = near_edge.iter().filter(|near| !**near).count();
    if 10 * interior > 7 * near_edge.len() && !near_edge[BOTH] {
        return Ok(());
    }
    Err(format!("{interior} of {} pixels are interior", near_edge.len()).into())
}

fn another_size_fails() -> Result<(), Failed> {
    let right = right();
    let smaller = render(|spec| spec.image.size = [96, 71]);
    compare(&right, &smaller).err().map(|_| ()).ok_or_else(|| "pictures of two sizes are compared".into())
}

fn wrong_golden_fails() -> Result<(), Failed> {
    let right = right().frame;
    golden::compare(&right, &right)?;
    let mut one_step = right.clone();
    one_step.pixels[BOTH][0] ^= 1;
    golden::compare(&right, &one_step)?;
    let mut two_steps = right.clone();
    two_steps.pixels[BOTH][0] ^= 2;
    let mut everywhere = right.clone();
    everywhere.pixels.iter_mut().for_each(|pixel| pixel[0] ^= 1);
    let mut shifted = right.clone();
    shift_rows(&mut shifted);
    for (name, wrong) in [("two steps", two_steps), ("one step everywhere", everywhere), ("a row", shifted)] {
        if golden::compare(&right, &wrong).is_ok() {
            return Err(format!("a golden that differs by {name} passes").into());
        }
    }
    Ok(())
}

/// Contact lines lie on the edges of lenses, where colours may differ: they must be seen to be missing all the same.
fn missing_contact_lines_fail() -> Result<(), Failed> {
    for name in ["contact-two-lenses", "contact-wide"] {
        let path = entry::folder().join(format!("transparency/{name}.toml"));
        let text = std::fs::read_to_string(&path)?;
        let right = reference::of(&open(&path, &text, |_| ())?.1);
        let without = |spec: &mut Spec| {
            spec.lenses.iter_mut().filter_map(|lens| lens.glass.as_mut()).for_each(|glass| glass.contact = 0.0);
        };
        let Opened { scene, plan } = open(&path, &text, without)?.1;
        let frame =
            cpu::Renderer::new(&scene, &plan).and_then(|cpu| cpu.render(true, &|_| ())).expect("the CPU draws it");
        if compare(&right, &frame)?.verdict().is_ok() {
            return Err(format!("{name} without its lines passes").into());
        }
    }
    Ok(())
}

fn opened(change: impl FnOnce(&mut Spec)) -> Opened {
    open(&entry::folder().join("control.toml"), SPEC, change).expect("the control spec is right").1
}

fn right() -> Reference {
    reference::of(&opened(|_| ()))
}

fn render(change: impl FnOnce(&mut Spec)) -> Frame {
    let opened = opened(change);
    cpu::Renderer::new(&opened.scene, &opened.plan).and_then(|cpu| cpu.render(true, &|_| ())).expect("the CPU draws it")
}

fn shift(spec: &mut Spec, by: f64) {
    match &mut spec.lenses[1].shape.value {
        Shape::Sphere { center, .. } => center[0] += by,
        other => panic!("the control's lens is a sphere, not {other:?}"),
    }
}

fn with(right: &Reference, change: impl FnOnce(&mut Frame)) -> Frame {
    let mut frame = right.frame.clone();
    change(&mut frame);
    frame
}

fn with_maps(right: &Reference, change: impl FnOnce(&mut Aovs)) -> Frame {
    with(right, |frame| change(frame.aovs.as_mut().expect("the reference has AOVs")))
}

fn put_plain(maps: &mut Aovs) {
    maps.regions[BOTH] = maps.table.len() as u32;
    maps.table.push(Region::PLAIN);
}

/// Moves the picture and its maps down by one row; the first row stays where it is.
fn shift_rows(frame: &mut Frame) {
    let width = frame.size[0] as usize;
    down(&mut frame.pixels, width);
    if let Some(maps) = &mut frame.aovs {
        down(&mut maps.regions, width);
        down(&mut maps.nodes, width);
        down(&mut maps.depth, width);
        down(&mut maps.layers, width);
    }
}

fn down<T: Clone>(values: &mut [T], width: usize) {
    let all = values.to_vec();
    values[width..].clone_from_slice(&all[..all.len() - width]);
}
