//! What one view ray meets: the report that every backend gives of a pixel's centre.

use glam::Vec3;

use crate::appearance::OPAQUE_FROM;
use crate::lens::LayerStart;
use crate::plan::{LensSet, Region};

/// A surface sample on a ray, classified.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Fragment {
    /// Into [`Plan::instances`](crate::plan::Plan::instances).
    pub instance: u32,
    /// Into the item's triangles.
    pub triangle: u32,
    pub depth: f32,
    /// Barycentric weights of the triangle's corners.
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
        let Survivor { fragment, opacity, coverage } = survivor;
        if opacity * coverage <= 0.0 {
            return true;
        }
        self.fragments.push(survivor);
        let ends = coverage >= 0.5 && opacity >= OPAQUE_FROM.0;
        if ends || (coverage >= 0.5 && self.visible.is_none()) {
            self.visible = Some(Visible { fragment, normal });
        }
        !ends
    }
}
