//! The reasons of many pairs of lenses, each worked out once.

use std::cell::RefCell;
use std::collections::HashMap;
use std::rc::Rc;

use super::{LensSet, Plan, Reason, Region};
use crate::spec::Spec;

/// A pair of ranks, the lower first.
type Pair = (usize, usize);

/// Tells why one lens is above another, and remembers it.
pub struct Reasons<'a> {
    spec: &'a Spec,
    plan: &'a Plan,
    /// For each rank: those that chains of declared edges put above it.
    uppers: Vec<LensSet>,
    file_order: RefCell<HashMap<Pair, bool>>,
    known: RefCell<HashMap<Pair, Rc<Reason>>>,
}

/// A lens of a region that does not act there.
pub struct Hidden<'a> {
    pub lens: &'a str,
    pub by: &'a str,
    /// The one that hides it overrides everything below it.
    pub overridden: bool,
    /// Why the one that hides it is above it.
    pub because: Rc<Reason>,
}

/// Two neighbours of a stack.
pub struct Neighbours<'a> {
    pub below: &'a str,
    pub above: &'a str,
    pub because: Rc<Reason>,
}

impl<'a> Reasons<'a> {
    pub fn new(spec: &'a Spec, plan: &'a Plan) -> Self {
        let (file_order, known) = Default::default();
        Self { spec, plan, uppers: uppers(plan), file_order, known }
    }

    /// Why the lens of rank `below` is below the lens of rank `above`.
    pub fn between(&self, below: usize, above: usize) -> Rc<Reason> {
        if let Some(reason) = self.known.borrow().get(&(below, above)) {
            return reason.clone();
        }
        let reason = Rc::new(self.find(below, above));
        self.known.borrow_mut().insert((below, above), reason.clone());
        reason
    }

    fn find(&self, below: usize, above: usize) -> Reason {
        if let Some(chain) = self.declared(below, above) {
            return chain;
        }
        if self.only_file_order(below, above) {
            return Reason::FileOrder;
        }
        let rank_of = |rank: usize| &self.plan.ranks[self.plan.lenses[rank].index];
        let (a, b) = (rank_of(below), rank_of(above));
        if a.priority < b.priority {
            return Reason::Priority(a.priority, b.priority);
        }
        if let (Some(far), Some(near), true) = (a.flat, b.flat, a.priority == b.priority)
            && far > near
        {
            return Reason::Farther(far, near);
        }
        // Taken by itself the upper one would go first, but it has to wait for a lens that comes after the lower.
        let awaited = || (below + 1..above).filter(|rank| self.uppers[*rank].contains(above));
        let by_more_than_file = awaited().find(|rank| !self.only_file_order(below, *rank));
        match by_more_than_file.or_else(|| awaited().next()) {
            Some(rank) => Reason::Waited(self.plan.lenses[rank].name.clone()),
            None => Reason::FileOrder,
        }
    }

    fn declared(&self, below: usize, above: usize) -> Option<Reason> {
        if !self.uppers[below].contains(above) {
            return None;
        }
        let index = |rank: usize| self.plan.lenses[rank].index;
        let name = |index: usize| self.spec.lenses[index].name.value.clone();
        let chain = self.plan.graph.chain(index(below), index(above), &self.plan.ranks)?;
        let edges = chain.into_iter().map(|(a, b, declared)| {
            (declared.key.name(), self.spec.source.spot(declared.span.start), name(a), name(b))
        });
        Some(Reason::Declared(edges.collect()))
    }

    /// Whether the lens of rank `below` is below the other for no better reason than where they stand in the file.
    pub fn only_file_order(&self, below: usize, above: usize) -> bool {
        // Whatever the file's order, what is declared stays.
        if self.uppers[below].contains(above) {
            return false;
        }
        *self.file_order.borrow_mut().entry((below, above)).or_insert_with(|| self.plan.only_file_order(below, above))
    }

    /// The lenses of a region that do not act there.
    pub fn hidden(&self, region: &Region) -> impl Iterator<Item = Hidden<'a>> {
        let plan = self.plan;
        region.hidden(plan).into_iter().map(move |(lens, by)| Hidden {
            lens: &plan.lenses[lens].name,
            by: &plan.lenses[by].name,
            overridden: plan.lenses[by].overrides,
            because: self.between(lens, by),
        })
    }

    /// The neighbours of a stack, lowest first.
    pub fn neighbours(&self, stack: LensSet) -> impl Iterator<Item = Neighbours<'a>> {
        let name = |rank: usize| self.plan.lenses[rank].name.as_str();
        stack.iter().zip(stack.iter().skip(1)).map(move |(below, above)| Neighbours {
            below: name(below),
            above: name(above),
            because: self.between(below, above),
        })
    }

    /// Who is hidden in a region and why the others stand as they do, a line each after `indent`.
    pub fn lines(&self, region: &Region, indent: &str) -> String {
        let hidden = self.hidden(region).map(|Hidden { lens, by, overridden, because }| {
            let how = if overridden { "overrides it" } else { "hides it" };
            format!("{indent}hidden: {lens}, for {by} {how} ({because})\n")
        });
        let order = self.neighbours(region.stack).map(|n| {
            let Neighbours { below, above, because } = n;
            format!("{indent}{below} < {above}: {because}\n")
        });
        hidden.chain(order).collect()
    }
}

/// For each rank of a plan: those that chains of declared edges put above it.
fn uppers(plan: &Plan) -> Vec<LensSet> {
    let graph = &plan.graph.graph;
    let mut rank_of = vec![None; graph.node_count()];
    plan.lenses.iter().enumerate().for_each(|(rank, lens)| rank_of[lens.index] = Some(rank));
    let mut uppers = vec![LensSet::EMPTY; plan.lenses.len()];
    // Edges go up the order, so what is above a lens is known before the lens is met.
    for (rank, lens) in plan.lenses.iter().enumerate().rev() {
        for upper in graph.neighbors(petgraph::graph::NodeIndex::new(lens.index)) {
            if let Some(upper) = rank_of[upper.index()] {
                uppers[rank].insert(upper);
                uppers[rank] = uppers[rank] | uppers[upper];
            }
        }
    }
    uppers
}
