//! The total order: section 3 of SEMANTICS, read literally.

use glam::DVec3;

use super::names;
use super::view::View;
use crate::case::{Case, Shape};

/// Pairs (below, above) of lenses by their place in the file.
fn edges(case: &Case) -> Vec<(usize, usize)> {
    let mut edges = Vec::new();
    for (own, lens) in case.lenses.iter().enumerate() {
        for pattern in lens.over.iter().chain(&lens.hides) {
            edges.extend(names::lenses(case, own, pattern).map(|other| (other, own)));
        }
        for pattern in &lens.under {
            edges.extend(names::lenses(case, own, pattern).map(|other| (own, other)));
        }
    }
    edges
}

/// The enabled lenses by their place in the file, lowest first. `centers` are in the world.
pub fn total(case: &Case, view: &View, centers: &[DVec3]) -> Vec<usize> {
    let edges = edges(case);
    let is_flat = |lens: usize| matches!(case.lenses[lens].shape, Shape::Flat { .. });
    let distance = |lens: usize| {
        let way = centers[lens] - view.eye;
        if view.is_perspective { way.length() } else { way.dot(view.forward) }
    };
    let mut left: Vec<usize> = (0..case.lenses.len()).filter(|lens| case.lenses[*lens].enabled).collect();
    let mut order = Vec::new();
    while !left.is_empty() {
        let mut ready = left.clone();
        ready.retain(|lens| !edges.iter().any(|(below, above)| above == lens && left.contains(below)));
        let lowest = ready.iter().map(|lens| case.lenses[*lens].priority).min().expect("a case has no cycle");
        ready.retain(|lens| case.lenses[*lens].priority == lowest);
        let mut next = ready[0];
        if is_flat(next) {
            for lens in ready.into_iter().filter(|lens| is_flat(*lens)) {
                if distance(lens) > distance(next) {
                    next = lens;
                }
            }
        }
        left.retain(|lens| *lens != next);
        order.push(next);
    }
    order
}
