//! The enabled lenses, ranked.

use std::ops::Range;

use glam::DAffine3;

use super::op::Ops;
use super::{LensSet, MAX_LENSES, Op, PriorityGraph, Rank, filter_name};
use crate::InputError;
use crate::error::Faults;
use crate::lens::{MAX_PARTS, PixelRect, Placement, Volume, build_volume};
use crate::scene::Scene;
use crate::spec::{Attach, By, Filter, Glass, LensSpec, OverlapMode, Spec, lod};
use crate::view::{Projection, View};

/// A lens that takes part, at its place in the total order.
#[derive(Debug, Clone)]
pub struct Lens {
    pub name: String,
    /// Position in the file.
    pub index: usize,
    pub volume: Volume,
    /// World from the shape's space.
    pub world_from_shape: DAffine3,
    /// Pixels outside which its volume is not.
    pub rect: PixelRect,
    pub by: By,
    /// What it hides where it acts: named lenses, or all below for an override.
    pub hides: LensSet,
    pub overrides: bool,
    /// All its filters by name, first to act first.
    pub filters: Vec<Filter>,
    /// Its appearance filters in [`super::Plan::ops`].
    pub ops: Range<usize>,
    /// Whether its filters may make a fragment less than opaque.
    pub translucent: bool,
    /// Whether some filter moves content.
    pub moves: bool,
    /// The share of the triangles that its `lod` leaves.
    pub lod: Option<f32>,
    /// Width over which the appearance filters fade in from the boundary, scene units; 0: a sharp one.
    pub soft: f64,
    pub glass: Option<GlassRecord>,
}

impl Lens {
    pub fn filter_names(&self) -> impl Iterator<Item = &'static str> + '_ {
        self.filters.iter().map(filter_name)
    }
}

/// How a lens surface is drawn; the layout of WGSL's `Glass`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct GlassRecord {
    /// Linear light; alpha multiplies all.
    pub color: [f32; 4],
    pub opacity: f32,
    pub rim: f32,
    /// Pixels.
    pub outline: f32,
    /// Of the line on the scene where the surface meets it, pixels; 0: none.
    pub contact: f32,
}

impl From<Glass> for GlassRecord {
    fn from(glass: Glass) -> Self {
        let Glass { color, opacity, rim, outline, contact } = glass;
        Self { color: color.to_linear(), opacity, rim, outline, contact }
    }
}

/// A lens's volume and its shape's space.
pub(super) struct Placed {
    pub volume: Volume,
    pub world_from_shape: DAffine3,
}

/// The volume of every lens of the file, disabled ones checked like the others but left out.
pub(super) fn volumes(spec: &Spec, scene: &Scene, view: &View) -> Result<Vec<Option<Placed>>, InputError> {
    // The reader has counted them with a better place to point at; a spec may also be built in code.
    let enabled = || spec.lenses.iter().filter(|l| l.enabled);
    let parts: usize = enabled().map(|lens| lens.shape.parts().len()).sum();
    for (count, what, most) in [(enabled().count(), "lenses", MAX_LENSES), (parts, "parts of lenses", MAX_PARTS)] {
        if count > most {
            let message = format!("{count} {what} are enabled, and at most {most} can be");
            return Err(InputError::new(message).help("disable some lenses with `enabled = false`"));
        }
    }
    let mut faults = Faults::default();
    let volumes = spec.lenses.iter().map(|lens| {
        let volume = volume(spec, lens, scene, view, faults.are_few());
        let volume = faults.take(volume);
        volume.filter(|_| lens.enabled)
    });
    let volumes = volumes.collect();
    faults.finish()?;
    Ok(volumes)
}

/// `suggests`: names that may have been meant are looked for.
fn volume(spec: &Spec, lens: &LensSpec, scene: &Scene, view: &View, suggests: bool) -> Result<Placed, InputError> {
    let attach = attach_space(spec, lens, scene, view, suggests)?;
    let placement = Placement { attach, translation: lens.translation, rotation: lens.rotation, scale: lens.scale };
    let volume = build_volume(&lens.shape, &placement, view, &scene.lens_meshes).map_err(|reason| {
        let message = format!("the shape of lens `{}` has no volume: {}", lens.name.value, reason.value);
        InputError::at(&spec.source, reason.span, message)
    })?;
    if !volume.parts.iter().all(|part| part.world_from_local.is_finite() && part.local_from_world.is_finite()) {
        let message = format!("the numbers of lens `{}` are too large or too small to compute with", lens.name.value);
        return Err(InputError::at(&spec.source, lens.shape.span.clone(), message));
    }
    Ok(Placed { volume, world_from_shape: placement.world_from_shape() })
}

fn attach_space(
    spec: &Spec,
    lens: &LensSpec,
    scene: &Scene,
    view: &View,
    suggests: bool,
) -> Result<DAffine3, InputError> {
    let model = &scene.models[0];
    match &lens.attach.value {
        Attach::Scene => Ok(DAffine3::IDENTITY),
        Attach::Camera => Ok(view.world_from_camera()),
        Attach::Node(name) => {
            let node = model.node_named(name).map_err(|message| {
                let error = InputError::at(&spec.source, lens.attach.span.clone(), message);
                if suggests { error.help(model.node_help(name)) } else { error }
            })?;
            Ok(model.nodes[node].world_from_local)
        }
    }
}

/// What orders each lens of the file.
pub(super) fn ranks(spec: &Spec, volumes: &[Option<Placed>], view: &View) -> Vec<Rank> {
    spec.lenses
        .iter()
        .zip(volumes)
        .map(|(lens, volume)| Rank {
            enabled: lens.enabled,
            priority: lens.priority,
            flat: volume.as_ref().map(|p| &p.volume).filter(|v| v.is_flat()).map(|v| match view.projection {
                Projection::Perspective { .. } => v.center.distance(view.eye),
                Projection::Orthographic { .. } => view.depth(v.center),
            }),
        })
        .collect()
}

/// The lenses in total order with their filters as records.
pub(super) fn rank_lenses(
    spec: &Spec,
    graph: &PriorityGraph,
    order: &[usize],
    volumes: &[Option<Placed>],
    ops: &mut Ops,
) -> Result<Vec<Lens>, InputError> {
    let mut lenses: Vec<Lens> = Vec::new();
    for (rank, &index) in order.iter().enumerate() {
        let (lens, Some(placed)) = (&spec.lenses[index], &volumes[index]) else { continue };
        let own = ops.append(&lens.filters)?;
        let filters: Vec<Filter> = lens.filters.iter().map(|f| f.value.clone()).collect();
        let overrides = lens.overlap == OverlapMode::Override;
        lenses.push(Lens {
            name: lens.name.value.clone(),
            index,
            rect: placed.volume.pixel_rect(ops.view),
            volume: placed.volume.clone(),
            world_from_shape: placed.world_from_shape,
            by: lens.by,
            hides: if overrides { LensSet::below(rank) } else { hidden_by(graph, order, index) },
            overrides,
            translucent: ops.list[own.clone()].iter().any(Op::may_be_translucent),
            moves: filters.iter().any(Filter::moves),
            lod: lod(filters.iter()),
            soft: lens.soft,
            filters,
            ops: own,
            glass: lens.glass.map(GlassRecord::from),
        });
    }
    Ok(lenses)
}

/// Ranks of the lenses that a lens of the file names in `hides`.
fn hidden_by(graph: &PriorityGraph, order: &[usize], index: usize) -> LensSet {
    let hidden: Vec<usize> = graph
        .graph
        .edges_directed(petgraph::graph::NodeIndex::new(index), petgraph::Direction::Incoming)
        .filter(|e| e.weight().key == super::Key::Hides)
        .map(|e| petgraph::visit::EdgeRef::source(&e).index())
        .collect();
    (0..order.len()).filter(|rank| hidden.contains(&order[*rank])).collect()
}
