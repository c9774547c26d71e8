//! The method of 2004 for one convex lens: its faces as two depth maps, and three passes over the scene. The lens is a
//! mesh of 20,480 faces, which is a sphere to a fortieth of a pixel.

use std::rc::Rc;

use glam::DVec3;
use lenspeel::plan::Plan;

use super::frame::{Baseline, Mesh};
use super::host::{DEPTH_FORMAT, Host, Program, Surface};
use super::lenses::{Closed, closed};
use crate::balls::Ball;

/// `None` where the lenses are not one sphere.
pub fn three_pass(host: &Rc<Host>, surface: &Surface, plan: &Plan) -> Option<Baseline> {
    let [lens] = &plan.lenses[..] else { return None };
    let Closed::Sphere { center, radius } = closed(lens, plan)? else { return None };
    let sphere = sphere(host, center + plan.view.eye, radius);
    let mut baseline = Baseline::new(host, plan);
    let record = baseline.uniform(surface.record(plan));
    let wgsl = include_str!("three_pass.wgsl");
    let mut faces = |cull| {
        let map = host.texture(plan.view.size, DEPTH_FORMAT, wgpu::TextureUsages::TEXTURE_BINDING);
        let view = map.create_view(&Default::default());
        let program = Program { wgsl, vertex: "face", fragment: None, cull: Some(cull) };
        baseline.depths(&view, vec![host.draw(&program, &sphere, &record, &[])]);
        view
    };
    let (front, back) = (faces(wgpu::Face::Back), faces(wgpu::Face::Front));
    let front = (1, wgpu::BindingResource::TextureView(&front));
    let back = (2, wgpu::BindingResource::TextureView(&back));
    let draw = |fragment, maps: &[_]| {
        let program = Program { wgsl, vertex: "vertex", fragment: Some(fragment), cull: surface.cull(plan) };
        host.draw(&program, &surface.mesh, &record, maps)
    };
    baseline.picture(vec![
        draw("behind", std::slice::from_ref(&back)),
        draw("inside", &[front.clone(), back.clone()]),
        draw("before", &[front]),
    ]);
    Some(baseline)
}

/// A sphere in the world.
fn sphere(host: &Host, center: DVec3, radius: f64) -> Mesh {
    let (points, triangles) = Ball::Smooth.mesh();
    let positions: Vec<glam::Vec3> = points.iter().map(|p| (center + *p * radius).as_vec3()).collect();
    Mesh {
        vertices: vec![host.buffer(&positions, wgpu::BufferUsages::VERTEX)],
        indices: host.buffer(&triangles, wgpu::BufferUsages::INDEX),
        index_count: 3 * triangles.len() as u32,
    }
}
