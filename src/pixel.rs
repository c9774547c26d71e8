//! What one view ray meets: the report that every backend gives of a pixel's centre.

use glam::Vec3;

use crate::appearance::OPAQUE_FROM;
use crate::frame::NOTHING;
use crate::lens::LayerStart;
use crate::plan::{LensSet, Region};

/// The first of the numbers that caps have in place of a triangle's.
pub const FIRST_CAP: u32 = NOTHING - 512;

/// The number that a cap has in place of a triangle's: it tells the lens or rule that makes it, by its rank.
pub fn cap_number(maker: usize) -> u32 {
    FIRST_CAP + maker as u32
}

/// The rank of the lens or rule whose cap has this number; `None` for a triangle.
pub fn cap_maker(triangle: u32) -> Option<usize> {
    (FIRST_CAP..NOTHING).contains(&triangle).then(|| (triangle - FIRST_CAP) as usize)
}

/// A surface sample on a ray, classified.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment {
    /// Into [`Plan::instances`](crate::plan::Plan::instances).
    pub instance: u32,
    /// Into the item's triangles; of a cap see [`cap_number`].
    pub triangle: u32,
    pub depth: f32,
    /// Barycentric weights of the triangle's corners; of a cap its normal, unit length, in the world.
    pub weights: Vec3,
    /// The lenses around it (S) and those of them, or the rule, that act.
    pub region: Region,
}

/// The visible fragment of a pixel (SEMANTICS 6.4).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Visible {
    pub fragment: Fragment,
    /// World space.
    pub normal: Vec3,
}

/// A fragment that the lenses leave to be seen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Survivor {
    pub fragment: Fragment,
    pub opacity: f32,
    pub coverage: f32,
}

impl Survivor {
    fn shows(&self) -> bool {
        self.opacity * self.coverage > 0.0
    }

    /// Takes it, after all nearer ones of its ray, for the visible fragment where it is; false where it ends the ray.
    pub(crate) fn see(&self, normal: Vec3, visible: &mut Option<Visible>) -> bool {
        if !self.shows() || self.coverage < 0.5 {
            return true;
        }
        let ends = self.opacity >= OPAQUE_FROM.0;
        if ends || visible.is_none() {
            *visible = Some(Visible { fragment: self.fragment, normal });
        }
        !ends
    }
}

/// A fragment that lenses erase, replace or move elsewhere.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Removed {
    pub fragment: Fragment,
    /// The lenses of its stack, or the rule, that do so.
    pub by: LensSet,
}

/// What one pixel's ray met.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PixelReport {
    /// From the near plane on; the last ends at the far plane.
    pub layers: Vec<LayerStart>,
    /// Every fragment between near and far that survives, nearest first, up to the first opaque one.
    pub fragments: Vec<Survivor>,
    pub visible: Option<Visible>,
    /// What lenses take away in front of the visible fragment, nearest first.
    pub removed: Vec<Removed>,
}

impl PixelReport {
    /// Takes the next fragment, nearest first, that the lenses leave with this opacity and coverage; false where it
    /// ends the ray.
    pub(crate) fn push(&mut self, survivor: Survivor, normal: Vec3) -> bool {
        if !survivor.shows() {
            return true;
        }
        self.fragments.push(survivor);
        survivor.see(normal, &mut self.visible)
    }
}
