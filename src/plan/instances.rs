//! The ways in which an item is shown: in place, and moved by the lenses that move content (SEMANTICS 5.2).
//!
//! World k shows at p what world k-1 has at m(p), so from the top of the order down each mover that holds a point
//! carries it on to where the lower lenses are asked. For one item every mover is an affine map, so all that can be
//! seen of the item are its images under the compositions of some of them: one instance each. Where an instance is
//! really seen the walk decides.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::items::largest_scale;
use super::lenses::Placed;
use super::{Item, Lens, LensSet};
use crate::InputError;
use crate::lens::Volume;
use crate::scene::{Aabb, Scene, Selections, Subject};
use crate::spec::{At, By, Filter, Pattern};
use crate::view::View;

/// The most ways in which one item may be shown.
const MOST_WAYS: usize = 256;
/// Of bounds, as a share of their largest coordinate; positions are f32 in a file.
const ROUNDING: f64 = 1e-6;
/// How near another version must be seen for an item to fill gaps, in its spread; twin of `walk.wgsl`.
const FILLING_REACH: f64 = 4.0;
/// The most instances of a plan that are not in place.
const MOST_INSTANCES: usize = 1 << 20;

/// An item as a picture may show it.
#[derive(Debug, Clone)]
pub struct Instance {
    /// Into [`super::Plan::items`].
    pub item: usize,
    /// Where the item's world points are shown; the identity in place.
    pub shown_from_world: DAffine3,
    /// World space as shown, without what lies outside the lenses that move it there.
    pub bounds: Aabb,
    /// Through which lenses, the highest first; none in place.
    pub steps: Vec<Step>,
    /// How far the versions of the item may lie from each other on a ray where it is shown, scene units.
    pub spread: f64,
}

/// A mover on the way down from a shown point.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Step {
    /// Of the lens that moves.
    pub rank: usize,
    /// From the shown point to where the lenses below `rank` are asked.
    pub source_from_shown: DAffine3,
}

impl Instance {
    fn in_place(number: usize, item: &Item, bounds: Aabb) -> Self {
        Self { item: number, shown_from_world: DAffine3::IDENTITY, bounds, steps: Vec::new(), spread: item.spread }
    }

    /// How near another version of it must be seen on a ray for it to fill gaps: at the rims of parts more than its spread.
    pub fn filling_reach(&self) -> f64 {
        FILLING_REACH * self.spread
    }

    pub fn is_moved(&self) -> bool {
        !self.steps.is_empty()
    }

    /// Where what is shown at a point stands in the scene. World space.
    pub fn place_of(&self, shown: DVec3) -> DVec3 {
        if self.is_moved() { self.shown_from_world.inverse().transform_point3(shown) } else { shown }
    }

    /// From a shown point to where a filter of the lens of this rank acts. `inner`: the filter stands before those of
    /// its own lens that move.
    pub fn source_from_shown(&self, rank: usize, inner: bool) -> DAffine3 {
        let passed = self.steps.iter().rev().find(|step| step.rank > rank || (inner && step.rank == rank));
        passed.map_or(DAffine3::IDENTITY, |step| step.source_from_shown)
    }

    /// This, seen through one more mover above all others.
    fn through(&self, rank: usize, movement: &DAffine3, lens_bounds: &Aabb) -> Option<Self> {
        let shown = Aabb::from_points(self.bounds.corners().map(|p| movement.transform_point3(p)));
        let bounds = padded(shown).intersection(*lens_bounds);
        if bounds.is_empty() {
            return None;
        }
        let back = movement.inverse();
        let first = Step { rank, source_from_shown: back };
        let rest =
            self.steps.iter().map(|step| Step { rank: step.rank, source_from_shown: step.source_from_shown * back });
        Some(Self {
            item: self.item,
            shown_from_world: *movement * self.shown_from_world,
            bounds,
            steps: std::iter::once(first).chain(rest).collect(),
            spread: self.spread * largest_scale(movement),
        })
    }
}

/// Larger by more than rounding, so that a face on the bounds' side is not outside of them by another way of computing it.
fn padded(bounds: Aabb) -> Aabb {
    let pad = ROUNDING * bounds.min.abs().max(bounds.max.abs()).max_element();
    Aabb { min: bounds.min - pad, max: bounds.max + pad }
}

/// Every item in place, in their order, then all that movers may show of them.
pub(super) fn collect(
    items: &[Item],
    lenses: &[Lens],
    scene: &Scene,
    view: &View,
) -> Result<Vec<Instance>, InputError> {
    let mut instances: Vec<Instance> =
        items.iter().enumerate().map(|(index, item)| Instance::in_place(index, item, item.bounds)).collect();
    let movers: LensSet = (0..lenses.len()).filter(|rank| lenses[*rank].moves).collect();
    let reaches: Vec<Aabb> = lenses
        .iter()
        .map(|lens| match lens.by {
            By::Pixel if lens.moves => lens.volume.bounds(),
            _ => Aabb::EVERYWHERE,
        })
        .collect();
    let known = Selections::default();
    for (index, item) in items.iter().enumerate() {
        let subject = item.subject(scene, &known);
        let mut ways = vec![Instance::in_place(index, item, moved_bounds(item, scene))];
        for rank in item.moved_by(lenses).iter() {
            let movement = movement(&lenses[rank], item, &subject, view);
            let above = ways.iter().filter_map(|way| way.through(rank, &movement, &reaches[rank]));
            let above: Vec<Instance> = above.collect();
            ways.extend(above);
            if ways.len() > MOST_WAYS || instances.len() - items.len() + ways.len() > MOST_INSTANCES {
                return Err(too_many(lenses, movers, ways.len() > MOST_WAYS));
            }
        }
        instances.extend(ways.into_iter().skip(1));
    }
    Ok(instances)
}

/// The bounds of an item as movers take it.
fn moved_bounds(item: &Item, scene: &Scene) -> Aabb {
    if item.is_cut { scene.models[item.model].node_bounds(item.node) } else { item.bounds }
}

fn too_many(lenses: &[Lens], movers: LensSet, ways: bool) -> InputError {
    let names: Vec<&str> = movers.iter().map(|rank| lenses[rank].name.as_str()).collect();
    let message = if ways {
        format!("the lenses {} show one node in more than {MOST_WAYS} ways over each other", names.join(", "))
    } else {
        format!("the lenses {} show nodes in more than {MOST_INSTANCES} places", names.join(", "))
    };
    InputError::new(message).help("let fewer of the lenses that magnify or displace overlap, or limit them with `only`")
}

/// How a lens moves an item: from world k-1 to world k. What the lens shows is moved by the filters after `show`.
fn movement<'a>(lens: &'a Lens, item: &Item, subject: &Subject<'a>, view: &View) -> DAffine3 {
    let filters = moving_filters(&lens.filters);
    filters.iter().fold(DAffine3::IDENTITY, |before, filter| movement_of(filter, lens, item, subject, view) * before)
}

fn moving_filters(filters: &[Filter]) -> &[Filter] {
    let first = filters.iter().rposition(|f| matches!(f, Filter::Show(_))).map_or(0, |show| show + 1);
    &filters[first..]
}

/// Whether a lens moves an item where it acts on it.
pub(super) fn moves<'a>(filters: &'a [Filter], subject: &Subject<'a>) -> bool {
    moving_filters(filters).iter().any(|filter| match filter {
        Filter::Magnify { factor, .. } => *factor != 1.0,
        Filter::Displace { nodes, .. } => displaces(nodes, subject),
        _ => false,
    })
}

fn displaces<'a>(nodes: &'a [At<Pattern>], subject: &Subject<'a>) -> bool {
    nodes.is_empty() || subject.is_any(nodes, &[])
}

fn movement_of<'a>(filter: &'a Filter, lens: &Lens, item: &Item, subject: &Subject<'a>, view: &View) -> DAffine3 {
    match filter {
        Filter::Magnify { factor, center } => {
            let center = center.map(|center| lens.world_from_shape.transform_point3(center.into()));
            magnified(*factor, center, &lens.volume, view)
        }
        Filter::Displace { nodes, offset, explode } if displaces(nodes, subject) => {
            let away = item.center - lens.volume.center;
            DAffine3::from_translation(DVec3::from_array(*offset) + away * *explode)
        }
        _ => DAffine3::IDENTITY,
    }
}

/// Enlarges about a point: that given, or the volume's centre; of a flat volume without one what is seen, about its centre.
fn magnified(factor: f64, center: Option<DVec3>, volume: &Volume, view: &View) -> DAffine3 {
    if center.is_none() && volume.is_flat() {
        return magnified_in_sight(factor, volume.center, view);
    }
    let center = center.unwrap_or(volume.center);
    DAffine3::from_scale_rotation_translation(DVec3::splat(factor), DQuat::IDENTITY, center * (1.0 - factor))
}

/// A center so near to the eye's plane, for its distance, has no line of sight.
const BESIDE_THE_EYE: f64 = 1e-9;

/// Enlarges about the line from the eye through a center, for an orthographic camera along the view; depths stay.
fn magnified_in_sight(factor: f64, center: DVec3, view: &View) -> DAffine3 {
    let (fixed, mut along) = (if view.is_perspective() { view.eye } else { center }, view.forward);
    if view.is_perspective() {
        let away = center - view.eye;
        let depth = away.dot(view.forward);
        if depth.abs() > BESIDE_THE_EYE * away.length() {
            along = away / depth;
        }
    }
    // All that is away from the line at one depth grows: v becomes f v + (1 - f) (forward·v) along.
    let kept = |axis: DVec3| factor * axis + (1.0 - factor) * view.forward.dot(axis) * along;
    let matrix = DMat3::from_cols(kept(DVec3::X), kept(DVec3::Y), kept(DVec3::Z));
    DAffine3::from_mat3_translation(matrix, fixed - matrix * fixed)
}

/// World bounds of all that a filter may make of what lies in `seen`; `None` where it moves nothing.
pub(super) fn reach(filter: &Filter, placed: &Placed, seen: &Aabb, view: &View) -> Option<Aabb> {
    let centre = placed.volume.center;
    let box_of = |map: DAffine3| Aabb::from_points(seen.corners().map(|p| map.transform_point3(p)));
    match filter {
        Filter::Magnify { factor, center } => {
            let center = center.map(|center| placed.world_from_shape.transform_point3(center.into()));
            Some(box_of(magnified(*factor, center, &placed.volume, view)))
        }
        Filter::Displace { offset, explode, .. } => {
            // The centre of a node may be anywhere in the box.
            let offset = DVec3::from_array(*offset);
            let shift = Aabb::from_points(seen.corners().map(|p| offset + (p - centre) * *explode));
            Some(Aabb { min: seen.min + shift.min, max: seen.max + shift.max })
        }
        _ => None,
    }
}
