//! Who acts on a fragment that is shown at a point, and what the point shows: sections 2, 4 and 5 of SEMANTICS.

use glam::{DAffine3, DVec3};

use super::names::{self, either_matches, node_matches};
use super::solid::{Sight, Solid};
use super::view::{Ray, View};
use super::{order, place};
use crate::case::{Cap, Case, Displacement, Filter, Patterns};

/// Crossings closer than this share are surely one boundary.
pub const SAME: f64 = 1e-6;
/// Directions in which a ball is looked at.
const BALL: u32 = 60;

/// A filter that shows content or moves it: whose, and its place in the list.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Act {
    pub by: Actor,
    pub filter: usize,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Actor {
    Lens(usize),
    Rule(usize),
}

/// A primitive of a node, as part of the scene or of what a `show` brings in.
#[derive(Debug, Clone)]
pub struct Subject {
    pub model: usize,
    pub node: usize,
    pub primitive: usize,
    pub shown_by: Option<Act>,
    /// Of the node, for `by = "object"` and `explode`.
    pub center: DVec3,
}

/// Who acts.
#[derive(Debug, Clone, PartialEq)]
pub enum Stack {
    /// Lowest first.
    Lenses(Vec<usize>),
    Rule(usize),
}

/// What the walk down the order met.
#[derive(Debug, Clone, PartialEq)]
pub struct Met {
    /// S, the lowest first.
    pub set: Vec<usize>,
    pub stack: Stack,
    /// The filters that moved the point, in the order of the walk.
    pub moves: Vec<Act>,
    /// Where each lens of the stack was asked.
    pub asked: Vec<(usize, DVec3)>,
}

impl Met {
    /// Where a lens of the stack was asked.
    pub fn asked_at(&self, lens: usize) -> DVec3 {
        self.asked.iter().find(|(asked, _)| *asked == lens).expect("every lens of the stack was asked").1
    }
}

/// Nothing is there, or what SEMANTICS leaves open.
#[derive(Debug, Clone, PartialEq)]
pub enum Outcome {
    Gone,
    /// Erasers alone take it away.
    Erased(Met, Closed),
    Shown(Met),
    Open,
}

/// What closes a solid where it is erased.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Closed {
    Not,
    By(Actor, Cap),
    /// SEMANTICS does not say what.
    Open,
}

pub struct Lens {
    pub solid: Solid,
    pub sight: Sight,
    pub shape_from_world: DAffine3,
    /// World space.
    pub center: DVec3,
}

impl Lens {
    pub fn contains(&self, p: DVec3) -> bool {
        self.solid.contains(self.shape_from_world.transform_point3(p), &self.sight)
    }

    /// Where a view ray enters and leaves it, anywhere on its line.
    pub fn boundaries(&self, ray: &Ray) -> Vec<f64> {
        let local = Ray {
            origin: self.shape_from_world.transform_point3(ray.origin),
            direction: self.shape_from_world.transform_vector3(ray.direction),
        };
        let mut depths = self.solid.crossings(&local, &self.sight);
        depths.retain(|depth| depth.is_finite());
        depths.sort_by(f64::total_cmp);
        depths.dedup_by(|b, a| *b - *a <= SAME * a.abs().max(1.0));
        let (Some(first), Some(last)) = (depths.first(), depths.last()) else { return depths };
        let ends = [&[first - 1.0], &depths[..], &[last + 1.0]].concat();
        // A crossing is a boundary where the middles of the stretches before and behind it differ.
        let middle_is_inside = |pair: &[f64]| self.contains(ray.at(0.5 * (pair[0] + pair[1])));
        let inside: Vec<bool> = ends.windows(2).map(middle_is_inside).collect();
        (1..inside.len()).filter(|i| inside[i - 1] != inside[*i]).map(|i| ends[i]).collect()
    }

    /// Distance from a point inside to the boundary in world units, where it is exact by plain geometry.
    pub fn depth_inside(&self, p: DVec3) -> Option<f64> {
        self.solid.depth_inside(self.shape_from_world.transform_point3(p), &self.shape_from_world.matrix3)
    }

    /// Whether everything within a distance of a point is inside, as some directions tell.
    pub fn contains_ball(&self, center: DVec3, radius: f64) -> bool {
        let turn = std::f64::consts::PI * (3.0 - 5f64.sqrt());
        (0..BALL).all(|i| {
            let (z, angle) = (1.0 - (2.0 * f64::from(i) + 1.0) / f64::from(BALL), turn * f64::from(i));
            let across = (1.0 - z * z).sqrt();
            let direction = DVec3::new(across * angle.cos(), across * angle.sin(), z);
            [0.4, 0.7, 1.0].iter().all(|share| self.contains(center + direction * (radius * share)))
        })
    }
}

/// The lenses of a case where they stand.
pub struct Composition<'a> {
    pub case: &'a Case,
    /// By their place in the file.
    pub lenses: Vec<Lens>,
    /// The enabled ones, lowest first.
    pub order: Vec<usize>,
    view: View,
}

impl<'a> Composition<'a> {
    pub fn new(case: &'a Case, view: &View) -> Self {
        let placed = |lens: &crate::case::Lens| {
            let world = place::of_lens(case, lens, view);
            let shape_from_world = world.inverse();
            let (solid, center) = super::solid::solid(case, &lens.shape);
            let along = (!view.is_perspective).then(|| shape_from_world.transform_vector3(view.forward));
            let sight = Sight { eye: shape_from_world.transform_point3(view.eye), along };
            Lens { solid, sight, shape_from_world, center: world.transform_point3(center) }
        };
        let lenses: Vec<Lens> = case.lenses.iter().map(placed).collect();
        let centers: Vec<DVec3> = lenses.iter().map(|lens| lens.center).collect();
        Self { case, order: order::total(case, view, &centers), lenses, view: view.clone() }
    }

    fn filters(&self, actor: Actor) -> &'a [Filter] {
        match actor {
            Actor::Lens(lens) => &self.case.lenses[lens].filters,
            Actor::Rule(rule) => &self.case.rules[rule].filters,
        }
    }

    pub fn filter(&self, act: Act) -> &'a Filter {
        &self.filters(act.by)[act.filter]
    }

    /// Every filter that moves content in the order of a walk: from the top lens, its last filter first.
    pub fn movers(&self) -> Vec<Act> {
        let acts = |lens: &usize| {
            let by = Actor::Lens(*lens);
            (0..self.filters(by).len()).rev().map(move |filter| Act { by, filter })
        };
        let moves = |act: &Act| matches!(self.filter(*act), Filter::Magnify { .. } | Filter::Displace { .. });
        self.order.iter().rev().flat_map(acts).filter(moves).collect()
    }

    /// The inverse map m of a mover (5.2); none where it leaves the fragment alone.
    pub fn source_from_shown(&self, act: Act, subject: &Subject) -> Option<DAffine3> {
        let Actor::Lens(lens) = act.by else { return None };
        let center = self.lenses[lens].center;
        match self.filter(act) {
            Filter::Magnify { factor, center: None } if matches!(self.lenses[lens].solid, Solid::Flat { .. }) => {
                // About the line of sight, each depth by itself.
                let source = |p: DVec3| {
                    let depth = (p - self.view.eye).dot(self.view.forward);
                    let own = (center - self.view.eye).dot(self.view.forward);
                    let on_line = if self.view.is_perspective {
                        self.view.eye + (center - self.view.eye) * (depth / own)
                    } else {
                        center + self.view.forward * (depth - own)
                    };
                    on_line + (p - on_line) / *factor
                };
                let origin = source(DVec3::ZERO);
                let [x, y, z] = DVec3::AXES.map(|axis| source(axis) - origin);
                Some(DAffine3::from_cols(x, y, z, origin))
            }
            Filter::Magnify { factor, center: given } => {
                let world = self.lenses[lens].shape_from_world.inverse();
                let fixed = given.map_or(center, |c| world.transform_point3(c));
                let towards = DAffine3::from_scale(DVec3::splat(1.0 / factor));
                Some(DAffine3::from_translation(fixed) * towards * DAffine3::from_translation(-fixed))
            }
            Filter::Displace { nodes, by } => {
                let model = &self.case.models[subject.model];
                let offset = match by {
                    Displacement::Offset(offset) => *offset,
                    Displacement::Explode(factor) => *factor * (subject.center - center),
                };
                let matched = nodes.is_empty() || node_matches(model, subject.node, nodes);
                matched.then(|| DAffine3::from_translation(-offset))
            }
            _ => None,
        }
    }

    /// Sections 2.6 to 2.8.
    fn contains(&self, lens: usize, subject: &Subject, p: DVec3) -> bool {
        let tested = if self.case.lenses[lens].by_object { subject.center } else { p };
        self.lenses[lens].contains(tested)
    }

    fn is_any(&self, subject: &Subject, patterns: &Patterns) -> bool {
        let model = &self.case.models[subject.model];
        let material = model.nodes[subject.node].primitives[subject.primitive].material;
        either_matches(model, subject.node, material, patterns)
    }

    fn is_in_scope(&self, lens: usize, subject: &Subject) -> bool {
        let spec = &self.case.lenses[lens];
        (spec.only.is_empty() || self.is_any(subject, &spec.only)) && !self.is_any(subject, &spec.except)
    }

    fn hides(&self, above: usize, below: usize) -> bool {
        let spec = &self.case.lenses[above];
        spec.overrides || spec.hides.iter().any(|p| names::lenses(self.case, above, p).any(|other| other == below))
    }

    /// Whether one of a lens's filters shows the same content as the one that brought the fragment in.
    fn names_content_of(&self, lens: usize, subject: &Subject) -> bool {
        let Some(act) = subject.shown_by else { return false };
        let same = |filter: &Filter| match (filter, self.filter(act)) {
            (Filter::ShowAlternate(a), Filter::ShowAlternate(b)) => a == b,
            (Filter::ShowNodes(a), Filter::ShowNodes(b)) => a == b,
            _ => false,
        };
        self.filters(Actor::Lens(lens)).iter().any(same)
    }

    /// The rule that holds at a point for a fragment: the last.
    fn rule(&self, around: &[usize]) -> Option<usize> {
        (0..self.case.rules.len()).rev().find(|rule| names::holds(self.case, &self.case.rules[*rule].when, around))
    }

    /// Section 4 for a fragment shown at `p`, wherever it comes from.
    pub fn walk(&self, subject: &Subject, p: DVec3) -> Outcome {
        if self.case.rules.is_empty() {
            return self.descend(subject, p);
        }
        let own = |lens: usize| subject.shown_by.is_some_and(|act| act.by == Actor::Lens(lens));
        let inside: Vec<usize> = self.order.iter().copied().filter(|lens| self.contains(*lens, subject, p)).collect();
        let plain: Vec<usize> = inside.iter().copied().filter(|lens| self.is_in_scope(*lens, subject)).collect();
        let around: Vec<usize> =
            inside.into_iter().filter(|lens| self.is_in_scope(*lens, subject) || own(*lens)).collect();
        let rule = self.rule(&around);
        if rule != self.rule(&plain) {
            // Whether what a lens shows beyond its own scope counts for a rule is not said.
            return Outcome::Open;
        }
        match (rule, subject.shown_by.map(|act| act.by)) {
            (Some(rule), Some(Actor::Rule(by))) if by == rule => self.styled(rule, subject, around),
            (Some(rule), None) => self.styled(rule, subject, around),
            (Some(_), Some(_)) | (None, Some(Actor::Rule(_))) => Outcome::Gone,
            (None, _) => self.descend(subject, p),
        }
    }

    /// What a filter does to a fragment that is there when it acts.
    fn effect(&self, act: Act, subject: &Subject) -> Effect {
        match self.filter(act) {
            Filter::Erase(what, cap) if what.is_empty() || self.is_any(subject, what) => Effect::Erases(*cap),
            Filter::ShowAlternate(_) | Filter::ShowNodes(_) if subject.shown_by == Some(act) => Effect::Brings,
            Filter::ShowAlternate(_) | Filter::ShowNodes(_) => Effect::Replaces,
            Filter::Magnify { .. } | Filter::Displace { .. } => {
                self.source_from_shown(act, subject).map_or(Effect::Nothing, Effect::Moves)
            }
            _ => Effect::Nothing,
        }
    }

    /// A rule's filters on the plain scene.
    fn styled(&self, rule: usize, subject: &Subject, set: Vec<usize>) -> Outcome {
        let by = Actor::Rule(rule);
        let met = Met { set, stack: Stack::Rule(rule), moves: Vec::new(), asked: Vec::new() };
        let filters = 0..self.filters(by).len();
        let effects: Vec<Effect> = filters.map(|filter| self.effect(Act { by, filter }, subject)).collect();
        // What the list ends with comes from its last filters; a `show` makes those before it vain.
        let decisive = effects.iter().rfind(|effect| !matches!(effect, Effect::Nothing));
        let is_replaced = effects.iter().any(|effect| matches!(effect, Effect::Replaces));
        // The first eraser leaves nothing to the others.
        let erased = effects.iter().find_map(|effect| if let Effect::Erases(cap) = effect { Some(*cap) } else { None });
        match (decisive, subject.shown_by, erased) {
            (Some(Effect::Brings), Some(_), _) | (None, None, _) => Outcome::Shown(met),
            (_, None, Some(cap)) if !is_replaced => {
                Outcome::Erased(met, cap.map_or(Closed::Not, |cap| Closed::By(by, cap)))
            }
            _ => Outcome::Gone,
        }
    }

    /// From the top of the order down.
    fn descend(&self, subject: &Subject, p: DVec3) -> Outcome {
        let (mut set, mut survivors) = (Vec::new(), Vec::new());
        let (mut moves, mut asked) = (Vec::new(), Vec::new());
        let mut at = p;
        let mut shown = false;
        // What erasers close it with, the highest first.
        let mut erased: Vec<Closed> = Vec::new();
        let (mut is_replaced, mut is_open) = (false, false);
        for lens in self.order.iter().rev().copied() {
            if !self.contains(lens, subject, at) {
                continue;
            }
            let is_hidden = survivors.iter().any(|above| self.hides(*above, lens));
            if !self.is_in_scope(lens, subject) && subject.shown_by.is_none_or(|act| act.by != Actor::Lens(lens)) {
                if !is_hidden && !shown && self.names_content_of(lens, subject) {
                    // Whether what a lower lens shows is in the scope of one that shows the same is not said.
                    is_open = true;
                }
                continue;
            }
            set.insert(0, lens);
            if is_hidden {
                continue;
            }
            survivors.insert(0, lens);
            asked.push((lens, at));
            let (place, moves_above) = (at, moves.len());
            let (mut erases, mut replaces): (Option<Closed>, bool) = (None, false);
            // The last filter of the list made what is seen of what the one before it made, and so on.
            for filter in (0..self.filters(Actor::Lens(lens)).len()).rev() {
                let act = Act { by: Actor::Lens(lens), filter };
                match self.effect(act, subject) {
                    // What lies below, in this list too, does nothing to shown content.
                    _ if shown => {}
                    Effect::Nothing => {}
                    Effect::Brings => shown = true,
                    Effect::Replaces => replaces = true,
                    // Of several the first, which leaves nothing to the others. A lens that takes whole objects cuts none.
                    Effect::Erases(Some(cap)) if !self.case.lenses[lens].by_object => {
                        erases = Some(Closed::By(act.by, cap));
                    }
                    Effect::Erases(_) => erases = Some(Closed::Not),
                    Effect::Moves(source_from_shown) => {
                        at = source_from_shown.transform_point3(at);
                        moves.push(act);
                    }
                }
            }
            if replaces || erases.is_some() {
                // Nothing is left for it to move.
                at = place;
                moves.truncate(moves_above);
            }
            is_replaced |= replaces;
            erased.extend(erases);
        }
        let met = Met { set, stack: Stack::Lenses(survivors), moves, asked };
        let closes = erased.iter().any(|closed| *closed != Closed::Not);
        match erased.first() {
            None if is_replaced => Outcome::Gone,
            None if is_open => Outcome::Open,
            _ if shown != subject.shown_by.is_some() => Outcome::Gone,
            None => Outcome::Shown(met),
            // Whether what else takes it away leaves something to close is not said.
            Some(_) if closes && (is_replaced || is_open || erased[0] == Closed::Not) => {
                Outcome::Erased(met, Closed::Open)
            }
            Some(closed) => Outcome::Erased(met, *closed),
        }
    }
}

/// What a filter does to content.
enum Effect {
    Nothing,
    Erases(Option<Cap>),
    /// Something else is shown.
    Replaces,
    Brings,
    /// What it shows at a point comes from where this leads.
    Moves(DAffine3),
}
