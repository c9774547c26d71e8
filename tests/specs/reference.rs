//! The CPU backend's picture of a spec, and where it has edges.

use glam::Vec3;
use lenspeel::cpu;
use lenspeel::frame::{Aovs, Frame};
use lenspeel::plan::{LensSet, Region};

use crate::compare::{Reference, Rules};
use crate::edges::{JUMP, Mask, STEP, around, changes, depth_jumps, either, regions};
use crate::open::Opened;

/// Normals of one surface that turn by more than this from pixel to pixel meet in a crease; radians.
const CREASE: f32 = 0.35;

/// Renders a spec and finds its edges.
pub fn of(opened: &Opened) -> Reference {
    let renderer = cpu::Renderer::new(&opened.scene, &opened.plan).expect("a plan of this scene");
    let frame = renderer.render(true, &|_| ()).expect("the CPU draws it");
    let aovs = frame.aovs.as_ref().expect("AOVs were asked for");
    let maps = map_edges(&frame, aovs);
    let colors = either(&maps, &either(&creases(&frame, aovs), &hidden_edges(&renderer, frame.size)));
    let rules = |near_edge: &Mask| Rules { near_edge: near_edge.clone(), exempt: vec![false; near_edge.len()] };
    Reference {
        region: rules(&maps),
        stack: rules(&maps),
        node: rules(&maps),
        layers: rules(&maps),
        depth: rules(&either(&maps, &depth_jumps(frame.size, &aovs.depth, STEP))),
        color: rules(&colors),
        frame,
    }
}

/// Edges of the maps: regions, nodes, jumps in depth, and lens boundaries, which the layers show.
fn map_edges(frame: &Frame, aovs: &Aovs) -> Mask {
    let visible = either(&changes(frame.size, &regions(aovs)), &changes(frame.size, &aovs.nodes));
    let lenses = changes(frame.size, &aovs.layers);
    either(&either(&visible, &lenses), &depth_jumps(frame.size, &aovs.depth, JUMP))
}

/// Edges within one node, where two of its faces meet.
fn creases(frame: &Frame, aovs: &Aovs) -> Mask {
    let turns = |a: Vec3, b: Vec3| a != Vec3::ZERO && b != Vec3::ZERO && a.angle_between(b) > CREASE;
    around(frame.size, |at, other| turns(aovs.normals[at].into(), aovs.normals[other].into()))
}

/// What a pixel's colour is made of: the surfaces from the front to the opaque one, each with its lenses, and
/// the lens boundaries before it.
#[derive(PartialEq)]
struct Makeup {
    fragments: Vec<(u32, Region)>,
    boundaries: Vec<LensSet>,
}

/// Edges that the maps do not show: those of translucent surfaces, and of lens surfaces that other things cut.
fn hidden_edges(renderer: &cpu::Renderer, size: [u32; 2]) -> Mask {
    let makeup = |at: u32| {
        let report = renderer.report(at % size[0], at / size[0]);
        let end = report.visible.map_or(f64::INFINITY, |visible| f64::from(visible.fragment.depth));
        Makeup {
            fragments: report.fragments.iter().map(|f| (f.fragment.instance, f.fragment.region)).collect(),
            boundaries: report.layers.iter().filter(|start| start.depth < end).map(|s| s.set).collect(),
        }
    };
    let makeups: Vec<Makeup> = (0..size[0] * size[1]).map(makeup).collect();
    changes(size, &makeups)
}
