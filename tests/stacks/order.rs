//! Section 3 of SEMANTICS, read literally.

use lenspeel::spec::Pattern;

use crate::case::Case;

/// Declared edges `(below, above)` by position in the file; a pattern stands for every other lens it matches.
pub fn edges(case: &Case) -> Vec<(usize, usize)> {
    let mut edges = Vec::new();
    for (own, lens) in case.lenses.iter().enumerate() {
        let others = |pattern: &String| {
            let pattern = Pattern::new(pattern.clone());
            (0..case.lenses.len())
                .filter(|other| *other != own && pattern.matches(&case.lenses[*other].name))
                .collect::<Vec<_>>()
        };
        edges.extend(lens.over.iter().flat_map(others).map(|other| (other, own)));
        edges.extend(lens.hides.iter().flat_map(others).map(|other| (other, own)));
        edges.extend(lens.under.iter().flat_map(others).map(|other| (own, other)));
    }
    edges
}

/// Whether taking away lenses that have nothing below them never ends with none left.
pub fn has_cycle(count: usize, edges: &[(usize, usize)]) -> bool {
    let mut left: Vec<usize> = (0..count).collect();
    loop {
        let free = left.iter().position(|lens| !edges.iter().any(|(a, b)| b == lens && left.contains(a)));
        match free {
            Some(i) => left.remove(i),
            None => return !left.is_empty(),
        };
    }
}

/// From the eye to the mean of a flat lens's corners, or along the view direction.
pub fn distance(case: &Case, [x, y, z]: [f64; 3]) -> f64 {
    if case.orthographic { -z } else { (x * x + y * y + z * z).sqrt() }
}

/// Section 3.3 for a file whose lenses stand in the order `file` (positions in the case): lowest first.
pub fn total_order(case: &Case, edges: &[(usize, usize)], file: &[usize]) -> Vec<usize> {
    let lens = |i: usize| &case.lenses[i];
    let mut left: Vec<usize> = file.iter().copied().filter(|i| lens(*i).enabled).collect();
    let mut order = Vec::new();
    while !left.is_empty() {
        let mut ready = left.clone();
        ready.retain(|i| !edges.iter().any(|(below, above)| above == i && left.contains(below)));
        let lowest = ready.iter().map(|i| lens(*i).priority).min().expect("no cycle");
        ready.retain(|i| lens(*i).priority == lowest);
        let mut taken = ready[0];
        if lens(taken).flat.is_some() {
            for candidate in &ready {
                let (Some(at), Some(best)) = (lens(*candidate).flat, lens(taken).flat) else { continue };
                if distance(case, at) > distance(case, best) {
                    taken = *candidate;
                }
            }
        }
        left.retain(|i| *i != taken);
        order.push(taken);
    }
    order
}
