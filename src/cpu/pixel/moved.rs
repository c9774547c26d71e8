//! The lower lenses as a ray meets them behind a lens that moves content.

use crate::lens::RayLayers;
use crate::plan::{LensSet, Plan, Step};
use crate::view::Ray;

/// The layers of one ray below the steps that it has met, each found once.
#[derive(Default)]
pub struct MovedLayers {
    known: Vec<(Step, RayLayers)>,
    used: usize,
}

impl MovedLayers {
    /// All layers that a ray has: its own, then those below each of the steps.
    pub fn all<'s>(
        &'s mut self,
        plan: &Plan,
        ray: &Ray,
        own: &'s RayLayers,
        steps: &[Step],
    ) -> impl Fn(usize) -> &'s RayLayers {
        let places: Vec<usize> = steps.iter().map(|step| self.place(plan, ray, step)).collect();
        let known = &self.known;
        move |passed| passed.checked_sub(1).map_or(own, |step| &known[places[step]].1)
    }

    /// Forgets the ray, not the allocations.
    pub fn clear(&mut self) {
        self.used = 0;
    }

    /// The layers of the lenses below a step. A moved ray has the same parameter, so depths are those of the real ray.
    pub fn below(&mut self, plan: &Plan, ray: &Ray, step: &Step) -> &RayLayers {
        let place = self.place(plan, ray, step);
        &self.known[place].1
    }

    fn place(&mut self, plan: &Plan, ray: &Ray, step: &Step) -> usize {
        let found = self.known[..self.used].iter().position(|(known, _)| known == step);
        found.unwrap_or_else(|| {
            if self.used == self.known.len() {
                self.known.push((*step, RayLayers::default()));
            }
            let (known, layers) = &mut self.known[self.used];
            *known = *step;
            let lower = (plan.by_pixel & LensSet::below(step.rank)).iter();
            let volumes = lower.map(|rank| (rank, &plan.lenses[rank].volume));
            layers.find(volumes, &ray.moved(&step.source_from_shown), plan.view.near, plan.view.far);
            self.used += 1;
            self.used - 1
        })
    }
}
