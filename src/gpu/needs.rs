//! What the shaders of a plan must be able to do.

use super::program::condition;
use crate::plan::Plan;

/// Shaders are compiled for it: what a plan does not need costs it nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Needs {
    /// 32-bit words of a set of lenses and rules.
    pub set_words: u32,
    /// Words of a set of the parts of one lens, or of the names in the condition of one rule.
    pub part_words: u32,
    /// Some lens has several parts or a mesh.
    pub compounds: bool,
    /// Some lens moves content.
    pub movers: bool,
    /// Some lens is soft.
    pub soft: bool,
}

impl Needs {
    pub fn of(plan: &Plan) -> Self {
        let words = |bits: usize| bits.div_ceil(32).max(1) as u32;
        let parts = plan.lenses.iter().map(|lens| lens.volume.parts.len());
        let names = plan.rules.iter().map(|rule| condition(&rule.when).0.len());
        Self {
            set_words: words(plan.lenses.len() + plan.rules.len()),
            part_words: words(parts.chain(names).max().unwrap_or(1)),
            compounds: plan.lenses.iter().any(|lens| lens.volume.lone().is_none()),
            movers: plan.items.iter().any(|item| !item.movers.is_empty()),
            soft: plan.lenses.iter().any(|lens| lens.soft > 0.0),
        }
    }

    /// The constants that the shaders ask.
    pub fn wgsl(&self) -> String {
        let Self { set_words, part_words, compounds, movers, soft } = self;
        format!(
            "const WORDS: u32 = {set_words}u;\nconst PART_WORDS: u32 = {part_words}u;\n\
             const COMPOUNDS: bool = {compounds};\nconst MOVERS: bool = {movers};\nconst SOFT: bool = {soft};\n"
        )
    }
}
