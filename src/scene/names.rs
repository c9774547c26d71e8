//! Nodes by their names.

use super::Model;
use crate::spec::{At, LensSpec, Matches, Pattern};

/// What name patterns are held against.
pub(crate) struct Subject<'a> {
    pub model: &'a Model,
    pub node: usize,
    /// The name of its material.
    pub material: &'a str,
}

impl Subject<'_> {
    /// Whether a lens's `only` and `except` let it act here.
    pub fn is_in_scope_of(&self, lens: &LensSpec) -> bool {
        (lens.only.is_empty() || self.is_in(&lens.only)) && !self.is_in(&lens.except)
    }

    pub fn is_in(&self, matches: &Matches) -> bool {
        self.is_any(&matches.nodes, &matches.materials)
    }

    pub fn is_any(&self, nodes: &[At<Pattern>], materials: &[At<Pattern>]) -> bool {
        nodes.iter().any(|p| self.model.node_matches(self.node, &p.value))
            || materials.iter().any(|p| p.value.matches(self.material))
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
        help(self.nearest_node(name), "nodes")
    }

    /// The node name most like one, if any is near.
    pub fn nearest_node(&self, name: &str) -> Option<&str> {
        nearest(name, self.nodes.iter().map(|n| n.name.as_str()))
    }

    /// What to write instead of a material name that is not there.
    pub fn nearest_material_name(&self, name: &str) -> String {
        help(self.nearest_material(name), "materials")
    }

    /// The material name most like one, if any is near.
    pub fn nearest_material(&self, name: &str) -> Option<&str> {
        nearest(name, self.materials.iter().map(|m| m.name.as_str()))
    }

    pub fn has_node(&self, pattern: &Pattern) -> bool {
        self.nodes.iter().any(|n| pattern.matches(&n.name))
    }

    pub fn has_material(&self, pattern: &Pattern) -> bool {
        self.materials.iter().any(|m| pattern.matches(&m.name))
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
}

fn help(nearest: Option<&str>, what: &str) -> String {
    match nearest {
        Some(name) => format!("did you mean `{name}`?"),
        None => format!("`lenspeel info` lists the {what} of a model"),
    }
}

/// The name that is most like one, if any is.
fn nearest<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> Option<&'a str> {
    let likeness = names.filter(|n| !n.is_empty()).map(|n| (strsim::jaro_winkler(n, name), n));
    let (score, nearest) = likeness.max_by(|a, b| a.0.total_cmp(&b.0))?;
    (score > 0.8).then_some(nearest)
}

fn or_number(name: &str, kind: &str, number: usize) -> String {
    if name.is_empty() { format!("{kind} {number}") } else { name.to_string() }
}
