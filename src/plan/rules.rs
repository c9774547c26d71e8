//! Overlap rules: an explicit style for chosen overlaps (SEMANTICS 4).

use std::ops::Range;

use super::op::Ops;
use super::{Item, Lens, LensSet, Op, Plan, filter_name};
use crate::InputError;
use crate::spec::{Condition, Filter, OverlapSpec, Spec, lod};

/// A rule. In stacks it stands at the rank [`Plan::rule_rank`], behind all lenses.
#[derive(Debug, Clone)]
pub struct Rule {
    /// Of its condition in the spec, from 1.
    pub line: usize,
    /// How people are told of it: "rule in line 7".
    pub name: String,
    pub when: Test,
    pub filters: Vec<Filter>,
    /// Its appearance filters in [`Plan::ops`].
    pub ops: Range<usize>,
    /// Whether its filters may make a fragment less than opaque.
    pub translucent: bool,
    /// The share of the triangles that its `lod` leaves.
    pub lod: Option<f32>,
}

/// The condition of a rule over the lenses that contain a point.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Test {
    /// One of these does. A disabled lens is in no test.
    Any(LensSet),
    Not(Box<Test>),
    And(Box<Test>, Box<Test>),
    Or(Box<Test>, Box<Test>),
}

impl Test {
    pub fn holds(&self, set: LensSet) -> bool {
        match self {
            Test::Any(lenses) => !(*lenses & set).is_empty(),
            Test::Not(inner) => !inner.holds(set),
            Test::And(left, right) => left.holds(set) && right.holds(set),
            Test::Or(left, right) => left.holds(set) || right.holds(set),
        }
    }

    fn new(condition: &Condition, lenses: &[Lens]) -> Self {
        let boxed = |inner: &Condition| Box::new(Self::new(inner, lenses));
        match condition {
            Condition::Lens(pattern) => {
                Test::Any((0..lenses.len()).filter(|rank| pattern.value.matches(&lenses[*rank].name)).collect())
            }
            Condition::Not(inner) => Test::Not(boxed(inner)),
            Condition::And(left, right) => Test::And(boxed(left), boxed(right)),
            Condition::Or(left, right) => Test::Or(boxed(left), boxed(right)),
        }
    }
}

/// How people are told of a rule, by the place of its condition.
pub(super) fn name(spec: &Spec, rule: &OverlapSpec) -> String {
    format!("rule in {}", spec.source.spot(rule.when.span.start))
}

/// The rules of a spec in their order, their filters behind those of the lenses.
pub(super) fn collect(spec: &Spec, lenses: &[Lens], ops: &mut Ops) -> Result<Vec<Rule>, InputError> {
    let rule = |rule: &OverlapSpec| {
        let own = ops.append(&rule.filters)?;
        let filters: Vec<Filter> = rule.filters.iter().map(|f| f.value.clone()).collect();
        Ok(Rule {
            line: spec.source.line(rule.when.span.start),
            name: name(spec, rule),
            when: Test::new(&rule.when.value, lenses),
            translucent: ops.list[own.clone()].iter().any(Op::may_be_translucent),
            ops: own,
            lod: lod(filters.iter()),
            filters,
        })
    };
    spec.overlaps.iter().map(rule).collect()
}

impl Plan {
    /// The rank at which a rule stands in stacks.
    pub fn rule_rank(&self, rule: usize) -> usize {
        self.lenses.len() + rule
    }

    /// The rule of a rank, or `None` for a lens.
    pub fn rule_of(&self, rank: usize) -> Option<usize> {
        rank.checked_sub(self.lenses.len())
    }

    /// All filters of a lens or rule of a stack, first to act first.
    pub fn filters_of(&self, rank: usize) -> &[Filter] {
        match self.rule_of(rank) {
            Some(rule) => &self.rules[rule].filters,
            None => &self.lenses[rank].filters,
        }
    }

    /// Names of the filters of a lens or rule of a stack.
    pub fn filter_names(&self, rank: usize) -> impl Iterator<Item = &'static str> + '_ {
        self.filters_of(rank).iter().map(filter_name)
    }

    /// The name of the lens or rule that a filter's record belongs to.
    pub fn actor_of_op(&self, op: usize) -> &str {
        let lenses = self.lenses.iter().map(|lens| (&lens.ops, &lens.name));
        let mut all = lenses.chain(self.rules.iter().map(|rule| (&rule.ops, &rule.name)));
        all.find(|(ops, _)| ops.contains(&op)).map_or("", |(_, name)| name)
    }

    /// Into [`Plan::ops`]: the appearance filters of a lens or rule of a stack.
    pub fn ops_of(&self, rank: usize) -> Range<usize> {
        match self.rule_of(rank) {
            Some(rule) => self.rules[rule].ops.clone(),
            None => self.lenses[rank].ops.clone(),
        }
    }

    /// The lenses and rules whose filters may make a fragment less than opaque.
    pub fn translucent(&self) -> LensSet {
        let lenses = (0..self.lenses.len()).filter(|rank| self.lenses[*rank].translucent);
        let rules = (0..self.rules.len()).filter(|rule| self.rules[*rule].translucent);
        lenses.chain(rules.map(|rule| self.rule_rank(rule))).collect()
    }

    /// The share of the triangles that a lens or rule of a stack leaves of what its `lod` acts on.
    pub fn lod_of(&self, rank: usize) -> Option<f32> {
        match self.rule_of(rank) {
            Some(rule) => self.rules[rule].lod,
            None => self.lenses[rank].lod,
        }
    }

    /// The lenses and rules that let a simplified version be seen.
    pub fn simplifying_to(&self, item: &Item) -> LensSet {
        item.simplified_by.iter().filter(|rank| self.lod_of(*rank) == Some(item.ratio)).collect()
    }

    /// The ranks that stand for rules.
    pub fn rule_ranks(&self) -> LensSet {
        LensSet::below(self.lenses.len() + self.rules.len()).minus(LensSet::below(self.lenses.len()))
    }

    /// The lenses and rules that may take fragments of an item in place away, or make them less than opaque.
    pub fn altering(&self, item: &Item) -> LensSet {
        item.removed_by | item.movers | item.simplified_by | (self.translucent() & (item.scope | self.rule_ranks()))
    }
}
