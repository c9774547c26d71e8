//! Caps against closed forms: areas of cuts in pixels, on the CPU and on both GPU engines.

mod cases;
mod controls;
mod solids;

#[cfg(feature = "gpu")]
#[path = "../support/gpu.rs"]
mod gpu;
#[path = "../support/open.rs"]
#[allow(dead_code, reason = "these scenes are made in code")]
mod open;
#[path = "../support/timed.rs"]
mod timed;

use lenspeel::cpu;
use lenspeel::frame::{Aovs, Frame};
use lenspeel::pixel::cap_maker;
use libtest_mimic::{Arguments, Trial};

use open::Opened;

/// Draws a picture with its AOVs.
type Draw = fn(&Opened) -> Result<Frame, String>;

fn main() {
    let arguments = Arguments::from_args();
    let mut trials = controls::trials();
    for (name, check) in cases::ALL {
        trials.push(trial(name, "cpu", check, on_cpu));
        #[cfg(feature = "gpu")]
        trials.push(trial(name, "fused", check, |opened| gpu::render(opened, gpu::ENGINES[0].0)));
        #[cfg(feature = "gpu")]
        if cases::PEELED.contains(&name) {
            trials.push(trial(name, "peel", check, |opened| gpu::render(opened, gpu::ENGINES[1].0)));
        }
    }
    #[cfg(feature = "gpu")]
    if gpu::is_ignored() {
        let needs_gpu = |name: &str| !name.ends_with("::cpu");
        trials = trials.into_iter().map(|t| if needs_gpu(t.name()) { t.with_ignored_flag(true) } else { t }).collect();
    }
    timed::run(&arguments, trials).exit();
}

fn trial(name: &str, backend: &str, check: cases::Check, draw: Draw) -> Trial {
    timed::trial(format!("{name}::{backend}"), move || check(draw))
}

fn on_cpu(opened: &Opened) -> Result<Frame, String> {
    Ok(cpu::Renderer::new(&opened.scene, &opened.plan)
        .and_then(|cpu| cpu.render(true, &|_| ()))
        .expect("the CPU draws it"))
}

fn maps(frame: &Frame) -> Result<&Aovs, String> {
    frame.aovs.as_ref().ok_or_else(|| "the picture has no AOVs".into())
}

/// How many pixels show a cap of a node.
fn cap_pixels(aovs: &Aovs, node: usize) -> usize {
    let is_cap = |at: &usize| cap_maker(aovs.triangles[*at]).is_some() && aovs.nodes[*at] == node as u32 + 1;
    (0..aovs.nodes.len()).filter(is_cap).count()
}

/// The largest share by which areas may differ.
const SHARE: f64 = 0.005;

/// Compares the cap of a node with its area in pixels.
fn has_area(aovs: &Aovs, node: usize, expected: f64) -> Result<(), String> {
    let found = cap_pixels(aovs, node) as f64;
    if (found - expected).abs() <= SHARE * expected {
        return Ok(());
    }
    Err(format!("the cap of node {node} has {found} pixels, and {expected:.0} are expected"))
}
