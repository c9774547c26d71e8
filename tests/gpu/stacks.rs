//! Stacks of any filters with any parameters: the device against the CPU.

use lenspeel::gpu::Headless;

use crate::cases::check;
use crate::intervals::Random;
use crate::scene::{ORTHOGRAPHIC, PERSPECTIVE, planned};

const STACKS: u64 = 6;

/// Lenses that overlap, each with a few filters drawn from all that change how things look.
pub fn random_stacks(device: &Headless) -> Result<(), String> {
    for seed in 0..STACKS {
        let random = &mut Random(7000 + seed);
        let camera = if seed % 2 == 0 { PERSPECTIVE } else { ORTHOGRAPHIC };
        let lenses: String = (0..3).map(|number| lens(number, random)).collect();
        let (scene, plan) = planned([120, 90], 1, camera, &lenses);
        check(device, &scene, &plan).map_err(|e| format!("seed {seed}: {e}\n{lenses}"))?;
    }
    Ok(())
}

fn lens(number: usize, random: &mut Random) -> String {
    let center = format!("[{:.3}, 0.1, {:.3}]", random.range(-0.5, 0.5), random.range(-0.4, 0.6));
    let shape = format!("shape.sphere = {{ center = {center}, radius = {:.3} }}", random.range(0.3, 0.6));
    let filters: Vec<String> = (0..2 + number % 2).map(|_| filter(random)).collect();
    let soft = if number == 1 { "soft = 0.1\n" } else { "" };
    format!("[[lens]]\nname = \"l{number}\"\n{shape}\nfilters = [{}]\nglass = false\n{soft}", filters.join(", "))
}

fn filter(random: &mut Random) -> String {
    let mut unit = || format!("{:.3}", random.range(0.0, 1.0));
    let (a, b) = (unit(), unit());
    let mut pixels = |low: f64, high: f64| format!("{:.2}", random.range(low, high));
    let (width, size, spacing) = (pixels(0.5, 4.0), pixels(3.2, 7.0), pixels(0.04, 0.2));
    let color = format!("\"#{:06x}\"", random.range(0.0, 16_777_215.0) as u32);
    let map = ["viridis", "magma", "turbo", "coolwarm", "spectral"][random.range(0.0, 5.0) as usize];
    let all = [
        format!("{{ wireframe = {{ width = {width}, color = {color}, fill = {a} }} }}"),
        format!("{{ wireframe = {{ width = {width}, hidden = false }} }}"),
        format!("{{ points = {{ size = {size} }} }}"),
        format!("{{ opacity = {{ value = {a} }} }}"),
        format!("{{ ghost = {{ strength = {a} }} }}"),
        format!("{{ ghost = {{ strength = {a}, color = {color} }} }}"),
        format!("{{ tint = {{ color = {color}, amount = {a} }} }}"),
        format!("{{ grayscale = {{ amount = {a} }} }}"),
        format!("{{ invert = {{ amount = {a} }} }}"),
        format!("{{ brightness = {{ amount = {size} }} }}"),
        format!("{{ unlit = {{ color = {color} }} }}"),
        format!("{{ material = {{ color = {color}, metallic = {a}, roughness = {b} }} }}"),
        format!("{{ texture = {{ file = \"lens-specs/textures/checker.png\", uv = \"box\", scale = {size} }} }}"),
        format!("{{ normals = {{ colormap = \"{map}\" }} }}"),
        format!("{{ depth = {{ colormap = \"{map}\", range = [3, {size}] }} }}"),
        format!("{{ height = {{ colormap = \"{map}\" }} }}"),
        format!("{{ curvature = {{ colormap = \"{map}\" }} }}"),
        format!("{{ contours = {{ spacing = {spacing}, width = {width}, color = {color} }} }}"),
        format!("{{ contours = {{ quantity = \"depth\", spacing = 0.2, width = {width} }} }}"),
        format!("{{ toon = {{ levels = {} }} }}", 2 + random.range(0.0, 5.0) as u32),
        format!("{{ hatch = {{ spacing = {size}, width = {width}, color = {color} }} }}"),
        format!("{{ edges = {{ width = {width}, color = {color} }} }}"),
        format!("{{ blur = {{ radius = {size} }} }}"),
        format!("{{ pixelate = {{ radius = {width} }} }}"),
        format!(
            "{{ wgsl = {{ file = \"lens-specs/wgsl/stripes.wgsl\", params = {{ color = {color}, spacing = 0.1 }} }} }}"
        ),
        "{ wgsl = { file = \"lens-specs/wgsl/thermal.wgsl\" } }".into(),
    ];
    let number = random.range(0.0, all.len() as f64) as usize;
    all.into_iter().nth(number).expect("one of them")
}
