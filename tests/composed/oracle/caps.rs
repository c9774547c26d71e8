//! Caps: where an eraser with `cap` cuts a solid, its boundary is closed (6.6). Solids are convex here: the points behind
//! the planes of all their faces.

use std::ops::Range;

use glam::{DAffine3, DVec3};

use super::look::{DOUBT, Hit, Stage, Surface};
use super::place;
use super::view::Ray;
use super::walk::{Act, Actor, Closed, Met, Outcome, SAME, Stack};
use crate::case::{Cap, Filter};

/// A solid node as it may be shown.
pub struct Body {
    /// Its primitives, into the stage's subjects.
    subjects: Range<usize>,
    moves: Vec<Act>,
    /// After so many of the moves, the last first: where a shown point is looked for.
    sources: Vec<DAffine3>,
    /// World space, where it is shown.
    corners: Vec<DVec3>,
    /// `n·p < d` inside.
    planes: Vec<(DVec3, f64)>,
}

/// What is at a boundary inside a solid.
#[derive(Clone, PartialEq)]
enum Cut {
    No,
    Cap(Actor, Cap, Met),
    /// SEMANTICS does not say.
    Open,
}

/// All solids of a case, if anything closes what it cuts.
pub fn bodies(stage: &Stage) -> Vec<Body> {
    let case = stage.case;
    let closes = |filter: &Filter| matches!(filter, Filter::Erase(_, Some(_)));
    let mut filters = case.lenses.iter().flat_map(|l| &l.filters).chain(case.rules.iter().flat_map(|r| &r.filters));
    if !filters.any(closes) {
        return Vec::new();
    }
    let movers = stage.composition.movers();
    let mut bodies = Vec::new();
    let mut first = 0;
    for node in stage.subjects.chunk_by(|a, b| (a.model, a.node, a.shown_by) == (b.model, b.node, b.shown_by)) {
        let subjects = first..first + node.len();
        first = subjects.end;
        for chain in 0..1usize << movers.len() {
            let moves = (0..movers.len()).filter(|i| chain >> i & 1 == 1).map(|i| movers[i]).collect();
            bodies.extend(body(stage, subjects.clone(), moves));
        }
    }
    bodies
}

/// `None` where the node is not closed, or is never moved like that.
fn body(stage: &Stage, subjects: Range<usize>, moves: Vec<Act>) -> Option<Body> {
    let subject = &stage.subjects[subjects.start];
    let model = &stage.case.models[subject.model];
    let triangles: Vec<[DVec3; 3]> =
        model.nodes[subject.node].primitives.iter().flat_map(|p| p.triangles.clone()).collect();
    if !is_closed(&triangles) {
        return None;
    }
    let mut sources = vec![DAffine3::IDENTITY];
    for act in &moves {
        sources.push(stage.composition.source_from_shown(*act, subject)? * sources[sources.len() - 1]);
    }
    let shown = sources[moves.len()].inverse() * place::of_node(model, subject.node);
    let shown: Vec<[DVec3; 3]> = triangles.iter().map(|t| t.map(|p| shown.transform_point3(p))).collect();
    let corners = shown.concat();
    let middle = corners.iter().sum::<DVec3>() / corners.len() as f64;
    let plane = |[a, b, c]: &[DVec3; 3]| {
        let n = (*b - *a).cross(*c - *a).normalize();
        let n = if n.dot(middle - *a) > 0.0 { -n } else { n };
        (n, n.dot(*a))
    };
    let planes: Vec<(DVec3, f64)> = shown.iter().map(plane).collect();
    assert!(corners.iter().all(|p| planes.iter().all(|(n, d)| n.dot(*p) < d + 1e-5)), "solids of cases are convex");
    Some(Body { subjects, moves, sources, corners, planes })
}

/// Whether every edge is run along once each way.
fn is_closed(triangles: &[[DVec3; 3]]) -> bool {
    let edges: Vec<[DVec3; 2]> = triangles.iter().flat_map(|[a, b, c]| [[*a, *b], [*b, *c], [*c, *a]]).collect();
    edges.iter().all(|[a, b]| edges.contains(&[*b, *a]))
}

/// The caps on a ray.
pub fn hits(stage: &Stage, ray: &Ray) -> Vec<Hit> {
    let mut cuts: Vec<(f64, &Body, Cut)> = Vec::new();
    for body in &stage.bodies {
        cuts.extend(body.cuts(stage, ray).into_iter().map(|(depth, cut)| (depth, body, cut)));
    }
    cuts.sort_by(|(a, ..), (b, ..)| a.total_cmp(b));
    let at_one_depth = |a: &(f64, &Body, Cut), b: &(f64, &Body, Cut)| b.0 - a.0 <= SAME * a.0.abs().max(1.0);
    let hit = |there: &[(f64, &Body, Cut)]| {
        // Of solids that lie in each other the inner one is closed; of others that is not said.
        let is_innermost =
            |inner: &Body| there.iter().all(|(_, outer, _)| std::ptr::eq(*outer, inner) || inner.lies_in(outer));
        let is_clear = there.iter().all(|(.., cut)| *cut != Cut::Open);
        let subject = |body: &Body| body.subjects.start;
        match there.iter().find(|(_, body, _)| is_clear && is_innermost(body)) {
            Some((depth, body, Cut::Cap(by, look, met))) => {
                let surface = Surface::Cap(*by, *look);
                Hit { depth: *depth, subject: subject(body), surface, met: Some(met.clone()) }
            }
            _ => Hit { depth: there[0].0, subject: subject(there[0].1), surface: Surface::Open, met: None },
        }
    };
    cuts.chunk_by(at_one_depth).map(hit).collect()
}

impl Body {
    fn lies_in(&self, other: &Body) -> bool {
        self.corners.iter().all(|p| other.planes.iter().all(|(n, d)| n.dot(*p) < *d))
    }

    /// What a ray has inside.
    fn span(&self, ray: &Ray) -> (f64, f64) {
        let clipped = |(start, end): (f64, f64), (n, d): &(DVec3, f64)| {
            let (rate, at) = (n.dot(ray.direction), (d - n.dot(ray.origin)) / n.dot(ray.direction));
            if rate < 0.0 { (start.max(at), end) } else { (start, end.min(at)) }
        };
        self.planes.iter().fold((f64::NEG_INFINITY, f64::INFINITY), clipped)
    }

    /// The boundaries on a ray inside the solid where it is closed, or may be.
    fn cuts(&self, stage: &Stage, ray: &Ray) -> Vec<(f64, Cut)> {
        let (start, end) = self.span(ray);
        let margin = |depth: f64| DOUBT * depth.abs().max(1.0);
        if start - margin(start) >= end + margin(end) {
            return Vec::new();
        }
        let moved = |source: &DAffine3| Ray {
            origin: source.transform_point3(ray.origin),
            direction: source.transform_vector3(ray.direction),
        };
        let mut depths: Vec<f64> = self.sources.iter().flat_map(|s| stage.boundaries(&moved(s))).collect();
        depths.sort_by(f64::total_cmp);
        depths.dedup_by(|b, a| *b - *a <= SAME * a.abs().max(1.0));
        let cut = |(place, depth): (usize, &f64)| {
            let near = margin(*depth);
            if *depth < start - near || *depth > end + near {
                return None;
            }
            let others = depths.iter().enumerate().filter(|(other, _)| *other != place).map(|(_, depth)| depth);
            let is_clear = others.chain([&start, &end]).all(|other| (other - depth).abs() > 2.0 * near);
            match self.cut(stage, ray, *depth, near) {
                Cut::No => None,
                cut => Some((*depth, if is_clear { cut } else { Cut::Open })),
            }
        };
        depths.iter().enumerate().filter_map(cut).collect()
    }

    /// What lies at a boundary, by what is displayed and erased a little before it and a little behind.
    fn cut(&self, stage: &Stage, ray: &Ray, depth: f64, near: f64) -> Cut {
        let primitive = |subject: usize| {
            let walk = |depth: f64| stage.composition.walk(&stage.subjects[subject], ray.at(depth));
            match [walk(depth - near), walk(depth + near)] {
                [Outcome::Shown(shown), Outcome::Erased(met, closed)] => self.closed(stage, &shown, &met, closed, &met),
                [Outcome::Erased(met, closed), Outcome::Shown(shown)] => {
                    self.closed(stage, &shown, &met, closed, &shown)
                }
                [Outcome::Open, _] | [_, Outcome::Open] => Cut::Open,
                _ => Cut::No,
            }
        };
        let cuts: Vec<Cut> = self.subjects.clone().map(primitive).collect();
        let is_same = |cut: &Cut| match (&cuts[0], cut) {
            (Cut::Cap(a, b, c), Cut::Cap(d, e, f)) => (a, b, &c.set, &c.stack) == (d, e, &f.set, &f.stack),
            (first, other) => first == other,
        };
        // Which of several primitives a solid is closed like is not said.
        let is_of_one = |cut: &Cut| !matches!(cut, Cut::Cap(_, Cap::Own, _)) || self.materials(stage) == 1;
        if cuts.iter().all(is_same) && is_of_one(&cuts[0]) { cuts[0].clone() } else { Cut::Open }
    }

    /// How many different materials its primitives have.
    fn materials(&self, stage: &Stage) -> usize {
        let material = |subject: usize| {
            let subject = &stage.subjects[subject];
            stage.case.models[subject.model].nodes[subject.node].primitives[subject.primitive].material
        };
        let mut all: Vec<usize> = self.subjects.clone().map(material).collect();
        all.sort_unstable();
        all.dedup();
        all.len()
    }

    /// The cap where this is shown on one side and erased on the other; it lies in the region `behind` it.
    fn closed(&self, stage: &Stage, shown: &Met, erased: &Met, closed: Closed, behind: &Met) -> Cut {
        match closed {
            _ if shown.moves != self.moves || erased.moves != self.moves => Cut::No,
            Closed::Not => Cut::No,
            Closed::By(by, look) => Cut::Cap(by, look, without_lower(stage, behind, by)),
            Closed::Open => Cut::Open,
        }
    }
}

/// What lenses below the one that makes a cap do, they do not do to it; a rule has no place in the order.
fn without_lower(stage: &Stage, behind: &Met, by: Actor) -> Met {
    let (Stack::Lenses(lenses), Actor::Lens(maker)) = (&behind.stack, by) else { return behind.clone() };
    let place = |lens: usize| stage.composition.order.iter().position(|other| *other == lens);
    let stays = |lens: &usize| place(*lens) >= place(maker);
    Met { stack: Stack::Lenses(lenses.iter().copied().filter(stays).collect()), ..behind.clone() }
}
