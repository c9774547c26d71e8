//! What hosts of a user's own filters owe them, on both backends.

use lenspeel::gpu::{Engine, Headless, RenderOptions};
use lenspeel::plan::Plan;
use lenspeel::scene::Scene;

use crate::agree::agree;
use crate::cases::{check, on_cpu};
use crate::scene::{PERSPECTIVE, planned};

fn filtered(filters: &str, rest: &str) -> (Scene, Plan) {
    let shape = "shape.sphere = { center = [0, 0.1, 0.3], radius = 0.7 }";
    let lens = format!("[[lens]]\nname = \"l\"\n{shape}\nfilters = [{filters}]\nglass = false\n{rest}");
    planned([120, 90], 1, PERSPECTIVE, &lens)
}

/// A filter that goes beyond a range gives what one gives that goes to its end, for the filters above it, too.
pub fn what_a_filter_makes_is_brought_into_range(device: &Headless) -> Result<(), String> {
    let beyond = |beyond: bool| {
        let file = format!("{{ wgsl = {{ file = \"tests/data/beyond.wgsl\", params = {{ beyond = {beyond} }} }} }}");
        filtered(&format!("{file}, {{ opacity = {{ value = 0.5 }} }}"), "")
    };
    let (scene, plan) = beyond(true);
    check(device, &scene, &plan)?;
    let (clamped_scene, to_the_end) = beyond(false);
    agree(&on_cpu(&clamped_scene, &to_the_end), &on_cpu(&scene, &plan))?;
    let (plain_scene, none) = filtered("{ opacity = { value = 0.5 } }", "");
    match agree(&on_cpu(&plain_scene, &none), &on_cpu(&scene, &plan)) {
        Ok(()) => Err("the filter changes nothing".to_owned()),
        Err(_) => Ok(()),
    }
}

/// Near the boundary of a soft lens normals are bent less.
pub fn a_soft_lens_fades_bent_normals(device: &Headless) -> Result<(), String> {
    let bumps = "{ wgsl = { file = \"lens-specs/wgsl/bumps.wgsl\", params = { height = 1 } } }";
    let (scene, soft) = filtered(bumps, "soft = 0.4\n");
    check(device, &scene, &soft)?;
    let (hard_scene, hard) = filtered(bumps, "");
    match agree(&on_cpu(&hard_scene, &hard), &on_cpu(&scene, &soft)) {
        Ok(()) => Err("the soft lens looks like one that is not".to_owned()),
        Err(_) => Ok(()),
    }
}

/// What then comes out is open, but a picture does.
pub fn a_filter_may_give_no_numbers(device: &Headless) -> Result<(), String> {
    let (scene, plan) = filtered(
        "{ wgsl = { file = \"tests/data/no-numbers.wgsl\" } }, { tint = { color = \"red\" } }",
        "soft = 0.1\n",
    );
    on_cpu(&scene, &plan);
    for engine in [Engine::Fused, Engine::Peel] {
        device.render(&scene, &plan, RenderOptions { engine, aovs: true }).map_err(|e| e.to_string())?;
    }
    Ok(())
}
