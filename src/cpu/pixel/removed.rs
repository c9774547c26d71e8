//! What is not seen because a lens takes it away, for `explain`.

use super::{MovedLayers, Tracer};
use crate::lens::RayLayers;
use crate::pixel::{Fragment, Removed};
use crate::plan::Region;

impl Tracer<'_> {
    /// All that lenses take away on the ray through a point of the picture before a depth, nearest first.
    ///
    /// Looks at every triangle: this is for one ray, and rendering must not pay for it.
    pub fn removed(&self, x: f64, y: f64, ranks: &[usize], before: f32) -> Vec<Removed> {
        let view = &self.plan.view;
        let ray = view.ray(x, y);
        let mut layers = RayLayers::default();
        layers.find(ranks.iter().map(|rank| (*rank, &self.plan.lenses[*rank].volume)), &ray, view.near, view.far);
        let sheared = self.traced(&ray);
        let mut moved = MovedLayers::default();
        let mut removed = Vec::new();
        let all = self.geometry.iter().flat_map(|geometry| geometry.triangles.iter().map(move |own| (geometry, own)));
        for (geometry, triangle) in all {
            let Some(hit) = geometry.hit(&sheared, triangle) else { continue };
            let depth = self.depth_of(triangle, &hit, &ray);
            let in_view = depth >= view.near as f32 && depth < before.min(view.far as f32);
            if !in_view || self.is_culled(triangle, &ray) {
                continue;
            }
            let verdict = self.verdict(&ray, triangle.instance, depth, &layers, &mut moved);
            // What is moved is told of where it stands and where it is seen, not where it might have been.
            let told = verdict.here || !self.instance(triangle.instance).is_moved();
            let by = verdict.taken_by(self.item(triangle.instance));
            // What fills in and is not what is seen has been outdone by another version.
            let is_gone = !verdict.displayed || verdict.fills;
            if told && is_gone && !by.is_empty() {
                let fragment = Fragment {
                    instance: triangle.instance,
                    triangle: triangle.index,
                    depth,
                    weights: hit.weights,
                    region: Region { set: verdict.set, stack: verdict.stack },
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
