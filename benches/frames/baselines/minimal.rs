//! A minimal program: one pass over the mesh.

use std::rc::Rc;

use lenspeel::plan::Plan;

use super::frame::Baseline;
use super::host::{Host, Program, Surface};

/// The surface without lenses.
pub fn minimal(host: &Rc<Host>, surface: &Surface, plan: &Plan) -> Baseline {
    let mut baseline = Baseline::new(host, plan);
    let record = baseline.uniform(surface.record(plan));
    let program = Program {
        wgsl: include_str!("minimal.wgsl"),
        vertex: "vertex",
        fragment: Some("plain"),
        cull: surface.cull(plan),
    };
    baseline.picture(vec![host.draw(&program, &surface.mesh, &record, &[])]);
    baseline
}
