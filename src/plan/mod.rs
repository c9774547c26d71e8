//! The plan: everything a backend needs, as plain data, and the reasons for it.
//!
//! Order, contents, items and filters are decided here; a backend never sees the spec.

mod account;
mod anchor;
mod camera;
mod caps;
mod decide;
mod instances;
mod items;
mod lenses;
mod light;
mod op;
mod order;
mod own;
mod reasons;
mod regions;
mod rules;
mod screen;
mod walk;
mod warnings;

use std::sync::Arc;

use crate::InputError;
use crate::appearance as wgsl;
use crate::custom::Custom;
use crate::scene::{Coincident, Scene, SceneId};
use crate::spec::{Backfaces, Spec, ToneMapping};
use crate::view::View;

pub use crate::lens::{LensSet, MAX_LENSES, MAX_RULES};
pub use account::{Account, Undecided};
pub use caps::{Body, Closing, Member};
pub use decide::{Reason, commute};
pub use instances::{Instance, Step};
pub use items::{Content, Item, ItemCap, Selection};
pub use lenses::{GlassRecord, Lens};
pub use light::{LightRecord, Lighting};
pub use op::{LegendEntry, LegendLook, Op, filter_name};
pub use order::{Declared, Key, PriorityGraph, Rank};
pub use own::OwnSurface;
pub use reasons::Reasons;
pub use regions::{Ended, Region, RegionSearch};
pub use rules::{Rule, Test};
pub use screen::ScreenStep;
pub use walk::{Verdict, survivors};

/// A picture fully decided: what is seen from where, which lenses stand where, who acts in which order.
#[derive(Debug, Clone)]
pub struct Plan {
    /// The scene that it was made for.
    pub scene: SceneId,
    pub view: View,
    /// Samples a pixel, a square number.
    pub samples: u32,
    /// Linear light, straight alpha.
    pub background: [f32; 4],
    /// `TONE_...` of the shaders: how colours brighter than the picture can show are brought into it.
    pub tone_mapping: u32,
    /// Back faces of single-sided materials are left out.
    pub cull_backfaces: bool,
    pub lighting: Lighting,
    /// The enabled lenses in total order, lowest first: a lens's index is its rank and its bit in a [`LensSet`].
    pub lenses: Vec<Lens>,
    /// The lenses that test every fragment (`by = "pixel"`).
    pub by_pixel: LensSet,
    /// The overlap rules in the order of the file.
    pub rules: Vec<Rule>,
    /// Appearance filters of all lenses and rules; each has a range of them.
    pub ops: Vec<Op>,
    /// The work on the finished picture, lowest first.
    pub screen: Vec<ScreenStep>,
    /// Names of the numbers at vertices that filters read: of [`Primitive::values`](crate::scene::Primitive::values).
    pub channels: Vec<String>,
    /// The files of the user's own filters, by the numbers that their records have.
    pub customs: Vec<Arc<Custom>>,
    /// The values of their parameters, one filter's after the other's.
    pub custom_words: Vec<u32>,
    /// What false colours and contour lines stand for, in the order of their filters.
    pub legend: Vec<LegendEntry>,
    /// Whether the picture tells so.
    pub has_legend: bool,
    /// What can be drawn: the scene, then each content that some `show` names.
    pub contents: Vec<Content>,
    /// What is drawn, in the order that decides ties: by content, node, primitive.
    pub items: Vec<Item>,
    /// Every way in which an item may be seen: all items in place, in their order, then those that lenses move.
    pub instances: Vec<Instance>,
    /// The triangles of each item that lie over others in one plane, in place.
    pub coincident: Arc<Coincident>,
    /// The nodes that erasers with `cap` may cut. Where several have a cap at one boundary, the first of them here has it.
    pub bodies: Vec<Body>,
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
    pub origin: glam::DVec3,
    pub scale: f32,
}

impl Plan {
    /// Decides a spec over its opened scene. All that can be wrong with the two together is found here.
    pub fn new(spec: &Spec, scene: &Scene) -> Result<Self, InputError> {
        scene.bound_comparisons(spec)?;
        let mut view = camera::place(spec, scene)?;
        let graph = PriorityGraph::new(spec)?;
        let volumes = lenses::volumes(spec, scene, &view)?;
        let ranks = lenses::ranks(spec, &volumes, &view);
        let order = graph.total_order(&ranks);
        camera::fit_depths(&mut view, spec, scene, &volumes, &order)?;
        let mut ops = op::Ops::new(spec, scene, &view);
        let lenses = lenses::rank_lenses(spec, &graph, &order, &volumes, &mut ops)?;
        let rules = rules::collect(spec, &lenses, &mut ops)?;
        let op::Ops { list: ops, channels, customs, custom_words, legend, .. } = ops;
        let (contents, mut items) = items::collect(spec, scene, &order, &lenses, &rules)?;
        let mut warnings = warnings::collect(spec, scene);
        warnings.extend(graph.idle_cycles(spec));
        warnings.extend(caps::check(spec, scene, &lenses, &mut items));
        warnings.extend(warnings::of_lods(spec, &lenses, &rules, &items));
        let instances = instances::collect(&items, &lenses, scene, &view)?;
        warnings.extend(warnings::of_reach(spec, &lenses, &items, &instances));
        let coincident = items::coincident(&items, scene);
        warnings.extend(warnings::of_coincident(&coincident));
        Ok(Self {
            scene: scene.id,
            samples: spec.image.samples,
            tone_mapping: match spec.image.tone_mapping {
                ToneMapping::None => wgsl::TONE_NONE.0,
                ToneMapping::Neutral => wgsl::TONE_NEUTRAL.0,
            },
            background: spec.image.background.map_or([0.0; 4], |c| c.to_linear()),
            cull_backfaces: spec.scene.backfaces == Backfaces::AsMaterial,
            lighting: light::resolve(spec, scene, &view),
            by_pixel: (0..lenses.len()).filter(|rank| lenses[*rank].by == crate::spec::By::Pixel).collect(),
            texture_space: texture_space(scene),
            view,
            bodies: caps::bodies(scene, &items, &instances),
            screen: screen::steps(&lenses, &rules, &ops),
            coincident,
            lenses,
            rules,
            ops,
            channels,
            customs,
            custom_words,
            legend,
            has_legend: spec.image.legend,
            contents,
            items,
            instances,
            graph,
            ranks,
            warnings,
        })
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
        return TextureSpace { origin: glam::DVec3::ZERO, scale: 1.0 };
    }
    let side = bounds.size().max_element().max(f64::MIN_POSITIVE);
    let origin = bounds.center() - glam::DVec3::splat(0.5 * side);
    TextureSpace { origin, scale: (1.0 / side) as f32 }
}
