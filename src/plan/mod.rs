//! The plan: everything a backend needs, as plain data, and the reasons for it.
//!
//! Order, contents, items and filters are decided here; a backend never sees the spec.

mod account;
mod camera;
mod decide;
mod items;
mod lenses;
mod light;
mod op;
mod order;
mod reasons;
mod regions;
mod walk;
mod warnings;

use crate::InputError;
use crate::scene::Scene;
use crate::spec::{Backfaces, Spec};
use crate::view::View;

pub use crate::lens::{LensSet, MAX_LENSES};
pub use account::{Account, Undecided};
pub use decide::{Reason, commute};
pub use items::{Content, Item};
pub use lenses::{GlassRecord, Lens};
pub use light::{LightRecord, Lighting};
pub use op::{Op, filter_name};
pub use order::{Declared, Key, PriorityGraph, Rank};
pub use reasons::Reasons;
pub use regions::Region;
pub use walk::{Verdict, survivors, walk};

/// A picture fully decided: what is seen from where, which lenses stand where, who acts in which order.
#[derive(Debug, Clone)]
pub struct Plan {
    pub view: View,
    /// Samples a pixel, a square number.
    pub samples: u32,
    /// Linear light, straight alpha.
    pub background: [f32; 4],
    /// Back faces of single-sided materials are left out.
    pub cull_backfaces: bool,
    pub lighting: Lighting,
    /// The enabled lenses in total order, lowest first: a lens's index is its rank and its bit in a [`LensSet`].
    pub lenses: Vec<Lens>,
    /// The lenses that test every fragment (`by = "pixel"`).
    pub by_pixel: LensSet,
    /// Appearance filters of all lenses; each lens has a range of them.
    pub ops: Vec<Op>,
    /// What can be drawn: the scene, then each content that some `show` names.
    pub contents: Vec<Content>,
    /// What is drawn, in the order that decides ties: by content, node, primitive.
    pub items: Vec<Item>,
    /// The middle and the longest side of the scene's bounds, for projected textures.
    pub texture_space: TextureSpace,
    /// The lenses in the order of the file, disabled ones too, with the declared edges.
    pub graph: PriorityGraph,
    /// What ranked each lens of the file.
    pub ranks: Vec<Rank>,
    /// What is allowed but hardly meant, one line each.
    pub warnings: Vec<String>,
}

/// Maps the bounds of the scene to 0..1: `(p - origin) * scale`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TextureSpace {
    pub origin: glam::Vec3,
    pub scale: f32,
}

impl Plan {
    /// Decides a spec over its opened scene. All that can be wrong with the two together is found here.
    pub fn new(spec: &Spec, scene: &Scene) -> Result<Self, InputError> {
        if let Some(rule) = spec.overlaps.first() {
            return Err(InputError::at(&spec.source, rule.when.span.clone(), "overlap rules are not built yet")
                .help("give the lenses an order with `over`, `hides` or `overlap = \"override\"` instead"));
        }
        let mut view = camera::place(spec, scene)?;
        let graph = PriorityGraph::new(spec)?;
        let volumes = lenses::volumes(spec, scene, &view)?;
        camera::fit_depths(&mut view, spec, scene, &volumes)?;
        let ranks = lenses::ranks(spec, &volumes, &view);
        let order = graph.total_order(&ranks);
        let (lenses, ops) = lenses::rank_lenses(spec, scene, &graph, &order, &volumes, &view);
        let (contents, items) = items::collect(spec, scene, &order, &lenses)?;
        Ok(Self {
            samples: spec.image.samples,
            background: spec.image.background.map_or([0.0; 4], |c| c.to_linear()),
            cull_backfaces: spec.scene.backfaces == Backfaces::AsMaterial,
            lighting: light::resolve(spec, scene, &view),
            by_pixel: (0..lenses.len()).filter(|rank| lenses[*rank].by == crate::spec::By::Pixel).collect(),
            texture_space: texture_space(scene),
            view,
            lenses,
            ops,
            contents,
            items,
            graph,
            ranks,
            warnings: warnings::collect(spec, scene),
        })
    }

    /// What the lenses do at a point of an item: `inside` are the lenses whose volume holds the point.
    pub fn walk(&self, item: &Item, inside: LensSet) -> Verdict {
        walk(&self.lenses, item, inside & self.by_pixel)
    }

    /// The appearance filters of a stack, lowest first.
    pub fn stack_ops(&self, stack: LensSet) -> impl Iterator<Item = &Op> {
        stack.iter().flat_map(|rank| &self.ops[self.lenses[rank].ops.clone()])
    }

    /// Names of a set's lenses, sorted.
    pub fn names(&self, set: LensSet) -> Vec<&str> {
        let mut names: Vec<&str> = set.iter().map(|rank| self.lenses[rank].name.as_str()).collect();
        names.sort_unstable();
        names
    }
}

fn texture_space(scene: &Scene) -> TextureSpace {
    let bounds = scene.models[0].bounds();
    if bounds.is_empty() {
        return TextureSpace { origin: glam::Vec3::ZERO, scale: 1.0 };
    }
    let side = bounds.size().max_element().max(f64::MIN_POSITIVE);
    let origin = bounds.center() - glam::DVec3::splat(0.5 * side);
    TextureSpace { origin: origin.as_vec3(), scale: (1.0 / side) as f32 }
}
