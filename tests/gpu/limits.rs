//! Many lenses, and what a device cannot hold: refused with numbers before anything is drawn.

use std::mem::size_of;

use glam::{DAffine3, DVec3};
use lenspeel::gpu::layout::{PartRecord, StepRecord};
use lenspeel::gpu::{Error, Headless, RenderOptions};
use lenspeel::lens::Form;
use lenspeel::plan::{MAX_LENSES, Plan};
use lenspeel::scene::Scene;

use crate::cases::check;
use crate::compounds::{of, replace, torus_of};
use crate::scene::{PERSPECTIVE, planned};

/// The most lenses that a spec may have, side by side and over each other.
pub fn as_many_lenses_as_there_can_be(device: &Headless) -> Result<(), String> {
    let lens = |i: usize| {
        let (x, z) = ((i % 16) as f64 * 0.12 - 0.9, (i / 16) as f64 * 0.12 - 0.9);
        let filter = format!("{{ tint = {{ color = \"#{i:02x}80{:02x}\", amount = 0.5 }} }}", 255 - i);
        ball(&format!("l{i}"), [x, 0.0, z], 0.1, &filter)
    };
    let (scene, plan) = planned([64, 48], 1, PERSPECTIVE, &(0..MAX_LENSES).map(lens).collect::<String>());
    assert_eq!(plan.lenses.len(), MAX_LENSES);
    check(device, &scene, &plan)
}

fn ball(name: &str, center: [f64; 3], radius: f64, filter: &str) -> String {
    let shape = format!("sphere = {{ center = {center:?}, radius = {radius} }}");
    format!("[[lens]]\nname = \"{name}\"\nshape.{shape}\nfilters = [{filter}]\nglass = false\n")
}

/// Lenses out of sight need no layers, but their parts and meshes are uploaded; so are the steps of movers.
pub fn what_a_plan_needs_is_refused_with_numbers(device: &Headless) -> Result<(), String> {
    let behind: String = (0..200).map(|i| ball(&format!("l{i}"), [9.0, 9.0, 9.0], 0.1, "\"invert\"")).collect();
    let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, &behind);
    refused(device, &scene, &plan, "the plan's parts of lenses", 200 * size_of::<PartRecord>())?;

    let (scene, mut plan) = planned(SIZE, 1, PERSPECTIVE, &ball("ring", [9.0, 9.0, 9.0], 0.1, "\"invert\""));
    let mut ring = torus_of(100, 40, DAffine3::IDENTITY);
    ring.hull.iter_mut().for_each(|p| *p += DVec3::splat(9.0));
    let Form::Mesh(mesh) = &ring.form else { return Err("the ring is no mesh".into()) };
    // Eight words a node, three a triangle or corner.
    let words = 8 * mesh.tree.nodes.len() + 3 * mesh.tree.triangles.len() + 3 * mesh.tree.vertices.len();
    replace(&mut plan, 0, of(ring.clone()));
    refused(device, &scene, &plan, "the plan's programs and meshes of lenses", 4 * words)?;

    let movers: String =
        (0..7).map(|i| ball(&format!("l{i}"), [0.0; 3], 9.0, "{ displace = { offset = [0.01, 0, 0] } }")).collect();
    let (scene, plan) = planned(SIZE, 1, PERSPECTIVE, &movers);
    let steps: usize = plan.instances.iter().map(|instance| instance.steps.len()).sum();
    refused(device, &scene, &plan, "the plan's steps of movers", steps * size_of::<StepRecord>())
}

const SIZE: [u32; 2] = [8, 6];

/// One byte less than is needed is refused with these numbers; with as much as is needed the plan is drawn.
fn refused(device: &Headless, scene: &Scene, plan: &Plan, wanted: &str, bytes: usize) -> Result<(), String> {
    let render = |allowed: u64| {
        let mut renderer = device.renderer(scene).map_err(|e| e.to_string())?;
        renderer.limit_buffers(allowed);
        Ok::<_, String>(device.render_with(&mut renderer, scene, plan, RenderOptions::default(), &mut None))
    };
    let bytes = bytes as u64;
    match render(bytes - 1)? {
        Err(Error::TooLarge { what, needed, allowed }) if what == wanted && needed == bytes && allowed + 1 == bytes => {
        }
        Err(error) => return Err(format!("another error than of {bytes} bytes for {wanted}: {error}")),
        Ok(_) => return Err(format!("{wanted}: {bytes} bytes were put into {}", bytes - 1)),
    }
    render(bytes)?.map(drop).map_err(|error| format!("{wanted}: {error}"))
}
