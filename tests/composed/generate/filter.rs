//! Random filters, most of them such that their colours are known.

use super::scene::{MATERIAL_PATTERNS, NODE_PATTERNS};
use super::{color, pick, point, rounded, tidy};
use crate::case::{Cap, Case, Displacement, Filter, Patterns};
use crate::random::Random;

/// One or two of a lens; `moves`: a mover may be among them.
pub fn list(case: &Case, moves: bool, random: &mut Random) -> Vec<Filter> {
    let mut filters: Vec<Filter> = (0..1 + random.index(2)).map(|_| filter(case, random)).collect();
    if moves {
        let at = random.index(filters.len() + 1);
        filters.insert(at, mover(random));
    }
    filters
}

pub fn filter(case: &Case, random: &mut Random) -> Filter {
    let amount = |random: &mut Random| tidy(random.between(0.1, 1.0));
    match random.index(100) {
        0..42 => Filter::Unlit(random.chance(0.9).then(|| color(random))),
        42..54 => Filter::Opacity(if random.chance(0.15) { 0.0 } else { tidy(random.between(0.2, 0.9)) }),
        54..64 => Filter::Tint(color(random), amount(random)),
        64..66 => Filter::Grayscale(amount(random)),
        66..68 => Filter::Invert(amount(random)),
        68..72 => Filter::Material(color(random)),
        72..74 => Filter::Normals,
        74..78 => Filter::Wireframe {
            width: tidy(random.between(2.5, 7.0)),
            color: random.chance(0.5).then(|| super::opaque(random)),
            filled: random.chance(0.4),
        },
        78..90 => Filter::Erase(
            if random.chance(0.4) { Patterns::default() } else { patterns(random) },
            (!case.solids.is_empty() && random.chance(0.7)).then(|| cap(random)),
        ),
        _ => show(case, random),
    }
}

/// Most are seen in colours that are known.
pub fn cap(random: &mut Random) -> Cap {
    match random.index(6) {
        0 => Cap::Hatch(color(random)),
        1 => Cap::Color(color(random)),
        _ => Cap::Own,
    }
}

fn show(case: &Case, random: &mut Random) -> Filter {
    let alternates = case.models.len() - 1;
    if alternates > 0 && random.chance(0.8) {
        return Filter::ShowAlternate(1 + random.index(alternates));
    }
    let scene = &case.models[0].nodes;
    Filter::ShowNodes(vec![pick(random, scene).name.clone()])
}

pub fn mover(random: &mut Random) -> Filter {
    match random.index(4) {
        0 | 1 => Filter::Magnify {
            factor: tidy(if random.chance(0.8) { random.between(1.2, 2.5) } else { random.between(0.5, 0.9) }),
            center: random.chance(0.3).then(|| rounded(point(random, 0.4))),
        },
        kind => Filter::Displace {
            nodes: if random.chance(0.5) { Vec::new() } else { vec![pick(random, &NODE_PATTERNS).to_string()] },
            by: match kind {
                2 => Displacement::Offset(rounded(point(random, 0.4))),
                _ => Displacement::Explode(tidy(random.between(-0.4, 0.8))),
            },
        },
    }
}

/// One or two patterns of nodes or materials.
pub fn patterns(random: &mut Random) -> Patterns {
    let mut patterns = Patterns::default();
    for _ in 0..1 + random.index(2) {
        match random.chance(0.6) {
            true => patterns.nodes.push(pick(random, &NODE_PATTERNS).to_string()),
            false => patterns.materials.push(pick(random, &MATERIAL_PATTERNS).to_string()),
        }
    }
    patterns
}
