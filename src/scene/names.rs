//! Nodes by their names.

use std::cell::RefCell;
use std::collections::HashMap;
use std::marker::PhantomData;
use std::rc::Rc;

use super::Model;
use crate::InputError;
use crate::limits::MAX_COMPARISONS;
use crate::spec::{At, Filter, LensSpec, Matches, Names, Pattern, PatternSet, ShowWhat, Spec};

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
    /// For each node whether the list matches it; see [`Model::node_matches`].
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
///
/// Names without wildcards are looked up. A pattern with wildcards is held against each name, which takes at most the product
/// of both lengths; a sixteenth of that counts.
pub(super) fn bound_comparisons(spec: &Spec, models: &[Model]) -> Result<(), InputError> {
    let names = |names: &mut dyn Iterator<Item = &String>| {
        names.fold((0u64, 0u64), |(count, bytes), name| (count + 1, bytes + name.len() as u64))
    };
    let nodes = names(&mut models.iter().flat_map(|model| &model.nodes).map(|node| &node.name));
    let materials = names(&mut models.iter().flat_map(|model| &model.materials).map(|material| &material.name));
    let (mut work, mut wild) = (0u64, 0);
    for (list, (count, bytes)) in
        lists(spec).flat_map(|[of_nodes, of_materials]| [(of_nodes, nodes), (of_materials, materials)])
    {
        let patterns = || list.iter().filter(|pattern| pattern.value.has_wildcard());
        let length: u64 = patterns().map(|pattern| pattern.value.0.len() as u64).sum();
        wild += patterns().count();
        let own = count.saturating_mul(1 + patterns().count() as u64).saturating_add(length.saturating_mul(bytes) / 16);
        work = work.saturating_add(if list.is_empty() { 0 } else { own });
        if work > MAX_COMPARISONS {
            let message = format!(
                "{wild} patterns with wildcards over {} nodes and {} materials are too many to compare: \
                 that takes more than {MAX_COMPARISONS} steps",
                nodes.0, materials.0
            );
            let place = list.first().map_or(0..0, |pattern| pattern.span.clone());
            return Err(InputError::at(&spec.source, place, message)
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
    /// The one node of a name, or what is wrong with the name and what to do about it.
    pub fn node_named(&self, name: &str) -> Result<usize, (String, String)> {
        let found: Vec<usize> = (0..self.nodes.len()).filter(|i| self.nodes[*i].name == name).collect();
        match found[..] {
            [node] => Ok(node),
            [] => Err((format!("`{}` has no node named `{name}`", self.name), self.nearest_node_name(name))),
            _ => Err((
                format!("{} nodes of `{}` are named `{name}`", found.len(), self.name),
                "one node is meant here; give that node a name of its own".into(),
            )),
        }
    }

    /// What to write instead of a node name that is not there.
    pub fn nearest_node_name(&self, name: &str) -> String {
        help(nearest(name, self.nodes.iter().map(|n| n.name.as_str())), "nodes")
    }

    /// What to write instead of a material name that is not there.
    pub fn nearest_material_name(&self, name: &str) -> String {
        help(nearest(name, self.materials.iter().map(|m| m.name.as_str())), "materials")
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

    /// Whether the pattern matches the node's own name or any ancestor's.
    pub fn node_matches(&self, node: usize, pattern: &Pattern) -> bool {
        std::iter::successors(Some(node), |n| self.nodes[*n].parent).any(|n| pattern.matches(&self.nodes[n].name))
    }

    /// For each node whether one of the patterns matches it, each name looked at once.
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

fn help(nearest: Option<&str>, what: &str) -> String {
    match nearest {
        Some(name) => format!("did you mean `{name}`?"),
        None => format!("`lenspeel info` lists the {what} of a model"),
    }
}

/// The name that is most like one, if any is.
pub(crate) fn nearest<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let likeness = names.filter(|n| !n.is_empty()).map(|n| (strsim::jaro_winkler(n, name), n));
    let (score, nearest) = likeness.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (score > 0.8).then_some(nearest)
}

fn or_number(name: &str, kind: &str, number: usize) -> String {
    if name.is_empty() { format!("{kind} {number}") } else { name.to_string() }
}
