//! What is not seen because a lens takes it away, for `explain`.

use super::{Fragment, Reach, ShearedRay, Tracer};
use crate::lens::RayLayers;
use crate::plan::{Item, LensSet, Verdict};

/// A fragment that lenses erase or replace.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Removed {
    pub fragment: Fragment,
    /// The lenses of its stack that erase it or show something else.
    pub by: LensSet,
}

impl Tracer<'_> {
    /// All that lenses take away on the ray through a point of the picture before a depth, nearest first.
    ///
    /// Looks at every triangle: this is for one ray, and rendering must not pay for it.
    pub fn removed(&self, x: f64, y: f64, ranks: &[usize], before: f32) -> Vec<Removed> {
        let (ray, _) = self.rays(x, y);
        let view = &self.plan.view;
        let mut layers = RayLayers::default();
        layers.find(ranks.iter().map(|rank| (*rank, &self.plan.lenses[*rank].volume)), &ray, view.near, view.far);
        let Reach { start, scale } = self.reach;
        let (origin, direction) = self.traced(&ray);
        let sheared = ShearedRay::new(origin, direction);
        let mut removed = Vec::new();
        for triangle in self.geometry.iter().flat_map(|geometry| &geometry.triangles) {
            let Some(hit) = sheared.hit(&triangle.corners) else { continue };
            let depth = (f64::from(hit.t) / scale + start) as f32;
            let in_view = depth >= view.near as f32 && depth < before.min(view.far as f32);
            if !in_view || self.is_culled(triangle, direction) {
                continue;
            }
            let item = &self.plan.items[triangle.item as usize];
            let verdict = self.plan.walk(item, layers.set_at(f64::from(depth)));
            let by = removers(item, &verdict);
            if !verdict.displayed && !by.is_empty() {
                let fragment = Fragment {
                    item: triangle.item,
                    triangle: triangle.index,
                    depth,
                    weights: hit.weights,
                    set: verdict.set,
                    stack: verdict.stack,
                };
                removed.push(Removed { fragment, by });
            }
        }
        removed.sort_unstable_by(|a, b| {
            self.key(&a.fragment).partial_cmp(&self.key(&b.fragment)).unwrap_or(std::cmp::Ordering::Equal)
        });
        removed
    }
}

/// The lenses of a stack that take an item away: of an alternate those above the lens that shows it. An alternate that
/// no lens shows is not taken away, it is not there.
fn removers(item: &Item, verdict: &Verdict) -> LensSet {
    let by = verdict.stack & item.removed_by;
    match (verdict.stack & item.shown_by).top() {
        Some(shown) => by.minus(LensSet::below(shown + 1)),
        None if item.is_alternate() => LensSet::EMPTY,
        None => by,
    }
}
