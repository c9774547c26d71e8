//! Smaller cases that still fail: one part is left out at a time.

use crate::case::Case;
use crate::oracle::matches;

/// The smallest case that still fails of those made by leaving out lenses, rules, filters, nodes and settings.
pub fn shrink(case: &Case, fails: impl Fn(&Case) -> bool) -> Case {
    let mut smallest = case.clone();
    while let Some(smaller) = smaller(&smallest).into_iter().find(&fails) {
        smallest = smaller;
    }
    smallest
}

/// All cases with one part less.
fn smaller(case: &Case) -> Vec<Case> {
    let mut all = Vec::new();
    let mut with = |change: &dyn Fn(&mut Case)| {
        let mut smaller = case.clone();
        change(&mut smaller);
        drop_dangling(&mut smaller);
        all.push(smaller);
    };
    for lens in 0..case.lenses.len() {
        with(&|case| drop(case.lenses.remove(lens)));
    }
    for rule in 0..case.rules.len() {
        with(&|case| drop(case.rules.remove(rule)));
    }
    for (lens, data) in case.lenses.iter().enumerate() {
        for filter in (0..data.filters.len()).filter(|_| data.filters.len() > 1) {
            with(&|case| drop(case.lenses[lens].filters.remove(filter)));
        }
        if !(data.only.is_empty() && data.except.is_empty()) {
            with(&|case| case.lenses[lens].only = Default::default());
            with(&|case| case.lenses[lens].except = Default::default());
        }
        for edge in 0..data.over.len() {
            with(&|case| drop(case.lenses[lens].over.remove(edge)));
        }
        for edge in 0..data.under.len() {
            with(&|case| drop(case.lenses[lens].under.remove(edge)));
        }
        for edge in 0..data.hides.len() {
            with(&|case| drop(case.lenses[lens].hides.remove(edge)));
        }
    }
    for (model, data) in case.models.iter().enumerate() {
        for node in (0..data.nodes.len()).filter(|node| data.nodes[*node].primitives.len() > 1) {
            with(&|case| case.models[model].nodes[node].primitives.truncate(1));
        }
        for node in (0..data.nodes.len()).filter(|node| !data.nodes[*node].primitives.is_empty()) {
            with(&|case| case.models[model].nodes[node].primitives.clear());
        }
    }
    // What only lost something that was not there would never get smaller.
    all.retain(|smaller| size(smaller) < size(case));
    all
}

/// Edges to lenses that are gone.
fn drop_dangling(case: &mut Case) {
    let names: Vec<String> = case.lenses.iter().map(|lens| lens.name.clone()).collect();
    for (own, lens) in case.lenses.iter_mut().enumerate() {
        let other = |pattern: &String| (0..names.len()).any(|i| i != own && matches(pattern, &names[i]));
        [&mut lens.over, &mut lens.under, &mut lens.hides].into_iter().for_each(|list| list.retain(other));
    }
}

fn size(case: &Case) -> usize {
    let patterns = |p: &crate::case::Patterns| p.nodes.len() + p.materials.len();
    let lens = |l: &crate::case::Lens| {
        1 + l.filters.len() + l.over.len() + l.under.len() + l.hides.len() + patterns(&l.only) + patterns(&l.except)
    };
    let primitives = case.models.iter().flat_map(|m| &m.nodes).map(|n| n.primitives.len());
    case.lenses.iter().map(lens).sum::<usize>() + case.rules.len() + primitives.sum::<usize>()
}
