//! Lens surfaces along a ray.

use super::convert::{a4, d3, g4, glass as record};
use crate::appearance as wgsl;
use crate::lens::{Crossing, Span};
use crate::plan::{Lens, Plan};
use crate::view::Ray;

/// A point of a lens surface: depth, lens rank, and its colour with opacity in alpha (linear, straight).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GlassHit {
    pub depth: f64,
    pub rank: usize,
    pub color: glam::Vec4,
}

/// Appends the lens surfaces that a ray meets between near and far.
pub fn find(plan: &Plan, ranks: &[usize], ray: &Ray, pixel: &wgsl::PixelRay, hits: &mut Vec<GlassHit>) {
    for &rank in ranks {
        let lens = &plan.lenses[rank];
        let (Some(glass), Some(span)) = (&lens.glass, lens.volume.span(ray)) else { continue };
        let glass = record(glass);
        let silhouette = silhouette(plan, lens, ray, &span, pixel);
        for crossing in [&span.entry, &span.exit] {
            let within = crossing.t > plan.view.near && crossing.t < plan.view.far;
            if !within || !lens.volume.form.is_seen(crossing.face) {
                continue;
            }
            let facing = lens.volume.normal(ray, crossing).dot(ray.direction.normalize()).abs();
            let opacity = wgsl::glass_opacity(glass, facing as f32, silhouette);
            if opacity > 0.0 {
                let color = g4(a4(lens.glass.map_or([0.0; 4], |g| g.color))).truncate().extend(opacity);
                hits.push(GlassHit { depth: crossing.t, rank, color });
            }
        }
    }
}

/// Pixels from the lens's outline in the picture.
fn silhouette(plan: &Plan, lens: &Lens, ray: &Ray, span: &Span, pixel: &wgsl::PixelRay) -> f32 {
    if lens.volume.is_flat {
        return flat_silhouette(plan, lens, pixel);
    }
    // Around the eye a volume has no outline.
    if plan.view.is_perspective() && span.entry.t <= 0.0 {
        return f32::INFINITY;
    }
    let normal = |c: &Crossing| d3(lens.volume.normal(ray, c));
    let join = lens.volume.form.is_smooth_join(span.entry.face, span.exit.face);
    wgsl::silhouette_distance(
        *pixel,
        span.entry.t as f32,
        normal(&span.entry),
        span.exit.t as f32,
        normal(&span.exit),
        u32::from(join),
    )
}

/// A flat lens is outlined by its polygon.
fn flat_silhouette(plan: &Plan, lens: &Lens, pixel: &wgsl::PixelRay) -> f32 {
    let corners = &lens.volume.hull;
    let around_eye = |p: glam::DVec3| d3(p - plan.view.eye);
    (0..corners.len())
        .map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            wgsl::edge_distance(*pixel, around_eye(a), around_eye(b))
        })
        .fold(f32::INFINITY, f32::min)
}
