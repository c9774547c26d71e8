//! Random overlap rules.

use super::filter;
use crate::case::{Case, Filter, Rule, When};
use crate::random::Random;

pub fn add(case: &mut Case, random: &mut Random) {
    for _ in 0..1 + random.index(3) {
        let when = condition(case, 0, random);
        let mut filters = vec![Filter::Unlit(Some(super::color(random)))];
        if random.chance(0.5) {
            filters.push(filter::filter(case, random));
        }
        case.rules.push(Rule { when, filters });
    }
}

fn condition(case: &Case, depth: usize, random: &mut Random) -> When {
    let name = |random: &mut Random| {
        let name = &case.lenses[random.index(case.lenses.len())].name;
        When::Name(if random.chance(0.2) { format!("{}*", &name[..1]) } else { name.clone() })
    };
    let part = |random: &mut Random| Box::new(condition(case, depth + 1, random));
    match random.index(if depth < 2 { 6 } else { 2 }) {
        0 | 1 => name(random),
        2 => When::Not(part(random)),
        3 | 4 => When::And(part(random), part(random)),
        _ => When::Or(part(random), part(random)),
    }
}
