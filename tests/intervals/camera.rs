//! Random cameras, and where they stand to a solid.

use glam::DVec3;
use lenspeel::view::{Anchor, Projection, View};

use crate::facets::frame;
use crate::random::Random;
use crate::solid::{Solid, direction};

/// How a lens lies to the eye and the two planes.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Stand {
    /// Wholly between the planes.
    Between,
    /// Around the eye.
    Inside,
    AcrossNear,
    AcrossFar,
    AcrossBoth,
    BeforeNear,
    BeyondFar,
    /// Behind the eye; for an orthographic camera at negative depths, between the planes.
    Behind,
}

impl Stand {
    pub const ALL: [Stand; 8] = [
        Stand::Between,
        Stand::Inside,
        Stand::AcrossNear,
        Stand::AcrossFar,
        Stand::AcrossBoth,
        Stand::BeforeNear,
        Stand::BeyondFar,
        Stand::Behind,
    ];

    /// Whether no ray can have an interval.
    pub fn is_nowhere(self, view: &View) -> bool {
        match self {
            Stand::BeforeNear | Stand::BeyondFar => true,
            Stand::Behind => view.is_perspective(),
            _ => false,
        }
    }
}

/// A camera somewhere within a few units of the origin, looking anywhere; near and far are set later.
pub fn camera(random: &mut Random, size: [u32; 2]) -> View {
    let forward = direction(random);
    let axes = frame(forward);
    let roll = random.between(0.0, 6.0);
    let right = axes.x_axis * roll.cos() + axes.y_axis * roll.sin();
    let projection = if random.chance(0.5) {
        Projection::Perspective { tan_half_y: random.between(0.2, 1.2) }
    } else {
        Projection::Orthographic { half_height: random.between(0.5, 2.5) }
    };
    let eye = direction(random) * random.between(0.0, 4.0);
    let (up, anchor) = (right.cross(forward), Anchor::default());
    View { eye, right, up, forward, projection, anchor, near: 0.0, far: 1.0, size }
}

/// Where the eye must be for the solid to stand as wanted, as seen along the camera's forward axis.
pub fn eye(stand: Stand, random: &mut Random, view: &View, solid: &Solid) -> DVec3 {
    let back = match stand {
        Stand::Inside => return solid.inner(random),
        Stand::Behind => -random.between(1.0, 3.0),
        _ => random.between(1.1, 3.0),
    };
    let aside = view.right * random.between(-0.3, 0.3) + view.up * random.between(-0.3, 0.3);
    solid.middle + (aside - view.forward * back) * solid.size
}

/// Puts near and far where the stand wants them; `None` if the eye is in the way.
pub fn set_planes(stand: Stand, random: &mut Random, view: &mut View, solid: &Solid) -> Option<()> {
    let [low, high] = solid.depths(view);
    let least = if view.is_perspective() { 1e-4 * solid.size } else { f64::NEG_INFINITY };
    let low = low.max(least);
    let at = |share: f64| low + (high - low) * share;
    let margin = 0.5 * (high - low);
    let before = (low - margin * random.between(0.1, 1.0)).max(least);
    let share = random.between(0.2, 0.5);
    // What a flat lens holds reaches from its corners forwards.
    let visible = (if solid.is_flat { high - 3.0 * solid.size } else { high }) > least.max(0.0);
    (view.near, view.far) = match stand {
        Stand::Between if visible => (before, high + margin),
        // A flat lens without depth has no farther end.
        Stand::Inside if solid.is_flat => (least.max(0.0), solid.size),
        Stand::Inside => (if view.is_perspective() { least } else { 0.0 }, high.abs() + margin.abs() + solid.size),
        Stand::AcrossNear if visible => (at(share), high + margin),
        Stand::AcrossFar if visible => (before, at(share)),
        Stand::AcrossBoth if visible => (at(share), at(share + 0.3)),
        Stand::BeforeNear if visible && !solid.is_flat => (high + 0.01 * margin, high + margin),
        Stand::BeyondFar if visible && before > least => (before - 0.5 * (before - least).min(1.0), before),
        Stand::Behind if view.is_perspective() && !visible => (least, 10.0 * solid.size),
        Stand::Behind if !view.is_perspective() && !visible => (low - margin, high + margin),
        _ => return None,
    };
    Some(())
}
