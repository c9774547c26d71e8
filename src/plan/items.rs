//! What can be drawn, and what each lens means to it.

use super::{Lens, LensSet, Rule, instances};
use glam::DVec3;

use crate::InputError;
use crate::pixel::FIRST_CAP;
use crate::scene::{Aabb, Model, Scene};
use crate::spec::{At, By, Cap, Filter, LensSpec, Matches, Pattern, ShowWhat, Spec};

/// Something that a picture may show: number 0 is the scene, the others are named by `show`.
#[derive(Debug, Clone, PartialEq)]
pub struct Content {
    /// Into [`Scene::models`].
    pub model: usize,
    /// Patterns of the nodes it has; `None`: what the model draws.
    pub nodes: Option<Vec<Pattern>>,
}

/// One primitive of one node of one content.
#[derive(Debug, Clone)]
pub struct Item {
    pub content: usize,
    /// Into [`Scene::models`].
    pub model: usize,
    pub node: usize,
    pub mesh: usize,
    pub primitive: usize,
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
    /// What the lenses and rules that erase it close it with, by rising rank; none where its node is not closed.
    pub caps: Vec<(usize, Cap)>,
    /// Some primitive of its node has caps: the node is shown whole or not at all.
    pub is_cut: bool,
}

impl Item {
    pub fn is_alternate(&self) -> bool {
        self.content != 0
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
    pub(super) fn subject<'a>(&self, scene: &'a Scene) -> Subject<'a> {
        let model = &scene.models[self.model];
        let material = &model.materials[self.material - scene.material_base[self.model]].name;
        Subject { model, node: self.node, material }
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
    let mut items: Vec<Item> = Vec::new();
    let mut first_triangle: u64 = 0;
    for (content_index, content) in contents.iter().enumerate() {
        let model = &scene.models[content.model];
        for node in 0..model.nodes.len() {
            let Some(mesh) = model.nodes[node].mesh.filter(|_| is_part(spec, model, content_index, content, node))
            else {
                continue;
            };
            let bounds = model.primitive_bounds(node);
            let center = model.node_bounds(node).center();
            for (index, primitive) in model.meshes[mesh].primitives.iter().enumerate() {
                if primitive.triangles.is_empty() {
                    continue;
                }
                let material = scene.material_base[content.model] + primitive.material;
                let mut item = Item {
                    content: content_index,
                    model: content.model,
                    node,
                    mesh,
                    primitive: index,
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
                    caps: Vec::new(),
                    is_cut: false,
                };
                let subject = item.subject(scene);
                for (rank, lens) in lenses.iter().enumerate() {
                    let lens_spec = &spec.lenses[order[rank]];
                    if in_scope(lens_spec, &subject) {
                        item.scope.insert(rank);
                    }
                    relate(&mut item, rank, &lens.filters, &subject, &contents, scene);
                    if lens.by == By::Object && lens.volume.contains(center) {
                        item.object.insert(rank);
                    }
                }
                for (number, rule) in rules.iter().enumerate() {
                    relate(&mut item, lenses.len() + number, &rule.filters, &subject, &contents, scene);
                }
                first_triangle += u64::from(item.triangles);
                items.push(item);
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

fn in_scope(lens: &LensSpec, subject: &Subject) -> bool {
    (lens.only.is_empty() || subject.is_in(&lens.only)) && !subject.is_in(&lens.except)
}

/// Sets what the filters of one lens or rule mean to one item.
fn relate(item: &mut Item, rank: usize, filters: &[Filter], subject: &Subject, contents: &[Content], scene: &Scene) {
    let moves = instances::moves(filters, subject);
    let last_show = filters.iter().rposition(|f| matches!(f, Filter::Show(_)));
    // The cap of the first filter that erases it.
    let erased = |filters: &[Filter]| {
        filters.iter().find_map(|f| match f {
            Filter::Erase { nodes, materials, cap } => {
                let matches = (nodes.is_empty() && materials.is_empty()) || subject.is_any(nodes, materials);
                matches.then_some(*cap)
            }
            _ => None,
        })
    };
    let Some(show) = last_show else {
        if let Some(cap) = erased(filters) {
            item.removed_by.insert(rank);
            item.caps.extend(cap.map(|cap| (rank, cap)));
        } else if moves {
            item.movers.insert(rank);
        }
        return;
    };
    let Filter::Show(what) = &filters[show] else { return };
    let brings_in = contents.iter().position(|c| *c == content(what, scene)) == Some(item.content);
    if brings_in {
        match erased(&filters[show + 1..]) {
            None => {
                item.shown_by.insert(rank);
                if moves {
                    item.movers.insert(rank);
                }
            }
            Some(cap) => item.caps.extend(cap.map(|cap| (rank, cap))),
        }
    }
    // Whatever else is in the lens's scope makes room for what it shows.
    item.removed_by.insert(rank);
}

fn content(what: &ShowWhat, scene: &Scene) -> Content {
    match what {
        ShowWhat::Alternate(name) => Content {
            model: 1 + scene.alternates.iter().position(|a| *a == name.value).unwrap_or_default(),
            nodes: None,
        },
        ShowWhat::Nodes(patterns) => {
            Content { model: 0, nodes: Some(patterns.iter().map(|p| p.value.clone()).collect()) }
        }
    }
}

/// The scene, then what the enabled lenses show: alternates in their order, then node lists as they come.
fn contents(spec: &Spec, scene: &Scene) -> Result<Vec<Content>, InputError> {
    let mut contents = vec![Content { model: 0, nodes: None }];
    let mut shown: Vec<Content> = Vec::new();
    let of_lenses = spec.lenses.iter().flat_map(|lens| lens.filters.iter().map(|filter| (lens.enabled, filter)));
    let of_rules = spec.overlaps.iter().flat_map(|rule| rule.filters.iter().map(|filter| (true, filter)));
    for (enabled, filter) in of_lenses.chain(of_rules) {
        let Filter::Show(what) = &filter.value else { continue };
        if let ShowWhat::Nodes(patterns) = what {
            check_shown_nodes(spec, &scene.models[0], patterns)?;
        }
        if enabled {
            shown.push(content(what, scene));
        }
    }
    shown.sort_by_key(|c| if c.model == 0 { usize::MAX } else { c.model });
    for content in shown {
        if !contents.contains(&content) || (content.nodes.is_none() && content.model == 0) {
            contents.push(content);
        }
    }
    Ok(contents)
}

fn check_shown_nodes(spec: &Spec, model: &Model, patterns: &[At<Pattern>]) -> Result<(), InputError> {
    for pattern in patterns {
        if !(0..model.nodes.len()).any(|n| model.node_matches(n, &pattern.value)) {
            let message = format!("`show` finds no node of `{}` that matches `{}`", model.name, pattern.value);
            return Err(InputError::at(&spec.source, pattern.span.clone(), message)
                .help(model.nearest_node_name(&pattern.value.0)));
        }
    }
    Ok(())
}

fn is_part(spec: &Spec, model: &Model, index: usize, content: &Content, node: usize) -> bool {
    let wanted = match &content.nodes {
        Some(patterns) => patterns.iter().any(|p| model.node_matches(node, p)),
        None => index != 0 || !spec.scene.hide.iter().any(|p| model.node_matches(node, &p.value)),
    };
    wanted && model.nodes[node].drawn
}

/// What name patterns are held against.
pub(super) struct Subject<'a> {
    model: &'a Model,
    node: usize,
    material: &'a str,
}

impl Subject<'_> {
    fn is_in(&self, matches: &Matches) -> bool {
        self.is_any(&matches.nodes, &matches.materials)
    }

    pub(super) fn is_any(&self, nodes: &[At<Pattern>], materials: &[At<Pattern>]) -> bool {
        nodes.iter().any(|p| self.model.node_matches(self.node, &p.value))
            || materials.iter().any(|p| p.value.matches(self.material))
    }
}
