//! Nodes by their names.

use std::cell::RefCell;
use std::collections::HashMap;
use std::marker::PhantomData;
use std::rc::Rc;

use super::Model;
use crate::InputError;
use crate::limits::MAX_COMPARISONS;
use crate::spec::{At, Filter, LensSpec, Matches, Names, NamesSize, Pattern, PatternSet, ShowWhat, Spec, suggest};

/// What name patterns are held against.
pub(crate) struct Subject<'a> {
    pub model: &'a Model,
    pub node: usize,
    /// Into the model's.
    pub material: usize,
    pub known: &'a Selections<'a>,
}

impl<'a> Subject<'a> {
    /// Whether a lens's `only` and `except` let it act here.
    pub fn is_in_scope_of(&self, lens: &'a LensSpec) -> bool {
        (lens.only.is_empty() || self.is_in(&lens.only)) && !self.is_in(&lens.except)
    }

    pub fn is_in(&self, matches: &'a Matches) -> bool {
        self.is_any(&matches.nodes, &matches.materials)
    }

    pub fn is_any(&self, nodes: &'a [At<Pattern>], materials: &'a [At<Pattern>]) -> bool {
        (!nodes.is_empty() && self.known.nodes(self.model, nodes)[self.node])
            || (!materials.is_empty() && self.known.materials(self.model, materials)[self.material])
    }
}

/// A model and a list of patterns, by where they stand in memory.
type Place = (*const Model, *const At<Pattern>, usize);

/// What lists of patterns match. Each list is held against the names of a model once: a lens may list as many nodes as a
/// scene has, and every item asks every lens.
#[derive(Default)]
pub(crate) struct Selections<'a> {
    known: RefCell<HashMap<Place, Rc<[bool]>>>,
    /// Lists and models stay where they are as long as this lives.
    lists: PhantomData<&'a ()>,
}

impl<'a> Selections<'a> {
    /// For each node whether the list matches it; see [`Model::nodes_matching`].
    pub fn nodes(&self, model: &'a Model, list: &'a [At<Pattern>]) -> Rc<[bool]> {
        self.find(model, list, || model.nodes_matching(list.iter().map(|pattern| &pattern.value)).into())
    }

    /// For each material whether the list matches its name.
    fn materials(&self, model: &'a Model, list: &'a [At<Pattern>]) -> Rc<[bool]> {
        self.find(model, list, || {
            let set = PatternSet::new(list.iter().map(|pattern| &pattern.value));
            model.materials.iter().map(|material| set.matches(&material.name)).collect()
        })
    }

    fn find(&self, model: &Model, list: &[At<Pattern>], make: impl FnOnce() -> Rc<[bool]>) -> Rc<[bool]> {
        let place = (std::ptr::from_ref(model), list.as_ptr(), list.len());
        Rc::clone(self.known.borrow_mut().entry(place).or_insert_with(make))
    }
}

/// Fails where a spec's patterns would have to be held against the names of its models more often than is done.
pub(super) fn bound_comparisons(spec: &Spec, models: &[Model]) -> Result<(), InputError> {
    let nodes: NamesSize = models.iter().flat_map(|model| &model.nodes).map(|node| node.name.as_str()).collect();
    let materials: NamesSize =
        models.iter().flat_map(|model| &model.materials).map(|material| material.name.as_str()).collect();
    let (mut work, mut wild) = (0u64, 0);
    let of_lists = lists(spec).flat_map(|[of_nodes, of_materials]| [(of_nodes, nodes), (of_materials, materials)]);
    for (list, names) in of_lists.filter(|(list, _)| !list.is_empty()) {
        let patterns = || list.iter().map(|pattern| &pattern.value);
        wild += patterns().filter(|pattern| pattern.has_wildcard()).count();
        // Each name is looked up in the list, too.
        work = work.saturating_add(names.count).saturating_add(names.steps(patterns()));
        if work > MAX_COMPARISONS {
            let message = format!(
                "{wild} patterns with wildcards over {} nodes and {} materials are too many to compare: \
                 that takes more than {MAX_COMPARISONS} steps",
                nodes.count, materials.count
            );
            return Err(InputError::at(&spec.source, list[0].span.clone(), message)
                .help("names without `*` and `?` cost nothing: any number of them can be listed"));
        }
    }
    Ok(())
}

/// The lists of patterns of a spec: of nodes, and of materials.
fn lists(spec: &Spec) -> impl Iterator<Item = [&[At<Pattern>]; 2]> {
    let scopes = spec.lenses.iter().flat_map(|lens| [&lens.only, &lens.except]);
    let scopes = scopes.map(|Matches { nodes, materials }| [nodes.as_slice(), materials.as_slice()]);
    let of_lenses = spec.lenses.iter().flat_map(|lens| &lens.filters);
    let filters =
        of_lenses.chain(spec.overlaps.iter().flat_map(|rule| &rule.filters)).map(|filter| patterns_of(&filter.value));
    std::iter::once([spec.scene.hide.as_slice(), &[]]).chain(scopes).chain(filters)
}

fn patterns_of(filter: &Filter) -> [&[At<Pattern>]; 2] {
    match filter {
        Filter::Erase { nodes, materials, .. } => [nodes, materials],
        Filter::Displace { nodes, .. } => [nodes, &[]],
        Filter::Show(ShowWhat::Nodes(nodes)) => [nodes, &[]],
        Filter::Show(ShowWhat::Alternate { only, .. }) => [&only.nodes, &only.materials],
        _ => [&[], &[]],
    }
}

impl Model {
    /// The one node of a name, or what is wrong with the name; [`Model::node_help`] says what to do about it.
    pub fn node_named(&self, name: &str) -> Result<usize, String> {
        let found: Vec<usize> = self.nodes_named(name).collect();
        match found[..] {
            [node] => Ok(node),
            [] => Err(format!("`{}` has no node named `{name}`", self.name)),
            _ => Err(format!("{} nodes of `{}` are named `{name}`", found.len(), self.name)),
        }
    }

    /// What to write instead of a name that is not one node's.
    pub fn node_help(&self, name: &str) -> String {
        match self.nodes_named(name).next() {
            Some(_) => "one node is meant here; give that node a name of its own".into(),
            None => help(name, self.nodes.iter().map(|node| node.name.as_str()), "nodes"),
        }
    }

    /// What to write instead of a material name that is not there.
    pub fn material_help(&self, name: &str) -> String {
        help(name, self.materials.iter().map(|material| material.name.as_str()), "materials")
    }

    fn nodes_named(&self, name: &str) -> impl Iterator<Item = usize> {
        (0..self.nodes.len()).filter(move |node| self.nodes[*node].name == name)
    }

    /// The nodes' names, to hold patterns against.
    pub(crate) fn node_names(&self) -> Names<'_> {
        Names::new(self.nodes.iter().map(|node| node.name.as_str()))
    }

    /// The materials' names, to hold patterns against.
    pub(crate) fn material_names(&self) -> Names<'_> {
        Names::new(self.materials.iter().map(|material| material.name.as_str()))
    }

    /// A node's name, or `node N` where the file gives none.
    pub fn node_label(&self, node: usize) -> String {
        or_number(&self.nodes[node].name, "node", node)
    }

    /// A material's name, or `material N` where the file gives none.
    pub fn material_label(&self, material: usize) -> String {
        or_number(&self.materials[material].name, "material", material)
    }

    /// For each node whether one of the patterns matches its own name or any ancestor's, each name looked at once.
    pub(crate) fn nodes_matching<'p>(&self, patterns: impl IntoIterator<Item = &'p Pattern>) -> Vec<bool> {
        let set = PatternSet::new(patterns);
        let own: Vec<bool> = self.nodes.iter().map(|node| set.matches(&node.name)).collect();
        let mut known: Vec<Option<bool>> = own.iter().map(|own| own.then_some(true)).collect();
        let mut path = Vec::new();
        for node in 0..self.nodes.len() {
            let mut at = Some(node);
            while let Some(next) = at.filter(|n| known[*n].is_none()) {
                path.push(next);
                at = self.nodes[next].parent;
            }
            let matches = at.is_some_and(|n| known[n] == Some(true));
            path.drain(..).for_each(|n| known[n] = Some(matches));
        }
        known.into_iter().map(|known| known == Some(true)).collect()
    }
}

fn help<'a>(name: &str, known: impl Iterator<Item = &'a str>, what: &str) -> String {
    match suggest::nearest(name, known) {
        Some(name) => format!("did you mean `{name}`?"),
        None => format!("`lenspeel info` lists the {what} of a model"),
    }
}

fn or_number(name: &str, kind: &str, number: usize) -> String {
    if name.is_empty() { format!("{kind} {number}") } else { name.to_string() }
}
