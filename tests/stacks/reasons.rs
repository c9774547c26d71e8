//! Why one lens is above another: each reason against what the order does when the two move in the file.
//!
//! The order of the file is what separates two lenses if they come the other way round once the lower one is listed
//! last and the upper one first, all else as it is.

use lenspeel::plan::Reason;

use crate::case::{Case, random_acyclic};
use crate::order::{distance, edges, total_order};
use crate::random::Random;

const CASES: usize = 1000;
const MOST_LENSES: usize = 7;

struct Orders<'a> {
    case: &'a Case,
    /// Declared, between enabled lenses.
    edges: Vec<(usize, usize)>,
    all: Vec<(usize, usize)>,
}

impl<'a> Orders<'a> {
    fn new(case: &'a Case) -> Self {
        let all = edges(case);
        let enabled = |lens: usize| case.lenses[lens].enabled;
        let edges = all.iter().copied().filter(|(a, b)| enabled(*a) && enabled(*b)).collect();
        Self { case, edges, all }
    }

    fn only_file_order(&self, below: usize, above: usize) -> bool {
        let mut file: Vec<usize> = (0..self.case.lenses.len()).filter(|lens| ![below, above].contains(lens)).collect();
        file.insert(0, above);
        file.push(below);
        let order = total_order(self.case, &self.all, &file);
        order.iter().position(|lens| *lens == above) < order.iter().position(|lens| *lens == below)
    }

    fn declared(&self, below: usize, above: usize) -> bool {
        self.edges.iter().any(|(a, b)| *a == below && (*b == above || self.declared(*b, above)))
    }

    fn is_farther(&self, below: usize, above: usize) -> bool {
        let at = |lens: usize| self.case.lenses[lens].flat.map(|at| distance(self.case, at));
        matches!((at(below), at(above)), (Some(low), Some(high)) if low > high)
    }

    fn index(&self, name: &str) -> usize {
        self.case.lenses.iter().position(|lens| lens.name == name).expect("reasons name lenses of the file")
    }

    /// Whether a reason is true and is what separates the two.
    fn bears(&self, reason: &Reason, below: usize, above: usize, order: &[usize]) -> bool {
        let (low, high) = (&self.case.lenses[below], &self.case.lenses[above]);
        let fixed = |below, above| !self.only_file_order(below, above);
        let declared = self.declared(below, above);
        let place = |lens: usize| order.iter().position(|other| *other == lens);
        match reason {
            Reason::Declared(chain) => {
                let ends = [chain.first().map(|e| e.2.as_str()), chain.last().map(|e| e.3.as_str())];
                let linked = chain.windows(2).all(|pair| pair[0].3 == pair[1].2);
                let edge = |a: &str, b: &str| self.edges.contains(&(self.index(a), self.index(b)));
                ends == [Some(low.name.as_str()), Some(high.name.as_str())]
                    && linked
                    && chain.iter().all(|(_, _, a, b)| edge(a, b))
            }
            Reason::Priority(a, b) => {
                !declared && fixed(below, above) && a < b && [*a, *b] == [low.priority, high.priority]
            }
            Reason::Farther(a, b) => {
                let truth = [low.flat, high.flat].map(|at| at.map(|at| distance(self.case, at)));
                let close = |a: f64, b: Option<f64>| b.is_some_and(|b| (a - b).abs() < 1e-9);
                !declared
                    && fixed(below, above)
                    && a > b
                    && close(*a, truth[0])
                    && close(*b, truth[1])
                    && low.priority == high.priority
            }
            Reason::Waited(name) => {
                let awaited = self.index(name);
                let between = place(below) < place(awaited) && place(awaited) < place(above);
                let loses =
                    low.priority > high.priority || (low.priority == high.priority && !self.is_farther(below, above));
                !declared && fixed(below, above) && between && loses && self.declared(awaited, above)
            }
            Reason::FileOrder => !declared && !fixed(below, above),
        }
    }
}

#[test]
fn reasons_are_what_separates_two_lenses() {
    let mut random = Random::new(20);
    let mut seen = [0; 5];
    for number in 0..CASES {
        let case = random_acyclic(&mut random, MOST_LENSES, 0.2);
        let (spec, plan, orders) = (case.spec(), case.plan(), Orders::new(&case));
        let order: Vec<usize> = plan.lenses.iter().map(|lens| lens.index).collect();
        for above in 0..order.len() {
            for below in 0..above {
                let reason = plan.reason(&spec, below, above);
                let (low, high) = (&plan.lenses[below], &plan.lenses[above]);
                assert!(
                    orders.bears(&reason, low.index, high.index, &order),
                    "case {number}: {} < {}: {reason:?}\n{}",
                    low.name,
                    high.name,
                    case.toml()
                );
                seen[kind(&reason)] += 1;
            }
        }
    }
    assert!(seen.iter().all(|count| *count >= 10), "some reason hardly occurs: {seen:?}");
}

fn kind(reason: &Reason) -> usize {
    match reason {
        Reason::Declared(_) => 0,
        Reason::Priority(..) => 1,
        Reason::Farther(..) => 2,
        Reason::Waited(_) => 3,
        Reason::FileOrder => 4,
    }
}

/// Negative control: of the reasons of one pair, only one kind bears.
#[test]
fn a_wrong_reason_does_not_bear() {
    let mut random = Random::new(21);
    let mut refused = 0;
    for _ in 0..50 {
        let case = random_acyclic(&mut random, MOST_LENSES, 0.2);
        let (plan, orders) = (case.plan(), Orders::new(&case));
        let order: Vec<usize> = plan.lenses.iter().map(|lens| lens.index).collect();
        let reason = |below, above| plan.reason(&case.spec(), below, above);
        for above in 1..order.len() {
            let wrong = match reason(above - 1, above) {
                Reason::FileOrder => Reason::Waited(plan.lenses[above].name.clone()),
                _ => Reason::FileOrder,
            };
            assert!(!orders.bears(&wrong, order[above - 1], order[above], &order));
            refused += 1;
        }
    }
    assert!(refused > 50);
}
