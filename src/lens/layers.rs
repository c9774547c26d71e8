//! The layers of one view ray: the lenses' intervals cut it into stretches with a constant set of lenses.

use super::{Interval, LensSet, Volume};
use crate::view::{Merging, Ray};

/// A layer begins: from `depth` to the next start the lenses in `set` are around the ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LayerStart {
    pub depth: f64,
    pub set: LensSet,
}

/// All layers of a ray, nearest first; the first starts at the near plane.
#[derive(Debug, Clone, Default)]
pub struct RayLayers {
    pub starts: Vec<LayerStart>,
    merging: Merging,
    boundaries: Vec<(f64, usize)>,
    intervals: Vec<Interval>,
}

impl RayLayers {
    /// Finds the layers of a ray among volumes, each with its lens's rank. Keeps its allocations from ray to ray.
    pub fn find<'a>(&mut self, volumes: impl Iterator<Item = (usize, &'a Volume)>, ray: &Ray, near: f64, far: f64) {
        self.starts.clear();
        self.merging = ray.merging;
        self.boundaries.clear();
        let mut set = LensSet::EMPTY;
        for (rank, volume) in volumes {
            self.intervals.clear();
            volume.intervals(ray, near, far, &mut self.intervals);
            for interval in &self.intervals {
                if interval.entry > near {
                    self.boundaries.push((interval.entry, rank));
                } else {
                    set.insert(rank);
                }
                if interval.exit < far {
                    self.boundaries.push((interval.exit, rank));
                }
            }
        }
        self.starts.push(LayerStart { depth: near, set });
        self.boundaries.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let mut rest = self.boundaries.as_slice();
        while let Some(&(depth, _)) = rest.first() {
            let merged = rest.iter().take_while(|b| !self.merging.starts_boundary(depth, b.0)).count();
            for (_, rank) in &rest[..merged] {
                // A lens that enters and leaves at one boundary has no interval.
                if set.contains(*rank) {
                    set.remove(*rank);
                } else {
                    set.insert(*rank);
                }
            }
            self.starts.push(LayerStart { depth, set });
            rest = &rest[merged..];
        }
    }

    /// The lenses around a depth: membership is half-open, `entry <= depth < exit`. A boundary that is as close as two
    /// that merge is reached: whether a surface in a lens face is inside must not depend on rounding.
    pub fn set_at(&self, depth: f64) -> LensSet {
        let reached = |start: &&LayerStart| !self.merging.starts_boundary(depth, start.depth);
        self.starts.iter().rev().find(reached).map_or(LensSet::EMPTY, |start| start.set)
    }

    /// The lenses around the ray just before a boundary, one at this depth or as close to it as two that merge.
    pub fn set_before(&self, boundary: f64) -> LensSet {
        let before = |start: &&LayerStart| self.merging.starts_boundary(start.depth, boundary);
        self.starts.iter().rev().find(before).or(self.starts.first()).map_or(LensSet::EMPTY, |start| start.set)
    }
}
