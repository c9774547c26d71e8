//! The method of 1996: clipping planes, a pass outside each face of a box and one inside.

use std::rc::Rc;

use lenspeel::plan::Plan;

use super::frame::{Baseline, Draw};
use super::host::{Host, Program, Surface};
use super::lenses::{Closed, closed};

/// `None` where the lenses are not one box, or where vertex shaders cannot clip.
pub fn clip_planes(host: &Rc<Host>, surface: &Surface, plan: &Plan) -> Option<Baseline> {
    let [lens] = &plan.lenses[..] else { return None };
    let Closed::Planes(planes) = closed(lens, plan)? else { return None };
    if planes.len() != 6 || !host.clips {
        return None;
    }
    let mut baseline = Baseline::new(host, plan);
    let record = baseline.uniform(surface.record(plan));
    let planes = baseline.uniform(bytemuck::cast_slice(&planes).to_vec());
    let draw = |vertex, fragment| {
        let program = Program {
            wgsl: include_str!("clip_planes.wgsl"),
            vertex,
            fragment: Some(fragment),
            cull: surface.cull(plan),
        };
        host.draw(&program, &surface.mesh, &record, &[(1, planes.as_entire_binding())])
    };
    let outside = |face| Draw { instances: face..face + 1, ..draw("outside_vertex", "outside") };
    let mut draws: Vec<Draw> = (0..6).map(outside).collect();
    draws.push(draw("inside_vertex", "inside"));
    baseline.picture(draws);
    Some(baseline)
}
