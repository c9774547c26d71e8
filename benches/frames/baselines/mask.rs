//! One mask test for all spheres in the fragment shader of a renderer's only pass: what is patched into one today.

use std::rc::Rc;

use lenspeel::plan::Plan;

use super::frame::Baseline;
use super::host::{Host, Program, Surface};
use super::lenses::spheres;

/// The list of `mask.wgsl`.
const MOST: usize = 256;

/// `None` where a lens is no sphere, or where there are too many.
pub fn mask(host: &Rc<Host>, surface: &Surface, plan: &Plan) -> Option<Baseline> {
    let spheres = spheres(plan).filter(|list| list.len() <= MOST)?;
    let mut bytes = vec![0; 16 * (1 + MOST)];
    bytes[..4].copy_from_slice(&(spheres.len() as u32).to_le_bytes());
    bytes[16..16 * (1 + spheres.len())].copy_from_slice(bytemuck::cast_slice(&spheres));
    let mut baseline = Baseline::new(host, plan);
    let record = baseline.uniform(surface.record(plan));
    let list = baseline.uniform(bytes);
    let program = Program {
        wgsl: include_str!("mask.wgsl"),
        vertex: "vertex",
        fragment: Some("masked"),
        cull: surface.cull(plan),
    };
    baseline.picture(vec![host.draw(&program, &surface.mesh, &record, &[(1, list.as_entire_binding())])]);
    Some(baseline)
}
