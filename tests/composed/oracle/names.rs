//! Name patterns and conditions, by plain recursion.

use crate::case::{Case, Model, Patterns, When};

/// `*` is any run of characters, `?` one; the whole name must match, case minded.
pub fn matches(pattern: &str, name: &str) -> bool {
    let (mut rest, mut left) = (pattern.chars(), name.chars());
    match (rest.next(), left.next()) {
        (None, end) => end.is_none(),
        (Some('*'), first) => matches(rest.as_str(), name) || (first.is_some() && matches(pattern, left.as_str())),
        (Some(_), None) => false,
        (Some(wanted), Some(there)) => (wanted == '?' || wanted == there) && matches(rest.as_str(), left.as_str()),
    }
}

/// Whether one of the patterns matches a node by its own name or any ancestor's.
pub fn node_matches(model: &Model, node: usize, patterns: &[String]) -> bool {
    let line = std::iter::successors(Some(node), |n| model.nodes[*n].parent);
    line.into_iter().any(|n| patterns.iter().any(|p| matches(p, &model.nodes[n].name)))
}

/// Whether the node or the material matches.
pub fn either_matches(model: &Model, node: usize, material: usize, patterns: &Patterns) -> bool {
    node_matches(model, node, &patterns.nodes)
        || patterns.materials.iter().any(|p| matches(p, &model.materials[material].name))
}

/// The lenses of the file, other than `own`, that a pattern names.
pub fn lenses<'a>(case: &'a Case, own: usize, pattern: &'a str) -> impl Iterator<Item = usize> + 'a {
    (0..case.lenses.len()).filter(move |other| *other != own && matches(pattern, &case.lenses[*other].name))
}

/// Whether a condition holds where exactly these lenses are.
pub fn holds(case: &Case, when: &When, around: &[usize]) -> bool {
    match when {
        When::Name(pattern) => around.iter().any(|lens| matches(pattern, &case.lenses[*lens].name)),
        When::Not(inner) => !holds(case, inner, around),
        When::And(a, b) => holds(case, a, around) && holds(case, b, around),
        When::Or(a, b) => holds(case, a, around) || holds(case, b, around),
    }
}
