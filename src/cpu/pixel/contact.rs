//! The lines where lens surfaces meet a fragment: twin of `contact.wgsl`.

use glam::Vec3;

use super::Tracer;
use crate::appearance as wgsl;
use crate::cpu::convert::{d3, g3, glass, v3};
use crate::cpu::glass::Contact;
use crate::lens::{Crossing, Solid};
use crate::pixel::{Fragment, cap_maker};
use crate::view::Ray;

impl Tracer<'_> {
    /// A fragment's colour under the lines of the lenses that are there for it, the higher lens's on top. Each lens's
    /// surface counts where the ray crosses it last in front of the fragment, and first behind it. `contacts`: by rank,
    /// the nearer first.
    pub(super) fn with_contact_lines(
        &self,
        color: Vec3,
        fragment: &Fragment,
        contacts: &[Contact],
        ray: &Ray,
        pixel: &wgsl::PixelRay,
    ) -> Vec3 {
        if contacts.is_empty() {
            return color;
        }
        let item = self.item(fragment.instance);
        let there = item.scope | item.shown_by;
        // All of a cap lies in a lens's surface, and finds no line there but that of other surfaces.
        let normal = match cap_maker(fragment.triangle) {
            Some(_) => fragment.weights,
            None => self.shader.geometric_normal(fragment),
        };
        let lenses = contacts.chunk_by(|a, b| a.rank == b.rank).filter(|contacts| there.contains(contacts[0].rank));
        lenses.fold(color, |color, contacts| {
            let lens = &self.plan.lenses[contacts[0].rank];
            let Some(record) = &lens.glass else { return color };
            let in_front = contacts.partition_point(|contact| contact.crossing.t <= f64::from(fragment.depth));
            let nearest = contacts.iter().take(in_front + 1).skip(in_front.saturating_sub(1));
            let seen = nearest.map(|contact| (&lens.volume.parts[contact.part], contact.crossing));
            let seen = seen.filter(|(part, crossing)| part.form.is_seen(crossing.face));
            let distances = seen.map(|(part, crossing)| distance(part, crossing, fragment.depth, normal, ray, pixel));
            let nearest = distances.fold(f32::INFINITY, f32::min);
            g3(wgsl::with_contact_line(v3(color), glass(record), nearest))
        })
    }
}

/// Pixels from a fragment at a depth to the line where it meets the surface of a part.
fn distance(part: &Solid, crossing: Crossing, depth: f32, normal: Vec3, ray: &Ray, pixel: &wgsl::PixelRay) -> f32 {
    let beside = Crossing { t: f64::from(depth), ..crossing };
    let gap = (crossing.t - beside.t) as f32;
    let [lens_normal, beside] = [crossing, beside].map(|crossing| d3(part.normal(ray, &crossing)));
    wgsl::contact_distance(*pixel, depth, v3(normal), gap, lens_normal, beside)
}
