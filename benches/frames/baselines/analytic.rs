//! Single-pass lenses in the fragment shader, region tests in closed form: the line of work of 2008 to 2011.

use std::rc::Rc;

use lenspeel::plan::Plan;

use super::frame::Baseline;
use super::host::{Host, Program, Surface};
use super::lenses::{Closed, closed};

/// `Lens` of `analytic.wgsl`.
#[repr(C)]
#[derive(Clone, Copy, bytemuck::Pod, bytemuck::Zeroable)]
struct LensRecord {
    sphere: [f32; 4],
    first_plane: u32,
    plane_count: u32,
    first_op: u32,
    op_count: u32,
}

/// `None` where a lens is neither a sphere nor bounded by planes.
pub fn analytic(host: &Rc<Host>, surface: &Surface, plan: &Plan) -> Option<Baseline> {
    let mut planes: Vec<[f32; 4]> = Vec::new();
    let mut lenses = Vec::new();
    for lens in &plan.lenses {
        let first_plane = planes.len() as u32;
        let sphere = match closed(lens, plan)? {
            Closed::Sphere { center, radius } => center.extend(radius * radius).as_vec4().to_array(),
            Closed::Planes(list) => {
                planes.extend(list);
                [0.0, 0.0, 0.0, -1.0]
            }
        };
        lenses.push(LensRecord {
            sphere,
            first_plane,
            plane_count: planes.len() as u32 - first_plane,
            first_op: lens.ops.start as u32,
            op_count: lens.ops.len() as u32,
        });
    }
    // No binding is empty.
    planes.resize(planes.len().max(1), [0.0; 4]);
    let mut baseline = Baseline::new(host, plan);
    let record = baseline.uniform(surface.record(plan));
    let storage = wgpu::BufferUsages::STORAGE;
    let (lenses, planes, ops) =
        (host.buffer(&lenses, storage), host.buffer(&planes, storage), host.buffer(&plan.ops, storage));
    let program = Program {
        wgsl: include_str!("analytic.wgsl"),
        vertex: "vertex",
        fragment: Some("composed"),
        cull: surface.cull(plan),
    };
    let bindings = [(1, lenses.as_entire_binding()), (2, planes.as_entire_binding()), (3, ops.as_entire_binding())];
    baseline.picture(vec![host.draw(&program, &surface.mesh, &record, &bindings)]);
    Some(baseline)
}
