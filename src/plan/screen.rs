//! The screen-space filters of a plan: what is done to the finished picture, in stack order (SEMANTICS 5.4).

use super::{Op, Plan};
use crate::appearance as wgsl;

/// A filter's work on the pixels at which its lens, or rule, acts on what is visible.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct ScreenStep {
    /// Of the lens or rule in stacks.
    pub rank: usize,
    /// Into [`Plan::ops`].
    pub op: usize,
}

impl Plan {
    /// All steps, lowest first.
    pub fn screen_steps(&self) -> Vec<ScreenStep> {
        let ranks = 0..self.lenses.len() + self.rules.len();
        let steps = ranks.flat_map(|rank| self.ops_of(rank).map(move |op| ScreenStep { rank, op }));
        steps.filter(|step| self.ops[step.op].is_of_screen()).collect()
    }

    /// How far from a pixel all steps together look, in pixels.
    pub fn screen_reach(&self) -> u32 {
        self.screen_steps().iter().map(|step| self.ops[step.op].screen_reach()).sum()
    }
}

impl Op {
    /// How far from a pixel it looks, in pixels.
    pub fn screen_reach(&self) -> u32 {
        wgsl::screen_reach(self.shader()) as u32
    }
}
