//! What the shaders of a plan must be able to do.

use super::program::condition;
use crate::plan::Plan;
use crate::scene::Scene;

/// Shaders are compiled for it: what a plan does not need costs it nothing. Where things are makes no difference, so
/// moving a lens or the camera compiles nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Needs {
    /// 32-bit words of a set of lenses and rules.
    pub set_words: u32,
    /// Words of a set of the parts of one lens, or of the names in the condition of one rule.
    pub part_words: u32,
    /// There are lenses or rules.
    pub lenses: bool,
    /// Some lens has several parts or a mesh.
    pub compounds: bool,
    /// Some lens moves content.
    pub movers: bool,
    /// Some lens is soft.
    pub soft: bool,
    /// Some lens has a surface of its own.
    pub glass: bool,
    /// Something may be seen through something else.
    pub translucent: bool,
    /// Some material or filter has a texture.
    pub textures: bool,
}

impl Needs {
    pub fn of(scene: &Scene, plan: &Plan) -> Self {
        let words = |bits: usize| bits.div_ceil(32).max(1) as u32;
        let parts = plan.lenses.iter().map(|lens| lens.volume.parts.len());
        let names = plan.rules.iter().map(|rule| condition(&rule.when).0.len());
        let item_is_translucent = plan.items.iter().any(|item| item.translucent);
        Self {
            set_words: words(plan.lenses.len() + plan.rules.len()),
            part_words: words(parts.chain(names).max().unwrap_or(1)),
            lenses: !plan.lenses.is_empty() || !plan.rules.is_empty(),
            compounds: plan.lenses.iter().any(|lens| lens.volume.lone().is_none()),
            movers: plan.items.iter().any(|item| !item.movers.is_empty()),
            soft: plan.lenses.iter().any(|lens| lens.soft > 0.0),
            glass: plan.lenses.iter().any(|lens| lens.glass.is_some()),
            translucent: item_is_translucent || !plan.translucent().is_empty(),
            textures: !scene.textures.textures.is_empty(),
        }
    }

    /// The same for pixels of tiles that no lens touches, of the same plan.
    pub fn outside(self, plan: &Plan) -> Self {
        // Rules, and lenses that take whole objects, act anywhere.
        if !plan.rules.is_empty() || plan.items.iter().any(|item| !item.object.is_empty()) {
            return self;
        }
        Self {
            part_words: 1,
            lenses: false,
            compounds: false,
            movers: false,
            soft: false,
            glass: false,
            translucent: plan.items.iter().any(|item| item.translucent),
            ..self
        }
    }

    /// The same for accounts and maps, which are not worth a variant for every plan that does not need everything.
    pub fn for_accounts(self) -> Self {
        Self { lenses: true, glass: true, translucent: true, textures: true, ..self }
    }

    /// The constants that the shaders ask.
    pub fn wgsl(&self) -> String {
        let Self { set_words, part_words, .. } = self;
        let flags = [
            ("LENSES", self.lenses),
            ("COMPOUNDS", self.compounds),
            ("MOVERS", self.movers),
            ("SOFT", self.soft),
            ("GLASS", self.glass),
            ("TRANSLUCENT", self.translucent),
            ("TEXTURES", self.textures),
        ];
        let flags = flags.map(|(name, value)| format!("const {name}: bool = {value};\n")).concat();
        format!("const WORDS: u32 = {set_words}u;\nconst PART_WORDS: u32 = {part_words}u;\n{flags}")
    }
}
