//! The tester tested: an oracle that is told something else than the product must be seen to disagree.

use std::path::Path;

use glam::DVec3;

use crate::case::{Case, Displacement, Filter};
use crate::check::{Answers, check};
use crate::product::Party;
use crate::{files, generate};

/// Seeds that are looked at, how many of them must have what is changed, and how many such cases are enough.
const SEEDS: u64 = 80;
const LEAST: usize = 5;
const ENOUGH: usize = 12;

/// What is changed in a case before the oracle reads it; `false` where there is nothing to change, or nothing of it seen.
type Change = fn(&mut Case, &Answers) -> bool;

/// A control by name, and the least share of changed cases that must be noticed.
pub type Control = (&'static str, Change, f64);

/// Not every change shows: a declared edge may outweigh a priority, an upper lens hide what a lower one does.
pub const ALL: [Control; 8] = [
    ("a-lens-above-another", above_another, 0.6),
    ("a-shifted-lens", shifted, 0.8),
    ("a-lens-that-is-missing", missing, 1.0),
    ("a-lens-that-overrides", overrides, 0.5),
    ("a-lens-for-other-nodes", for_other_nodes, 0.9),
    ("cuts-that-stay-open", without_caps, 1.0),
    ("movers-that-move-more", moves_more, 0.8),
    ("rules-that-are-missing", without_rule, 1.0),
];

fn above_another(case: &mut Case, answers: &Answers) -> bool {
    let seen = answers.most_lenses();
    if seen.len() > 1 {
        case.lenses[seen[0]].priority += 10;
    }
    seen.len() > 1
}

fn shifted(case: &mut Case, answers: &Answers) -> bool {
    let lens = answers.most_lenses().first().copied();
    lens.inspect(|lens| case.lenses[*lens].translation += DVec3::new(0.4, 0.3, -0.3)).is_some()
}

fn missing(case: &mut Case, answers: &Answers) -> bool {
    let lens = answers.most_lenses().first().copied();
    lens.inspect(|lens| case.lenses[*lens].enabled = false).is_some()
}

fn overrides(case: &mut Case, answers: &Answers) -> bool {
    let seen = answers.most_lenses();
    if let [_, .., top] = seen[..] {
        case.lenses[top].overrides ^= true;
    }
    seen.len() > 1
}

fn for_other_nodes(case: &mut Case, answers: &Answers) -> bool {
    let lens = answers.most_lenses().first().copied();
    lens.inspect(|lens| case.lenses[*lens].except.nodes.push("*".into())).is_some()
}

fn moves_more(case: &mut Case, answers: &Answers) -> bool {
    for filter in case.lenses.iter_mut().flat_map(|lens| &mut lens.filters) {
        match filter {
            Filter::Magnify { factor, .. } => *factor *= 1.2,
            Filter::Displace { by: Displacement::Offset(offset), .. } => offset.y += 0.2,
            Filter::Displace { by: Displacement::Explode(factor), .. } => *factor += 0.3,
            _ => {}
        }
    }
    answers.tally().moved > 0
}

fn without_caps(case: &mut Case, answers: &Answers) -> bool {
    let lenses = case.lenses.iter_mut().map(|lens| &mut lens.filters);
    for filter in lenses.chain(case.rules.iter_mut().map(|rule| &mut rule.filters)).flatten() {
        if let Filter::Erase(_, cap) = filter {
            *cap = None;
        }
    }
    answers.tally().capped > 0
}

fn without_rule(case: &mut Case, answers: &Answers) -> bool {
    case.rules.clear();
    answers.tally().ruled > 0
}

/// Every seed's picture against the answers to the changed case.
pub fn run((name, change, least): Control) -> Result<(), String> {
    let (mut changed, mut noticed) = (0, 0);
    for seed in 0..SEEDS {
        if changed == ENOUGH {
            break;
        }
        let case = generate::case(seed);
        let mut other = case.clone();
        if !change(&mut other, &Answers::new(&case, seed)) {
            continue;
        }
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("composed").join(format!("{name}-{seed}"));
        changed += 1;
        let outcome = check(&files::write(&case, &folder), &Answers::new(&other, seed), Party::Cpu);
        noticed += usize::from(outcome.is_err_and(|text| text.contains("is expected")));
        std::fs::remove_dir_all(&folder).map_err(|error| error.to_string())?;
    }
    if changed < LEAST || (noticed as f64) < least * changed as f64 {
        return Err(format!("of {changed} changed cases {noticed} are noticed"));
    }
    Ok(())
}
