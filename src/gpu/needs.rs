//! What the shaders of a plan must be able to do.

use super::cells::{has_planes, is_convex};
use super::program::condition;
use crate::appearance::FILTERS;
use crate::lens::{Form, Tree, Volume};
use crate::plan::{Item, Op, Plan};
use crate::scene::{Primitive, Scene};

/// So few convex parts a fragment asks sooner than it looks up layers that had to be found first.
const FEW_PARTS: usize = 2;

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
    /// There are rules.
    pub rules: bool,
    /// Rays are cut into layers, as a pixel may ask for the lenses around many depths. Else fragments ask the lenses of their
    /// tile themselves.
    pub layers: bool,
    /// Some lens takes something away, or shows something.
    pub taken_away: bool,
    /// Some lens has several parts or a mesh.
    pub compounds: bool,
    /// Some part of a lens is a sphere, a cone, a capsule, an intersection of half-spaces.
    pub forms: [bool; 4],
    /// Some lens moves content.
    pub movers: bool,
    /// Some lens shows simplified versions.
    pub versions: bool,
    /// Some lens closes what it cuts.
    pub caps: bool,
    /// Some lens is soft.
    pub soft: bool,
    /// Some lens has a surface of its own.
    pub glass: bool,
    /// Some lens draws a line where its surface meets the scene.
    pub contact: bool,
    /// Something may be seen through something else.
    pub translucent: bool,
    /// Some material or filter has a texture.
    pub textures: bool,
    /// Some primitive has colours of its own.
    pub vertex_colors: bool,
    /// How many there are.
    pub lights: u32,
    /// Some filter acts on surfaces before they are lit, on lit colours, on coverage.
    pub stages: [bool; 3],
    /// Bit i: there is a filter of the number i.
    pub filters: u64,
    /// Some filter reads a quantity of the surface.
    pub quantities: bool,
    /// Some filter has wires that nearer surfaces hide.
    pub hidden_lines: bool,
    /// The scene reaches very far beyond what is seen: see [`View::is_wide`](crate::view::View::is_wide).
    pub wide: bool,
    /// How many numbers at vertices filters read.
    pub channels: u32,
    /// Some filter works on the finished picture.
    pub screen: bool,
    /// Some triangles have their depths from their planes.
    pub planes: bool,
    /// Regions, opacities and normals are asked for instead of colours.
    pub accounts: bool,
}

impl Needs {
    /// `planes`: whether some triangles have their depths from their planes.
    pub fn of(scene: &Scene, plan: &Plan, planes: bool) -> Self {
        let words = |bits: usize| bits.div_ceil(32).max(1) as u32;
        let parts = plan.lenses.iter().map(|lens| lens.volume.parts.len());
        let names = plan.rules.iter().map(|rule| condition(&rule.when).0.len());
        let translucent = plan.items.iter().any(|item| item.translucent) || !plan.translucent().is_empty();
        let glass = plan.lenses.iter().any(|lens| lens.glass.is_some());
        let compounds = plan.lenses.iter().any(|lens| !is_one_convex_part(&lens.volume));
        let takes_away = |item: &Item| !(item.removed_by | item.shown_by | item.movers | item.simplified_by).is_empty();
        let taken_away = plan.items.iter().any(takes_away);
        let all_parts: usize = plan.lenses.iter().map(|lens| lens.volume.parts.len()).sum();
        let caps = !plan.bodies.is_empty();
        let asks_often =
            translucent || caps || (glass && compounds) || (taken_away && (compounds || all_parts > FEW_PARTS));
        Self {
            set_words: words(plan.lenses.len() + plan.rules.len()),
            part_words: words(parts.chain(names).max().unwrap_or(1)),
            lenses: !plan.lenses.is_empty() || !plan.rules.is_empty(),
            rules: !plan.rules.is_empty(),
            layers: asks_often,
            taken_away,
            compounds,
            forms: has_forms(plan),
            movers: plan.items.iter().any(|item| !item.movers.is_empty()),
            versions: plan.items.iter().any(Item::is_simplified),
            caps,
            soft: plan.lenses.iter().any(|lens| lens.soft > 0.0),
            glass,
            contact: plan.lenses.iter().filter_map(|lens| lens.glass).any(|glass| glass.contact > 0.0),
            translucent,
            textures: !scene.textures.textures.is_empty(),
            vertex_colors: primitives(scene).any(|p| p.colors.is_some()),
            lights: plan.lighting.lights.len() as u32,
            stages: [0, 1, 2].map(|stage| plan.ops.iter().any(|op| op.acts_in(stage))),
            filters: plan.ops.iter().fold(0, |all, op| all | filter_bits(op)),
            quantities: plan.ops.iter().any(Op::reads_quantity),
            hidden_lines: plan.ops.iter().any(Op::hides_lines),
            wide: plan.view.is_wide(),
            channels: plan.channels.len() as u32,
            screen: !plan.screen.is_empty(),
            planes,
            accounts: false,
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
            layers: false,
            taken_away: false,
            compounds: false,
            forms: [false; 4],
            movers: false,
            versions: false,
            caps: false,
            soft: false,
            glass: false,
            contact: false,
            stages: [false; 3],
            filters: 0,
            quantities: false,
            hidden_lines: false,
            translucent: plan.items.iter().any(|item| item.translucent),
            ..self
        }
    }

    /// The same for maps and accounts, which tell where things are and not what colours they have.
    pub fn for_accounts(self) -> Self {
        let [surface, _, coverage] = self.stages;
        Self {
            accounts: true,
            lights: 0,
            stages: [surface, false, coverage],
            glass: false,
            contact: false,
            screen: false,
            ..self
        }
    }

    /// The constants that the shaders ask.
    pub fn wgsl(&self) -> String {
        let Self { set_words, part_words, lights, channels, .. } = self;
        let flags = [
            ("LENSES", self.lenses),
            ("RULES", self.rules),
            ("LAYERS", self.layers),
            ("TAKEN_AWAY", self.taken_away),
            ("COMPOUNDS", self.compounds),
            ("SPHERES", self.forms[0]),
            ("CONES", self.forms[1]),
            ("CAPSULES", self.forms[2]),
            ("HALF_SPACES", self.forms[3]),
            ("MOVERS", self.movers),
            ("VERSIONS", self.versions),
            ("CAPS", self.caps),
            ("SOFT", self.soft),
            ("GLASS", self.glass),
            ("CONTACT", self.contact),
            ("TRANSLUCENT", self.translucent),
            ("TEXTURES", self.textures),
            ("VERTEX_COLORS", self.vertex_colors),
            ("SURFACE_FILTERS", self.stages[0]),
            ("COLOR_FILTERS", self.stages[1]),
            ("COVERAGE_FILTERS", self.stages[2]),
            ("QUANTITIES", self.quantities),
            ("HIDDEN_LINES", self.hidden_lines),
            ("WIDE", self.wide),
            ("SCREEN", self.screen),
            ("PLANES", self.planes),
            ("ACCOUNTS", self.accounts),
        ];
        let filters = FILTERS.iter().enumerate().map(|(number, filter)| {
            let (name, has) = (filter.name.to_uppercase(), self.filters >> number & 1 != 0);
            format!("const HAS_{name}: bool = {has};\n")
        });
        let flags = flags.map(|(name, value)| format!("const {name}: bool = {value};\n")).concat();
        let channels = &(*channels).max(1);
        let counts = [("WORDS", set_words), ("PART_WORDS", part_words), ("LIGHTS", lights), ("CHANNELS", channels)];
        let counts = counts.map(|(name, value)| format!("const {name}: u32 = {value}u;\n")).concat();
        counts + &flags + &filters.collect::<String>()
    }
}

/// Filters of a few instructions, which are not worth a variant each.
const SMALL: [&str; 8] = ["brightness", "grayscale", "invert", "material", "normals", "opacity", "tint", "unlit"];

fn filter_bits(op: &Op) -> u64 {
    let bit = |name: &str| FILTERS.iter().position(|filter| filter.name == name).map_or(0, |number| 1 << number);
    if SMALL.contains(&FILTERS[op.kind as usize].name) {
        return SMALL.iter().fold(0, |all, name| all | bit(name));
    }
    1 << op.kind
}

fn primitives(scene: &Scene) -> impl Iterator<Item = &Primitive> {
    scene.models.iter().flat_map(|model| &model.meshes).flat_map(|mesh| &mesh.primitives)
}

fn is_one_convex_part(volume: &Volume) -> bool {
    matches!(volume.tree, Tree::Part(part) if is_convex(&volume.parts[part].form))
}

fn has_forms(plan: &Plan) -> [bool; 4] {
    let mut found = [false; 4];
    for solid in plan.lenses.iter().flat_map(|lens| &lens.volume.parts) {
        match &solid.form {
            Form::Sphere => found[0] = true,
            Form::Cone { .. } => found[1] = true,
            Form::Capsule { .. } => found[2] = true,
            Form::HalfSpaces { .. } => found[3] = true,
            Form::Mesh(mesh) => found[3] |= has_planes(mesh),
            Form::Empty => {}
        }
    }
    found
}
