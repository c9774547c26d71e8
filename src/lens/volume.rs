//! A lens volume: solids put together.

use std::cell::RefCell;

use glam::DVec3;

use super::holding::Holding;
use super::tree::Algebra;
use super::{Crossing, PixelRect, Solid, Span, Tree};
use crate::scene::Aabb;
use crate::view::{Merging, Ray, View};

/// The volume of one lens: its parts, and how they are put together.
#[derive(Debug, Clone, PartialEq)]
pub struct Volume {
    pub parts: Vec<Solid>,
    pub tree: Tree,
    /// World space. For a compound the mean of the parts' centres.
    pub center: DVec3,
}

/// What a view ray has inside a volume between near and far: `entry <= depth < exit`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Interval {
    pub entry: f64,
    pub exit: f64,
}

/// Where a ray enters or leaves a volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Boundary {
    pub depth: f64,
    /// The part whose surface this is: the first at this depth that makes a difference.
    pub part: usize,
    /// What the ray has inside that part.
    pub span: Span,
    /// Whether the ray enters the part here, rather than leaves it.
    pub enters_part: bool,
    /// Whether it enters the volume.
    pub enters: bool,
}

/// What a ray meets of the parts of a compound: kept from ray to ray, since a picture asks for millions.
#[derive(Default)]
struct Buffers {
    holding: Holding,
    crossings: Vec<Boundary>,
    spans: Vec<Span>,
}

thread_local! {
    static BUFFERS: RefCell<Buffers> = RefCell::default();
}

impl Boundary {
    /// The ends of a span that lie strictly between two planes, as boundaries of its part alone.
    fn ends(part: usize, span: Span, near: f64, far: f64) -> impl Iterator<Item = Boundary> {
        let at = move |depth: f64, enters: bool| Boundary { depth, part, span, enters_part: enters, enters };
        [at(span.entry.t, true), at(span.exit.t, false)].into_iter().filter(move |b| b.depth > near && b.depth < far)
    }

    pub fn crossing(&self) -> &Crossing {
        if self.enters_part { &self.span.entry } else { &self.span.exit }
    }
}

impl Volume {
    /// Whether the shape itself is a flat polygon, rather than a compound of such.
    pub fn is_flat(&self) -> bool {
        matches!(self.tree, Tree::Part(part) if self.parts[part].is_flat)
    }

    /// The only part, if it is convex: a ray has at most one interval, and nothing needs to be put together.
    pub fn lone(&self) -> Option<(usize, &Solid)> {
        match self.tree {
            Tree::Part(part) if self.parts[part].form.is_convex() => Some((part, &self.parts[part])),
            _ => None,
        }
    }

    /// Appends the intervals of SEMANTICS section 2, nearest first: cut by near and far, none where the ray only grazes.
    pub fn intervals(&self, ray: &Ray, near: f64, far: f64, out: &mut Vec<Interval>) {
        if let Some((_, solid)) = self.lone() {
            let span = solid.span(ray).and_then(|span| span.between(near, far));
            out.extend(span.map(|span| Interval { entry: span.entry.t.max(near), exit: span.exit.t.min(far) }));
            return;
        }
        let (mut entry, mut is_crossed) = (None, false);
        let starts_inside = self.cross(ray, near, far, |boundary| {
            is_crossed = true;
            if boundary.enters {
                entry = Some(boundary.depth);
            } else {
                // A ray that has not entered has been inside from the start.
                out.push(Interval { entry: entry.take().unwrap_or(near), exit: boundary.depth });
            }
        });
        let rest = entry.or((starts_inside && !is_crossed).then_some(near));
        out.extend(rest.map(|entry| Interval { entry, exit: far }));
    }

    /// Appends where a ray enters and leaves the volume strictly between near and far, nearest first; returns whether
    /// it is inside at the near plane.
    pub fn boundaries(&self, ray: &Ray, near: f64, far: f64, out: &mut Vec<Boundary>) -> bool {
        self.cross(ray, near, far, |boundary| out.push(boundary))
    }

    /// The same, telling of one boundary after the other.
    fn cross(&self, ray: &Ray, near: f64, far: f64, tell: impl FnMut(Boundary)) -> bool {
        if let Some((part, solid)) = self.lone() {
            let Some(span) = solid.span(ray).and_then(|span| span.between(near, far)) else { return false };
            Boundary::ends(part, span, near, far).for_each(tell);
            return span.entry.t <= near;
        }
        BUFFERS.with_borrow_mut(|Buffers { holding, crossings, spans }| {
            holding.start(&self.tree, self.parts.len());
            crossings.clear();
            for (part, solid) in self.parts.iter().enumerate() {
                spans.clear();
                solid.spans(ray, spans);
                for span in spans.iter().filter_map(|span| span.between(near, far)) {
                    if span.entry.t <= near {
                        holding.set(part, true);
                    }
                    crossings.extend(Boundary::ends(part, span, near, far));
                }
            }
            crossings.sort_by(|a, b| a.depth.total_cmp(&b.depth));
            let starts_inside = holding.holds();
            changes(crossings, holding, &ray.merging, tell);
            starts_inside
        })
    }

    /// Outward unit normal in the world at a boundary of a ray: turned round where the part is taken away.
    pub fn normal(&self, ray: &Ray, boundary: &Boundary) -> DVec3 {
        let normal = self.parts[boundary.part].normal(ray, boundary.crossing());
        if (normal.dot(ray.direction) < 0.0) == boundary.enters { normal } else { -normal }
    }

    /// Distance in world units from a point to the boundary, positive inside; of a compound to the boundaries of its
    /// parts, which is no more than to its own.
    pub fn depth_inside(&self, p: DVec3) -> f64 {
        let algebra: Algebra<f64> = Algebra { union: f64::max, intersection: f64::min, difference: |a, b| a.min(-b) };
        self.tree.fold(&algebra, &|part| self.parts[part].depth_inside(p)).unwrap_or(f64::NEG_INFINITY)
    }

    pub fn contains(&self, p: DVec3) -> bool {
        self.tree.holds(&|part| self.parts[part].contains(p))
    }

    /// World bounds; unlimited where flat lenses, half-spaces or slabs make them so.
    pub fn bounds(&self) -> Aabb {
        let algebra = Algebra { union: Aabb::union, intersection: Aabb::intersection, difference: |a, _| a };
        self.tree.fold(&algebra, &|part| self.parts[part].bounds()).unwrap_or(Aabb::EMPTY)
    }

    /// World points whose convex hull holds what is bounded of the volume and what its flat parts are seen through.
    pub fn hull(&self) -> impl Iterator<Item = DVec3> + '_ {
        self.tree.added_parts().into_iter().flat_map(|part| self.parts[part].hull.iter().copied())
    }

    /// The pixels outside which no view ray meets the volume between near and far.
    pub fn pixel_rect(&self, view: &View) -> PixelRect {
        let algebra = Algebra { union: PixelRect::union, intersection: PixelRect::intersection, difference: |a, _| a };
        self.tree.fold(&algebra, &|part| self.parts[part].pixel_rect(view)).unwrap_or(PixelRect::EMPTY)
    }
}

/// Goes through the crossings of parts in order. Those that are close together are one boundary, at which several parts
/// change; it is one of the volume where the whole then holds and did not, or the other way round.
fn changes(crossings: &[Boundary], holding: &mut Holding, merging: &Merging, mut tell: impl FnMut(Boundary)) {
    let mut held = holding.holds();
    let mut rest = crossings;
    while let Some(first) = rest.first() {
        let merged = rest.iter().take_while(|c| !merging.starts_boundary(first.depth, c.depth)).count();
        let mut holds = held;
        let mut changed = None;
        for crossing in &rest[..merged] {
            holds = holding.set(crossing.part, crossing.enters_part);
            if holds != held {
                changed = changed.or(Some(crossing));
            }
        }
        if let Some(crossing) = changed.filter(|_| holds != held) {
            tell(Boundary { depth: first.depth, enters: holds, ..*crossing });
        }
        held = holds;
        rest = &rest[merged..];
    }
}
