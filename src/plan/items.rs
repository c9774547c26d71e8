//! What can be drawn, and what each lens means to it.

use std::collections::{BTreeMap, HashSet};
use std::sync::Arc;

use glam::{DAffine3, DVec3};

use super::{Lens, LensSet, Rule, instances};
use crate::InputError;
use crate::error::Faults;
use crate::pixel::FIRST_CAP;
use crate::scene::{Aabb, Coincident, Edges, Model, Part, Primitive, Scene, Selections, Subject};
use crate::spec::{At, By, Cap, Filter, Names, Pattern, PatternSet, ShowWhat, Spec, lod};

/// Something that a picture may show: number 0 is the scene, the others are named by `show`.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Content {
    /// Into [`Scene::models`].
    pub model: usize,
    /// What of the model it has; `None`: all that the model draws.
    pub only: Option<Selection>,
}

/// Some of a model, by names: what matches one of the patterns.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Selection {
    pub nodes: Vec<Pattern>,
    pub materials: Vec<Pattern>,
}

impl Selection {
    fn new(nodes: &[At<Pattern>], materials: &[At<Pattern>]) -> Self {
        let patterns = |list: &[At<Pattern>]| list.iter().map(|p| p.value.clone()).collect();
        Self { nodes: patterns(nodes), materials: patterns(materials) }
    }

    /// For each node and for each material of a model whether it is selected.
    fn masks(&self, model: &Model) -> (Vec<bool>, Vec<bool>) {
        let materials = PatternSet::new(&self.materials);
        let of_materials = model.materials.iter().map(|material| materials.matches(&material.name));
        (model.nodes_matching(&self.nodes), of_materials.collect())
    }
}

/// One primitive of one node of one content, or a simplified version of it.
#[derive(Debug, Clone)]
pub struct Item {
    pub content: usize,
    /// Into [`Scene::models`].
    pub model: usize,
    pub node: usize,
    pub mesh: usize,
    pub primitive: usize,
    /// The share of its triangles: which version of the primitive it is; 1: all of it.
    pub ratio: f32,
    /// Into [`Scene::materials`].
    pub material: usize,
    /// The number of its first triangle among all items': the key that decides ties.
    pub first_triangle: u32,
    pub triangles: u32,
    /// World space, tight.
    pub bounds: Aabb,
    /// The centre of the tight world bounds of its node's whole mesh.
    pub center: DVec3,
    /// Its material may be less than opaque.
    pub translucent: bool,
    /// The lenses that apply to it by `only` and `except`.
    pub scope: LensSet,
    /// Lenses with `by = "object"` whose volume holds its node.
    pub object: LensSet,
    /// Lenses that bring this content in.
    pub shown_by: LensSet,
    /// Lenses that take it away where they act: they erase it or show something else.
    pub removed_by: LensSet,
    /// Lenses that move it where they act; what they take away they do not move.
    pub movers: LensSet,
    /// Lenses whose `lod` says which version is seen; the highest that acts decides.
    pub simplified_by: LensSet,
    /// How far its versions may lie from each other, scene units; 0 where there is but one.
    pub spread: f64,
    /// What the lenses and rules that erase it close it with, by rising rank; none where its node is not closed.
    pub caps: Vec<ItemCap>,
    /// Some primitive of its node has caps: the node is shown whole or not at all.
    pub is_cut: bool,
}

/// What a lens or rule closes an item with where it cuts it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ItemCap {
    /// The rank of the lens or rule.
    pub maker: usize,
    /// The place of the eraser among its filters.
    pub filter: usize,
    pub look: Cap,
}

impl Item {
    pub fn is_alternate(&self) -> bool {
        self.content != 0
    }

    /// Whether it has fewer triangles than the primitive.
    pub fn is_simplified(&self) -> bool {
        self.ratio < 1.0
    }

    /// Corners of its triangles: vertices of its primitive.
    pub fn triangle_list<'a>(&self, scene: &'a Scene) -> &'a [[u32; 3]] {
        self.primitive_of(scene).version(self.ratio).unwrap_or_default()
    }

    /// What lies across the edges of its triangles; empty where no filter has asked for it.
    pub fn across<'a>(&self, scene: &'a Scene) -> &'a [Edges] {
        self.primitive_of(scene).across_of(self.ratio)
    }

    pub fn primitive_of<'a>(&self, scene: &'a Scene) -> &'a Primitive {
        &scene.models[self.model].meshes[self.mesh].primitives[self.primitive]
    }

    /// The lenses that may move it to be seen elsewhere: an alternate only those from the first that shows it upwards.
    pub(super) fn moved_by(&self, lenses: &[Lens]) -> LensSet {
        let applies = |rank: &usize| {
            let there = lenses[*rank].by == By::Pixel || self.object.contains(*rank);
            there && (self.shown_by.contains(*rank) || self.scope.contains(*rank))
        };
        let lowest = if self.is_alternate() { self.shown_by.iter().next().unwrap_or(usize::MAX) } else { 0 };
        self.movers.iter().filter(|rank| *rank >= lowest).filter(applies).collect()
    }

    /// What name patterns are held against.
    pub(crate) fn subject<'a>(&self, scene: &'a Scene, known: &'a Selections<'a>) -> Subject<'a> {
        let material = self.material - scene.material_base[self.model];
        Subject { model: &scene.models[self.model], node: self.node, material, known }
    }
}

pub(super) fn collect(
    spec: &Spec,
    scene: &Scene,
    order: &[usize],
    lenses: &[Lens],
    rules: &[Rule],
) -> Result<(Vec<Content>, Vec<Item>), InputError> {
    let contents = contents(spec, scene)?;
    let known = Selections::default();
    let of_lenses = lenses.iter().map(|lens| &lens.filters).chain(rules.iter().map(|rule| &rule.filters));
    let relations: Vec<Relation> =
        of_lenses.enumerate().map(|(rank, filters)| Relation::new(rank, filters, &contents, scene)).collect();
    let mut items: Vec<Item> = Vec::new();
    let mut first_triangle: u64 = 0;
    for (content_index, content) in contents.iter().enumerate() {
        let model = &scene.models[content.model];
        let is_drawn = drawn(spec, model, content_index);
        let selected = content.only.as_ref().map(|only| only.masks(model));
        for node in 0..model.nodes.len() {
            let is_named = || selected.as_ref().is_some_and(|(nodes, _)| nodes[node]);
            let is_there = is_drawn[node] && (!model.nodes[node].hidden || is_named());
            let Some(mesh) = model.nodes[node].mesh.filter(|_| is_there) else { continue };
            let bounds = model.primitive_bounds(node);
            let center = model.node_bounds(node).center();
            for (index, primitive) in model.meshes[mesh].primitives.iter().enumerate() {
                if primitive.triangles.is_empty() {
                    continue;
                }
                let is_selected =
                    |(nodes, materials): &(Vec<bool>, Vec<bool>)| nodes[node] || materials[primitive.material];
                if !selected.as_ref().is_none_or(is_selected) {
                    continue;
                }
                let material = scene.material_base[content.model] + primitive.material;
                let mut item = Item {
                    content: content_index,
                    model: content.model,
                    node,
                    mesh,
                    primitive: index,
                    ratio: 1.0,
                    material,
                    first_triangle: first_triangle as u32,
                    triangles: primitive.triangles.len() as u32,
                    bounds: bounds[index],
                    center,
                    translucent: scene.materials[material].may_be_translucent(),
                    scope: LensSet::EMPTY,
                    object: LensSet::EMPTY,
                    shown_by: LensSet::EMPTY,
                    removed_by: LensSet::EMPTY,
                    movers: LensSet::EMPTY,
                    simplified_by: LensSet::EMPTY,
                    spread: 0.0,
                    caps: Vec::new(),
                    is_cut: false,
                };
                let subject = item.subject(scene, &known);
                for (rank, lens) in lenses.iter().enumerate() {
                    if subject.is_in_scope_of(&spec.lenses[order[rank]]) {
                        item.scope.insert(rank);
                    }
                    if lens.by == By::Object && lens.volume.contains(center) {
                        item.object.insert(rank);
                    }
                }
                relations.iter().for_each(|relation| relation.set(&mut item, &subject));
                item.simplified_by =
                    item.simplified_by.minus(LensSet::below(lenses.len()).minus(item.scope | item.shown_by));
                for version in versions(item, lenses, rules, scene)? {
                    let item = Item { first_triangle: first_triangle as u32, ..version };
                    first_triangle += u64::from(item.triangles);
                    items.push(item);
                }
            }
        }
    }
    if first_triangle > u64::from(FIRST_CAP) {
        let message = format!(
            "the scene and its alternates draw {first_triangle} triangles, and at most {} can be told apart",
            FIRST_CAP
        );
        return Err(InputError::new(message));
    }
    Ok((contents, items))
}

/// Of a meshoptimizer error, which is less than how far apart surfaces may lie on a slanting ray.
const SPREAD: f64 = 8.0;

/// The triangles of items that coincide with others; looked for once for one pose.
pub(super) fn coincident(items: &[Item], scene: &Scene) -> Arc<Coincident> {
    let part = |item: &Item| Part {
        place: [item.model, item.node, item.primitive],
        world_from_local: scene.models[item.model].nodes[item.node].world_from_local,
        positions: &item.primitive_of(scene).positions,
        triangles: item.triangle_list(scene),
        first_triangle: item.first_triangle,
    };
    scene.coincident_cache.get(&items.iter().map(part).collect::<Vec<_>>())
}

/// An item, and the simplified versions of it that lenses and rules may show, the finest first.
fn versions(item: Item, lenses: &[Lens], rules: &[Rule], scene: &Scene) -> Result<Vec<Item>, InputError> {
    let ratio = |rank: usize| match lenses.get(rank) {
        // One that takes whole objects never acts on the others.
        Some(lens) if lens.by == By::Object && !item.object.contains(rank) => None,
        Some(lens) => lens.lod,
        None => rules[rank - lenses.len()].lod,
    };
    let mut ratios: Vec<f32> = item.simplified_by.iter().filter_map(ratio).filter(|ratio| *ratio < 1.0).collect();
    ratios.sort_by(|a, b| b.total_cmp(a));
    ratios.dedup();
    let (mut simplified, mut error) = (Vec::new(), 0.0f32);
    for ratio in ratios {
        let versions = &item.primitive_of(scene).simplified;
        let Some(version) = versions.iter().find(|version| version.ratio == ratio) else {
            return Err(InputError::new(format!("the scene has not been prepared for `lod` with ratio = {ratio}"))
                .help("`Scene::prepare_filters` simplifies its meshes"));
        };
        error = error.max(version.error);
        simplified.push(Item { ratio, triangles: version.triangles.len() as u32, ..item.clone() });
    }
    let world = scene.models[item.model].nodes[item.node].world_from_local;
    let spread = SPREAD * f64::from(error) * largest_scale(&world);
    let versions = std::iter::once(item).chain(simplified.into_iter().filter(|item| item.triangles > 0));
    Ok(versions.map(|item| Item { spread, ..item }).collect())
}

/// How many times longer an affine map makes the longest of the axes.
pub(super) fn largest_scale(map: &DAffine3) -> f64 {
    let axes = map.matrix3;
    [axes.x_axis, axes.y_axis, axes.z_axis].into_iter().map(DVec3::length).fold(0.0, f64::max)
}

/// What the filters of one lens or rule mean to items.
struct Relation<'a> {
    rank: usize,
    filters: &'a [Filter],
    /// Where its last `show` stands, and the content that that brings in.
    show: Option<(usize, Option<usize>)>,
    simplifies: bool,
}

impl<'a> Relation<'a> {
    fn new(rank: usize, filters: &'a [Filter], contents: &[Content], scene: &Scene) -> Self {
        let show = last_show(filters.iter()).map(|(place, what)| {
            let shown = content(what, scene);
            (place, contents.iter().position(|content| *content == shown))
        });
        Self { rank, filters, show, simplifies: lod(filters.iter()).is_some() }
    }

    /// Sets what they mean to one item.
    fn set(&self, item: &mut Item, subject: &Subject<'a>) {
        let rank = self.rank;
        if self.simplifies {
            item.simplified_by.insert(rank);
        }
        let moves = instances::moves(self.filters, subject);
        // The cap of the first filter that erases it.
        let erased = |first: usize| {
            self.filters.iter().enumerate().skip(first).find_map(|(filter, f)| match f {
                Filter::Erase { nodes, materials, cap, .. } => {
                    let matches = (nodes.is_empty() && materials.is_empty()) || subject.is_any(nodes, materials);
                    matches.then_some(cap.map(|look| ItemCap { maker: rank, filter, look }))
                }
                _ => None,
            })
        };
        let Some((show, shown)) = self.show else {
            if let Some(cap) = erased(0) {
                item.removed_by.insert(rank);
                item.caps.extend(cap);
            } else if moves {
                item.movers.insert(rank);
            }
            return;
        };
        if shown == Some(item.content) {
            match erased(show + 1) {
                None => {
                    item.shown_by.insert(rank);
                    if moves {
                        item.movers.insert(rank);
                    }
                }
                Some(cap) => item.caps.extend(cap),
            }
        }
        // Whatever else is in the lens's scope makes room for what it shows.
        item.removed_by.insert(rank);
    }
}

fn content(what: &ShowWhat, scene: &Scene) -> Content {
    match what {
        ShowWhat::Alternate { name, only } => Content {
            model: model_of(name, scene),
            only: (!only.is_empty()).then(|| Selection::new(&only.nodes, &only.materials)),
        },
        ShowWhat::Nodes(patterns) => Content { model: 0, only: Some(Selection::new(patterns, &[])) },
    }
}

/// Into [`Scene::models`].
fn model_of(alternate: &At<String>, scene: &Scene) -> usize {
    1 + scene.alternates.iter().position(|known| *known == alternate.value).unwrap_or_default()
}

/// The place of the last `show` of a list of filters, the one that acts, and what it shows.
fn last_show<'f>(
    filters: impl DoubleEndedIterator<Item = &'f Filter> + ExactSizeIterator,
) -> Option<(usize, &'f ShowWhat)> {
    filters.enumerate().rev().find_map(|(place, filter)| match filter {
        Filter::Show(what) => Some((place, what)),
        _ => None,
    })
}

/// The scene, then what the enabled lenses show: alternates in their order, then node lists as they come.
fn contents(spec: &Spec, scene: &Scene) -> Result<Vec<Content>, InputError> {
    let of_lenses = || spec.lenses.iter().map(|lens| (lens.enabled, &lens.filters));
    let of_rules = || spec.overlaps.iter().map(|rule| (true, &rule.filters));
    let mut faults = Faults::default();
    let mut names = BTreeMap::new();
    for filter in of_lenses().chain(of_rules()).flat_map(|(_, filters)| filters) {
        if let Filter::Show(what) = &filter.value {
            check_shown(spec, scene, what, &mut names, &mut faults);
        }
    }
    faults.finish()?;
    let enabled = of_lenses().chain(of_rules()).filter(|(enabled, _)| *enabled);
    let shown = enabled.filter_map(|(_, filters)| last_show(filters.iter().map(|filter| &filter.value)));
    let mut shown: Vec<Content> = shown.map(|(_, what)| content(what, scene)).collect();
    shown.sort_by_key(|c| if c.model == 0 { usize::MAX } else { c.model });
    let mut contents = vec![Content { model: 0, only: None }];
    let mut known = HashSet::new();
    contents.extend(shown.into_iter().filter(|content| known.insert(content.clone())));
    Ok(contents)
}

/// What `show` names must be there. `known`: the names of the nodes and the materials of each model that was asked for.
fn check_shown<'s>(
    spec: &Spec,
    scene: &'s Scene,
    what: &ShowWhat,
    known: &mut BTreeMap<usize, [Names<'s>; 2]>,
    faults: &mut Faults,
) {
    let (model, nodes, materials) = match what {
        ShowWhat::Alternate { name, only } => (model_of(name, scene), only.nodes.as_slice(), only.materials.as_slice()),
        ShowWhat::Nodes(nodes) => (0, nodes.as_slice(), &[][..]),
    };
    let (number, model) = (model, &scene.models[model]);
    let [of_nodes, of_materials] = known.entry(number).or_insert_with(|| [model.node_names(), model.material_names()]);
    let mut refuse = |what: &str, pattern: &At<Pattern>, help: fn(&Model, &str) -> String| {
        let message = format!("`show` finds no {what} of `{}` that matches `{}`", model.name, pattern.value);
        let error = InputError::at(&spec.source, pattern.span.clone(), message);
        let help = faults.are_few().then(|| help(model, &pattern.value.0));
        faults.note(InputError { help, ..error });
    };
    for pattern in nodes.iter().filter(|p| !of_nodes.any(&p.value)) {
        refuse("node", pattern, Model::node_help);
    }
    for pattern in materials.iter().filter(|p| !of_materials.any(&p.value)) {
        refuse("material", pattern, Model::material_help);
    }
}

/// For each node whether a content may have it: its model draws it, and the spec does not hide it.
fn drawn(spec: &Spec, model: &Model, content: usize) -> Vec<bool> {
    let hide = if content == 0 { spec.scene.hide.as_slice() } else { &[] };
    let hidden = model.nodes_matching(hide.iter().map(|pattern| &pattern.value));
    model.nodes.iter().zip(hidden).map(|(node, hidden)| node.drawn && !hidden).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_the_last_show_of_a_list_makes_a_content() {
        let lens = |name: &str, filters: &str| {
            format!(
                "[[lens]]\nname = '{name}'\nshape.sphere = {{ center = [0, 0, 0], radius = 1 }}\n\
                 filters = [{filters}]\n"
            )
        };
        let text = "[scene]\nfile = 'models/cubes.glb'\n".to_owned()
            + &lens("a", "{ show = { nodes = ['layer-0'] } }, { show = { nodes = ['layer-1'] } }")
            + &lens("b", "{ show = { nodes = ['layer-1'] } }");
        let spec = Spec::parse(&text, "a test", "lens-specs".as_ref()).expect("a spec");
        let scene = Scene::open(&spec).expect("a model of the project");
        let contents = contents(&spec, &scene).expect("all is there");
        let shown: Vec<&str> = contents.iter().flat_map(|c| &c.only).map(|only| only.nodes[0].0.as_str()).collect();
        assert_eq!((contents.len(), shown), (2, vec!["layer-1"]));
    }
}
