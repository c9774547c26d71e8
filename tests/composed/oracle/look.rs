//! What a ray meets: every triangle of everything, wherever movers may have put it.

use glam::{DAffine3, DVec3};

use super::caps::{self, Body};
use super::solid::hit;
use super::view::{Ray, View};
use super::walk::{Act, Actor, Composition, Met, Outcome, Subject};
use super::{names, place};
use crate::case::{Cap, Case, Filter};

/// Surfaces closer than this share of the depth to a boundary or to each other, at least of one unit, are in doubt.
pub const DOUBT: f64 = 1e-4;

/// A way in which a primitive may be shown: moved by some filters, or by none.
struct Candidate {
    subject: usize,
    moves: Vec<Act>,
    is_single_sided: bool,
    /// World space, where they would be shown.
    triangles: Vec<[DVec3; 3]>,
}

/// All that may be seen in a case.
pub struct Stage<'a> {
    pub case: &'a Case,
    pub view: View,
    pub composition: Composition<'a>,
    pub subjects: Vec<Subject>,
    candidates: Vec<Candidate>,
    pub bodies: Vec<Body>,
    /// The smallest and the largest depth of a corner of the scene's triangles in their places.
    scene: [f64; 2],
}

/// A fragment on a ray.
pub struct Hit {
    pub depth: f64,
    pub subject: usize,
    pub surface: Surface,
    /// `None` where rounding decides whether and how it is shown, or SEMANTICS does not say.
    pub met: Option<Met>,
}

#[derive(Debug, Clone, Copy)]
pub enum Surface {
    /// World space, where it is shown.
    Triangle([DVec3; 3]),
    /// Whose it is, and what it looks like.
    Cap(Actor, Cap),
    /// A cap, if anything, but SEMANTICS does not say which.
    Open,
}

impl Hit {
    /// Who closes a solid here.
    pub fn cap_by(&self) -> Option<Actor> {
        if let Surface::Cap(by, _) = self.surface { Some(by) } else { None }
    }
}

impl<'a> Stage<'a> {
    pub fn new(case: &'a Case) -> Self {
        let view = View::new(&case.camera);
        let composition = Composition::new(case, &view);
        let subjects = subjects(case, &composition);
        let movers = composition.movers();
        let depths = |subject: &Subject| {
            let model = &case.models[subject.model];
            let world = place::of_node(model, subject.node);
            let corners = model.nodes[subject.node].primitives.iter().flat_map(|p| p.triangles.iter().flatten());
            let depths = corners.map(|p| (world.transform_point3(*p) - view.eye).dot(view.forward));
            depths.collect::<Vec<f64>>()
        };
        let scene = subjects
            .iter()
            .flat_map(depths)
            .fold([f64::INFINITY, f64::NEG_INFINITY], |range, depth| [range[0].min(depth), range[1].max(depth)]);
        let mut stage = Self { case, view, composition, subjects, candidates: Vec::new(), bodies: Vec::new(), scene };
        for subject in 0..stage.subjects.len() {
            for chain in 0..1usize << movers.len() {
                let moves = (0..movers.len()).filter(|i| chain >> i & 1 == 1).map(|i| movers[i]).collect();
                stage.candidates.extend(stage.candidate(subject, moves));
            }
        }
        stage.bodies = caps::bodies(&stage);
        stage
    }

    /// Moved forward by the inverse of what the walk does.
    fn candidate(&self, index: usize, moves: Vec<Act>) -> Option<Candidate> {
        let subject = &self.subjects[index];
        let mut source_from_shown = DAffine3::IDENTITY;
        for act in &moves {
            source_from_shown = self.composition.source_from_shown(*act, subject)? * source_from_shown;
        }
        let model = &self.case.models[subject.model];
        let world = place::of_node(model, subject.node);
        let shown = source_from_shown.inverse() * world;
        let primitive = &model.nodes[subject.node].primitives[subject.primitive];
        let mirrored = world.matrix3.determinant() < 0.0;
        let place = |t: &[DVec3; 3]| {
            let [a, b, c] = t.map(|p| shown.transform_point3(p));
            // A mirrored triangle winds the other way round.
            if mirrored { [a, c, b] } else { [a, b, c] }
        };
        Some(Candidate {
            subject: index,
            moves,
            is_single_sided: self.case.cull && !model.materials[primitive.material].double_sided,
            triangles: primitive.triangles.iter().map(place).collect(),
        })
    }

    /// The corners, not on an edge, of the other triangles of a node that run along it; all as shown.
    pub fn across(&self, subject: usize, moves: &[Act], ends: [DVec3; 2], own: DVec3) -> Vec<DVec3> {
        let near = |p: DVec3, q: DVec3| p.distance(q) < 1e-6 * p.length().max(1.0);
        let of = |subject: usize| {
            let Subject { model, node, shown_by, .. } = &self.subjects[subject];
            (*model, *node, *shown_by)
        };
        let is_same = |candidate: &&Candidate| candidate.moves == moves && of(candidate.subject) == of(subject);
        let triangles = self.candidates.iter().filter(is_same).flat_map(|candidate| &candidate.triangles);
        let opposite = |corners: &[DVec3; 3]| {
            let other = corners.iter().position(|p| ends.iter().all(|end| !near(*p, *end)))?;
            let is_on = |end: &DVec3| corners.iter().any(|p| near(*p, *end));
            (ends.iter().all(is_on) && !near(corners[other], own)).then_some(corners[other])
        };
        triangles.filter_map(opposite).collect()
    }

    /// Every fragment between near and far that is displayed or may be, nearest first.
    pub fn hits(&self, ray: &Ray) -> Vec<Hit> {
        let mut hits = Vec::new();
        for candidate in &self.candidates {
            for triangle in &candidate.triangles {
                let Some(depth) = hit(ray, triangle) else { continue };
                let [a, b, c] = *triangle;
                let seen_from_behind = (b - a).cross(c - a).dot(ray.direction) > 0.0;
                if candidate.is_single_sided && seen_from_behind {
                    continue;
                }
                let met = match self.meet(candidate, ray, depth) {
                    Outcome::Gone => continue,
                    Outcome::Shown(met) => Some(met),
                    Outcome::Open | Outcome::Erased(..) => None,
                };
                hits.push(Hit { depth, subject: candidate.subject, surface: Surface::Triangle(*triangle), met });
            }
        }
        hits.extend(caps::hits(self, ray));
        hits.sort_by(|a, b| a.depth.total_cmp(&b.depth));
        hits
    }

    /// What the walk says of a hit; open where a little nearer or farther it says something else.
    fn meet(&self, candidate: &Candidate, ray: &Ray, depth: f64) -> Outcome {
        let near = DOUBT * depth.abs().max(1.0);
        let [here, before, behind] = [depth, depth - near, depth + near].map(|d| self.verdict(candidate, ray, d));
        let same = |there: &Outcome| match (&here, there) {
            (Outcome::Shown(a), Outcome::Shown(b)) => a.set == b.set && a.stack == b.stack,
            (a, b) => a == b,
        };
        if same(&before) && same(&behind) { here } else { Outcome::Open }
    }

    /// Whether this is what is shown there.
    fn verdict(&self, candidate: &Candidate, ray: &Ray, depth: f64) -> Outcome {
        if depth < self.view.near || depth > self.view.far {
            return Outcome::Gone;
        }
        match self.composition.walk(&self.subjects[candidate.subject], ray.at(depth)) {
            Outcome::Shown(met) if met.moves != candidate.moves => Outcome::Gone,
            Outcome::Erased(..) => Outcome::Gone,
            outcome => outcome,
        }
    }

    /// Whether a fitted plane of the camera may leave a boundary of a lens that goes on for ever out of the picture: such
    /// lenses do not move it, and how far beyond the scene it lies, is not said.
    pub fn may_be_left_out(&self, ray: &Ray) -> bool {
        let [nearest, farthest] = self.scene;
        let is_beyond = |depth: &f64| {
            *depth >= self.view.near
                && (self.case.camera.near.is_none() && *depth < nearest
                    || self.case.camera.far.is_none() && *depth > farthest)
        };
        let endless = self.composition.lenses.iter().filter(|lens| lens.solid.has_endless_part());
        endless.flat_map(|lens| lens.boundaries(ray)).any(|depth| is_beyond(&depth))
    }

    /// Where lenses begin and end along a ray between near and far, nearest first.
    pub fn boundaries(&self, ray: &Ray) -> Vec<f64> {
        let order = self.composition.order.iter();
        let mut all: Vec<f64> = order.flat_map(|lens| self.composition.lenses[*lens].boundaries(ray)).collect();
        all.retain(|depth| *depth > self.view.near && *depth < self.view.far);
        all.sort_by(f64::total_cmp);
        all
    }
}

/// The scene's fragments, then those that each `show` brings in.
fn subjects(case: &Case, composition: &Composition) -> Vec<Subject> {
    let mut subjects = Vec::new();
    add(case, 0, None, &|node| !names::node_matches(&case.models[0], node, &case.hide), &mut subjects);
    let lenses = composition.order.iter().map(|lens| (Actor::Lens(*lens), &case.lenses[*lens].filters));
    let rules = case.rules.iter().enumerate().map(|(rule, r)| (Actor::Rule(rule), &r.filters));
    for (by, filters) in lenses.chain(rules) {
        for (filter, what) in filters.iter().enumerate() {
            let shown_by = Some(Act { by, filter });
            match what {
                Filter::ShowAlternate(model) => add(case, *model, shown_by, &|_| true, &mut subjects),
                Filter::ShowNodes(patterns) => {
                    let is_named = |node: usize| names::node_matches(&case.models[0], node, patterns);
                    add(case, 0, shown_by, &is_named, &mut subjects);
                }
                _ => {}
            }
        }
    }
    subjects
}

fn add(case: &Case, model: usize, shown_by: Option<Act>, has: &dyn Fn(usize) -> bool, subjects: &mut Vec<Subject>) {
    for (node, data) in case.models[model].nodes.iter().enumerate().filter(|(node, _)| has(*node)) {
        if data.primitives.is_empty() {
            continue;
        }
        let center = place::center_of_node(&case.models[model], node);
        let primitives = 0..data.primitives.len();
        subjects.extend(primitives.map(|primitive| Subject { model, node, primitive, shown_by, center }));
    }
}
