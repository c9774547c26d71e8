//! The screen-space filters of a plan: what is done to the finished picture, in stack order (SEMANTICS 5.4).

use super::{Lens, Op, Plan, Rule};
use crate::appearance as wgsl;

/// A filter's work on the pixels at which its lens, or rule, acts on what is visible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ScreenStep {
    /// Of the lens or rule in stacks.
    pub rank: usize,
    /// Into [`Plan::ops`].
    pub op: usize,
}

/// All steps, lowest first.
pub(super) fn steps(lenses: &[Lens], rules: &[Rule], ops: &[Op]) -> Vec<ScreenStep> {
    let of_ranks = lenses.iter().map(|lens| &lens.ops).chain(rules.iter().map(|rule| &rule.ops));
    let steps = of_ranks.enumerate().flat_map(|(rank, own)| own.clone().map(move |op| ScreenStep { rank, op }));
    steps.filter(|step| ops[step.op].is_of_screen()).collect()
}

impl Plan {
    /// How far from a pixel all steps together look, in pixels.
    pub fn screen_reach(&self) -> u32 {
        self.screen.iter().map(|step| self.ops[step.op].screen_reach()).sum()
    }
}

impl Op {
    /// Whether it draws lines on the finished picture; else, if it works on that, it takes means of its colours.
    pub fn draws_lines(&self) -> bool {
        [wgsl::OP_EDGES.0, wgsl::OP_ERASE.0].contains(&self.kind)
    }

    /// How many pixels of a line it reads at a time, if it takes means.
    pub fn mean_side(&self) -> u32 {
        wgsl::mean_side(self.shader()) as u32
    }

    /// How far from a pixel it looks, in pixels.
    pub fn screen_reach(&self) -> u32 {
        wgsl::screen_reach(self.shader()) as u32
    }
}
