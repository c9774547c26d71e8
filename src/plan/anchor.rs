//! Where the depths of a picture are counted from: see [`crate::view`].
//!
//! The anchor lies where the picture has its details. Extremes say nothing about that: one stray vertex, a sky, or the
//! corners of a ground without end lie anywhere. So triangles are asked where the picture shows them nearest to its middle,
//! and the median of the answers is taken, where a triangle counts the less the larger it is.

use glam::{DAffine3, DVec2, DVec3};
use rayon::prelude::*;

use crate::scene::{Aabb, Primitive, Scene};
use crate::view::{Projection, View};

/// About so many triangles are asked.
const ASKED: usize = 1 << 14;
/// At least so many of each primitive.
const LEAST: usize = 16;
/// Half a perspective camera's view may be so wide, as a tangent, for depths to be counted from anywhere but its eye: what
/// is near a wide one needs them from there.
const NARROW: f64 = 0.12;
/// What part of what is seen may lie before the anchor of a perspective camera.
const BEFORE: f64 = 0.1;

/// A point of a triangle that may be seen.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Sight {
    /// From the eye.
    depth: f64,
    /// From the view's axis, as a share of the picture's half diagonal.
    across: f64,
    weight: f64,
}

/// Depth from the eye at which depths are to be counted from, and about how far from there things are that are seen.
pub(super) fn find(view: &View, scene: &Scene) -> (f64, f64) {
    let mut sights = sights(view, scene);
    // What lies outside the picture counts where nothing lies within.
    if sights.iter().any(|sight| sight.across <= 1.0) {
        sights.retain(|sight| sight.across <= 1.0);
    }
    sights.sort_unstable_by(|a, b| a.depth.total_cmp(&b.depth));
    let middle = quantile(&sights, 0.5);
    match view.projection {
        Projection::Orthographic { half_height } => (middle.unwrap_or(0.0), half_height),
        Projection::Perspective { .. } => {
            let narrow = view.half_diagonal() <= NARROW;
            let depth = if narrow { quantile(&sights, BEFORE).unwrap_or(0.0) } else { 0.0 };
            let unit = middle.unwrap_or(1.0).max(f64::MIN_POSITIVE);
            (depth, if depth > 0.0 { unit * view.half_diagonal() } else { unit })
        }
    }
}

/// The depth before which a share of sorted sights lies, by weight.
fn quantile(sights: &[Sight], share: f64) -> Option<f64> {
    let all: f64 = sights.iter().map(|sight| sight.weight).sum();
    let mut before = 0.0;
    let found = sights.iter().find(|sight| {
        before += sight.weight;
        before >= share * all
    });
    found.map(|sight| sight.depth)
}

fn sights(view: &View, scene: &Scene) -> Vec<Sight> {
    let mut primitives: Vec<(&Primitive, DAffine3)> = Vec::new();
    for model in &scene.models {
        let drawn = model.nodes.iter().filter(|node| node.is_shown());
        primitives.extend(drawn.flat_map(|node| {
            let own = node.mesh.map_or(&[][..], |mesh| &model.meshes[mesh].primitives);
            own.iter().map(move |primitive| (primitive, node.world_from_local))
        }));
    }
    let triangles: usize = primitives.iter().map(|(primitive, _)| primitive.triangles.len()).sum();
    let every = triangles.div_ceil(ASKED).max(1);
    let of = |(primitive, world): &(&Primitive, DAffine3)| -> Vec<Sight> {
        let step = every.min(primitive.triangles.len() / LEAST).max(1);
        let asked = primitive.triangles.iter().step_by(step);
        let corners = asked.map(|t| t.map(|i| world.transform_point3(primitive.positions[i as usize].as_dvec3())));
        corners.filter_map(|corners| sight(view, corners, step as f64)).collect()
    };
    primitives.par_iter().flat_map_iter(of).collect()
}

/// Where a triangle is seen nearest to the middle of the picture; `None` where it lies behind the eye.
fn sight(view: &View, corners: [DVec3; 3], stands_for: f64) -> Option<Sight> {
    let size = Aabb::from_points(corners).size().length();
    let around = corners.map(|p| {
        let p = p - view.eye;
        DVec3::new(p.dot(view.right), p.dot(view.up), p.dot(view.forward))
    });
    let seen = if view.is_perspective() { before_eye(&around) } else { around.to_vec() };
    let flat: Vec<(DVec2, f64)> = seen
        .iter()
        .map(|p| if view.is_perspective() { (p.truncate() / p.z, 1.0 / p.z) } else { (p.truncate(), p.z) })
        .collect();
    let fan = (2..flat.len()).map(|i| nearest_to_middle([flat[0], flat[i - 1], flat[i]]));
    let (away, counted) = fan.min_by(|a, b| a.0.total_cmp(&b.0))?;
    let depth = if view.is_perspective() { 1.0 / counted } else { counted };
    let weight = stands_for / size;
    (depth.is_finite() && weight.is_finite()).then_some(Sight { depth, across: away / view.half_diagonal(), weight })
}

/// What of a triangle lies before the eye of a perspective camera, in its axes: a convex polygon, or nothing.
fn before_eye(corners: &[DVec3; 3]) -> Vec<DVec3> {
    let least = 1e-9 * corners.iter().map(|p| p.z).fold(0.0, f64::max);
    let mut kept = Vec::new();
    for i in 0..3 {
        let (p, q) = (corners[i], corners[(i + 1) % 3]);
        if p.z > least {
            kept.push(p);
        }
        if (p.z > least) != (q.z > least) {
            kept.push(p.lerp(q, (least - p.z) / (q.z - p.z)));
        }
    }
    kept.retain(|p| p.z > 0.0);
    kept
}

/// How far the point of a flat triangle nearest to the origin is from there, and a value that is linear over it.
fn nearest_to_middle(corners: [(DVec2, f64); 3]) -> (f64, f64) {
    let sides = [0, 1, 2].map(|i| corners[i].0.perp_dot(corners[(i + 1) % 3].0));
    let area: f64 = sides.iter().sum();
    if area != 0.0 && sides.iter().all(|side| side * area >= 0.0) {
        return (0.0, (0..3).map(|i| corners[i].1 * sides[(i + 1) % 3]).sum::<f64>() / area);
    }
    let on_side = |i: usize| {
        let ((a, at_a), (b, at_b)) = (corners[i], corners[(i + 1) % 3]);
        let along = b - a;
        let share = (-a.dot(along) / along.length_squared().max(f64::MIN_POSITIVE)).clamp(0.0, 1.0);
        ((a + along * share).length(), at_a + (at_b - at_a) * share)
    };
    [0, 1, 2]
        .map(on_side)
        .into_iter()
        .fold((f64::INFINITY, 0.0), |best, found| if found.0 < best.0 { found } else { best })
}
