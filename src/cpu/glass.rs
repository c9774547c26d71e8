//! Lens surfaces along a ray.

use super::convert::{a4, d3, g4, glass as record};
use crate::appearance as wgsl;
use crate::lens::{Boundary, Crossing, Solid, Span};
use crate::plan::Plan;
use crate::view::Ray;

/// A point of a lens surface: depth, lens rank, and its colour with opacity in alpha (linear, straight).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlassHit {
    pub depth: f64,
    pub rank: usize,
    pub color: glam::Vec4,
}

/// A crossing of a lens that draws a line where the scene meets its surface; that may be a face that is not drawn.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Contact {
    pub rank: usize,
    pub part: usize,
    pub crossing: Crossing,
}

/// The lens surfaces that a ray meets; keeps its allocations from ray to ray.
#[derive(Debug, Default)]
pub struct GlassHits {
    /// Nearest first.
    pub hits: Vec<GlassHit>,
    /// By rank, the nearer first.
    pub contacts: Vec<Contact>,
    boundaries: Vec<Boundary>,
}

impl GlassHits {
    /// Finds the lens surfaces that a ray meets between near and far.
    pub fn find(&mut self, plan: &Plan, ranks: &[usize], ray: &Ray, pixel: &wgsl::PixelRay) {
        self.hits.clear();
        self.contacts.clear();
        self.find_by_rank(plan, ranks, ray, pixel);
        self.hits.sort_unstable_by(|a, b| a.depth.total_cmp(&b.depth).then(a.rank.cmp(&b.rank)));
    }

    fn find_by_rank(&mut self, plan: &Plan, ranks: &[usize], ray: &Ray, pixel: &wgsl::PixelRay) {
        let Self { hits, contacts, boundaries } = self;
        for &rank in ranks {
            let lens = &plan.lenses[rank];
            let Some(glass) = &lens.glass else { continue };
            boundaries.clear();
            lens.volume.boundaries(ray, plan.view.near, plan.view.far, boundaries);
            for boundary in boundaries.iter() {
                let part = &lens.volume.parts[boundary.part];
                let crossing = boundary.crossing();
                if glass.contact > 0.0 {
                    contacts.push(Contact { rank, part: boundary.part, crossing: *crossing });
                }
                if !part.form.is_seen(crossing.face) {
                    continue;
                }
                let facing = lens.volume.normal(ray, boundary).dot(ray.direction.normalize()).abs();
                let silhouette = silhouette(plan, part, ray, &boundary.span, pixel);
                let opacity = wgsl::glass_opacity(record(glass), facing as f32, silhouette);
                if opacity > 0.0 {
                    let color = g4(a4(glass.color)).truncate().extend(opacity);
                    hits.push(GlassHit { depth: boundary.depth, rank, color });
                }
            }
        }
    }
}

/// Pixels from the outline of a part in the picture.
fn silhouette(plan: &Plan, part: &Solid, ray: &Ray, span: &Span, pixel: &wgsl::PixelRay) -> f32 {
    if part.is_flat {
        return flat_silhouette(plan, part, pixel);
    }
    // Around the eye a volume has no outline.
    if plan.view.is_perspective() && plan.view.from_eye(span.entry.t) <= 0.0 {
        return f32::INFINITY;
    }
    let normal = |c: &Crossing| d3(part.normal(ray, c));
    let join = part.form.is_smooth_join(span.entry.face, span.exit.face);
    wgsl::silhouette_distance(
        *pixel,
        plan.view.anchor.depth as f32,
        span.entry.t as f32,
        normal(&span.entry),
        span.exit.t as f32,
        normal(&span.exit),
        u32::from(join),
    )
}

/// A flat part is outlined by its polygon.
fn flat_silhouette(plan: &Plan, part: &Solid, pixel: &wgsl::PixelRay) -> f32 {
    let corners = &part.hull;
    let origin = plan.view.origin();
    let around = |p: glam::DVec3| d3(p - origin);
    (0..corners.len())
        .map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            wgsl::edge_distance(*pixel, around(a), around(b))
        })
        .fold(f32::INFINITY, f32::min)
}
