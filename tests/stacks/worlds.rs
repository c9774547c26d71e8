//! Sections 4 and 5 of SEMANTICS, read literally: a chain of worlds at one point.

use lenspeel::spec::Pattern;

use crate::case::{ALTERNATES, Act, Case, HIDDEN, LensCase, MATERIALS, NODES, NodeRow, Patterns};

/// What a fragment is part of.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    Scene,
    Alternate(usize),
    /// Of `show` with the nodes of this pattern.
    Nodes(&'static str),
}

impl Origin {
    pub fn rows(self) -> &'static [NodeRow] {
        match self {
            Origin::Alternate(i) => ALTERNATES[i].1,
            Origin::Scene | Origin::Nodes(_) => &NODES,
        }
    }

    fn of(act: &Act) -> Option<Self> {
        match act {
            Act::ShowAlternate(i) => Some(Origin::Alternate(*i)),
            Act::ShowNode(pattern) => Some(Origin::Nodes(pattern)),
            Act::Tint | Act::Erase(_) => None,
        }
    }
}

/// A surface sample, of one node, at the point.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Fragment {
    pub origin: Origin,
    pub node: usize,
}

impl Fragment {
    /// Section 2.7: by its node's name, any ancestor's, or its material's.
    fn matches(&self, patterns: &Patterns) -> bool {
        let rows = self.origin.rows();
        let material = MATERIALS[rows[self.node].2.expect("fragments have a surface")];
        let matches = |pattern: &&str, name: &str| Pattern::new(*pattern).matches(name);
        under(rows, self.node).any(|name| patterns.nodes.iter().any(|p| matches(p, name)))
            || patterns.materials.iter().any(|p| matches(p, material))
    }

    fn is_in_scope(&self, lens: &LensCase) -> bool {
        let unlimited = lens.only.nodes.is_empty() && lens.only.materials.is_empty();
        (unlimited || self.matches(&lens.only)) && !self.matches(&lens.except)
    }

    /// Whether its content has it at all.
    pub fn exists(&self) -> bool {
        let rows = self.origin.rows();
        let named = |wanted: &str| under(rows, self.node).any(|name| Pattern::new(wanted).matches(name));
        rows[self.node].2.is_some()
            && match self.origin {
                Origin::Scene => !named(HIDDEN),
                Origin::Alternate(_) => true,
                Origin::Nodes(pattern) => named(pattern),
            }
    }
}

/// The names of a node and all its ancestors.
fn under(rows: &'static [NodeRow], node: usize) -> impl Iterator<Item = &'static str> {
    std::iter::successors(Some(node), |n| rows[*n].1).map(|n| rows[n].0)
}

/// A fragment in some world: who brought it in (place in the order), and who has acted on it so far.
#[derive(Debug, Clone)]
struct Copy {
    fragment: Fragment,
    shown_by: Option<usize>,
    stack: Vec<usize>,
}

/// What a displayed fragment carries, as positions in the file, lowest of the order first.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Displayed {
    pub set: Vec<usize>,
    pub stack: Vec<usize>,
}

/// The point: which lenses (by position in the file) hold it, the order, and the direct pairs of `hides`.
pub struct Point<'a> {
    pub case: &'a Case,
    pub order: &'a [usize],
    pub inside: &'a dyn Fn(usize) -> bool,
    pub hides: &'a dyn Fn(usize, usize) -> bool,
}

impl Point<'_> {
    fn lens(&self, place: usize) -> &LensCase {
        &self.case.lenses[self.order[place]]
    }

    /// Section 2.6 and 2.7: whether the lens at a place of the order is there for this copy.
    fn applies(&self, place: usize, copy: &Copy) -> bool {
        let lens = self.lens(place);
        let holds = match lens.by_object {
            true => lens.flat.is_none() && (lens.nodes.0..=lens.nodes.1).contains(&copy.fragment.node),
            false => (self.inside)(self.order[place]),
        };
        holds && (copy.shown_by == Some(place) || copy.fragment.is_in_scope(lens))
    }

    /// Section 4: the places of the lenses that survive, for this copy.
    fn survivors(&self, copy: &Copy) -> Vec<usize> {
        let mut survivors: Vec<usize> = Vec::new();
        for place in (0..self.order.len()).rev().filter(|place| self.applies(*place, copy)) {
            let hidden = survivors
                .iter()
                .any(|above| self.lens(*above).overrides || (self.hides)(self.order[*above], self.order[place]));
            if !hidden {
                survivors.push(place);
            }
        }
        survivors
    }

    /// Section 5: world after world, then what the last one has of a fragment.
    pub fn displayed(&self, fragment: Fragment) -> Option<Displayed> {
        let mut world: Vec<Copy> = Vec::new();
        if fragment.origin == Origin::Scene && fragment.exists() {
            world.push(Copy { fragment, shown_by: None, stack: Vec::new() });
        }
        for place in 0..self.order.len() {
            world = self.lay_over(place, world, fragment);
        }
        // Two lenses may both show it, one outside the other's scope: of equal copies the one of the upper is seen.
        let copy = world.into_iter().max_by_key(|copy| copy.shown_by)?;
        let set = (0..self.order.len()).filter(|place| self.applies(*place, &copy)).map(|p| self.order[p]).collect();
        Some(Displayed { set, stack: copy.stack.iter().map(|place| self.order[*place]).collect() })
    }

    /// What the filters of one lens, the first listed first, make of the world below; only copies of `candidate` matter.
    fn lay_over(&self, place: usize, world: Vec<Copy>, candidate: Fragment) -> Vec<Copy> {
        let reaches = |copy: &Copy| self.survivors(copy).contains(&place);
        let (mut inside, outside): (Vec<Copy>, Vec<Copy>) = world.into_iter().partition(reaches);
        inside.iter_mut().for_each(|copy| copy.stack.push(place));
        for act in &self.lens(place).acts {
            match act {
                Act::Tint => {}
                Act::Erase(patterns) => {
                    let everything = patterns.nodes.is_empty() && patterns.materials.is_empty();
                    inside.retain(|copy| !everything && !copy.fragment.matches(patterns));
                }
                Act::ShowAlternate(_) | Act::ShowNode(_) => {
                    inside.clear();
                    if Origin::of(act) == Some(candidate.origin) && candidate.exists() {
                        inside.extend(self.shown(place, candidate));
                    }
                }
            }
        }
        inside.extend(outside);
        inside
    }

    /// Content brought in by a lens that survives for it: the appearance filters of the lower survivors act on it.
    fn shown(&self, place: usize, fragment: Fragment) -> Option<Copy> {
        let mut copy = Copy { fragment, shown_by: Some(place), stack: Vec::new() };
        let survivors = self.survivors(&copy);
        copy.stack = survivors.iter().rev().copied().filter(|below| *below <= place).collect();
        survivors.contains(&place).then_some(copy)
    }
}
