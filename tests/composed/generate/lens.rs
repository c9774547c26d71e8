//! Random lenses: where they stand, what they are limited to, and an order without a circle.

use glam::DVec3;

use super::{filter, pick, point, rounded, shape, tidy};
use crate::case::{Attach, Case, Filter, Lens, Patterns, Rotation};
use crate::oracle::matches;
use crate::random::Random;

/// First letters of the names; patterns name all lenses of a letter.
const LETTERS: [&str; 3] = ["a", "b", "c"];

/// Adds so many lenses; so many filters of theirs move content.
pub fn add(case: &mut Case, count: usize, movers: usize, random: &mut Random) {
    let moving: Vec<usize> = (0..movers).map(|_| random.index(count)).collect();
    for i in 0..count {
        let name = format!("{}{i}", pick(random, &LETTERS));
        let mut lens = lens(case, name, moving.contains(&i), random);
        // Some have the volume of another.
        if i > 0 && random.chance(0.06) {
            let other = &case.lenses[random.index(i)];
            (lens.shape, lens.attach) = (other.shape.clone(), other.attach.clone());
            (lens.translation, lens.rotation, lens.scale) = (other.translation, other.rotation, other.scale);
        }
        case.lenses.push(lens);
    }
    edges(case, random);
}

/// Makes a lens soft.
pub fn fade_one(case: &mut Case, random: &mut Random) {
    let lens = random.index(case.lenses.len());
    case.lenses[lens].soft = tidy(random.between(0.02, 0.15));
}

/// Makes a lens cut something and close it.
pub fn cap_one(case: &mut Case, random: &mut Random) {
    let number = random.index(case.lenses.len());
    let is_solid = |name: &str| name.starts_with("box") || name.starts_with("ball");
    let solids: Vec<String> = case.models[0].nodes.iter().map(|n| n.name.clone()).filter(|n| is_solid(n)).collect();
    let lens = &mut case.lenses[number];
    (lens.enabled, lens.by_object) = (true, false);
    (lens.only, lens.except) = (Patterns::default(), Patterns::default());
    let mut what = if random.chance(0.5) { Patterns::default() } else { filter::patterns(random) };
    if !solids.is_empty() {
        let solid = pick(random, &solids).clone();
        if random.chance(0.7) {
            // Solids lie across each other, and whose cap is seen there is not said.
            what = Patterns { nodes: vec![solid.clone()], materials: Vec::new() };
        }
        (lens.attach, lens.shape) = (Attach::Node(solid), shape::simple(random));
        lens.translation = rounded(point(random, 0.3));
    }
    lens.filters = vec![Filter::Erase(what, Some(filter::cap(random)))];
}

fn lens(case: &Case, name: String, moves: bool, random: &mut Random) -> Lens {
    let attach = attach(case, random);
    // What hangs on the camera stands before it.
    let offset = if matches!(attach, Attach::Camera) { DVec3::Z * -random.between(1.0, 4.0) } else { DVec3::ZERO };
    let filters = filter::list(case, moves, random);
    // Volumes that erase everything, or bring content in, are enough to see if there are few of them.
    let limited = if filters.iter().any(removes) { 0.5 } else { 0.25 };
    let patterns = |share: f64, random: &mut Random| {
        if random.chance(share) { filter::patterns(random) } else { Patterns::default() }
    };
    Lens {
        name,
        enabled: random.chance(0.93),
        shape: shape::shape(case, random),
        attach,
        translation: rounded(offset + if random.chance(0.5) { point(random, 0.4) } else { DVec3::ZERO }),
        rotation: if random.chance(0.4) { shape::rotation(random) } else { Rotation::Euler([0.0; 3]) },
        scale: scale(random),
        filters,
        over: Vec::new(),
        under: Vec::new(),
        hides: Vec::new(),
        overrides: random.chance(0.08),
        priority: [0, 0, 0, 1, -1][random.index(5)],
        by_object: random.chance(0.15),
        only: patterns(limited, random),
        except: patterns(0.15, random),
        soft: if !case.solids.is_empty() && random.chance(0.1) { tidy(random.between(0.02, 0.15)) } else { 0.0 },
        glass: random.chance(0.04),
    }
}

fn removes(filter: &Filter) -> bool {
    matches!(filter, Filter::Erase(..) | Filter::ShowAlternate(_) | Filter::ShowNodes(_))
}

fn attach(case: &Case, random: &mut Random) -> Attach {
    match random.index(10) {
        0 => Attach::Camera,
        1 | 2 => Attach::Node(pick(random, &case.models[0].nodes).name.clone()),
        _ => Attach::Scene,
    }
}

fn scale(random: &mut Random) -> DVec3 {
    let one = |random: &mut Random| random.between(0.6, 1.6) * if random.chance(0.1) { -1.0 } else { 1.0 };
    match random.index(5) {
        0 => DVec3::splat(tidy(one(random))),
        1 | 2 => rounded(DVec3::new(one(random), one(random), one(random))),
        _ => DVec3::ONE,
    }
}

/// Edges that all lead upwards in some hidden order, so that there is no circle; a pattern where all that it matches does.
fn edges(case: &mut Case, random: &mut Random) {
    let count = case.lenses.len();
    let mut place: Vec<usize> = (0..count).collect();
    (1..count).for_each(|i| place.swap(i, random.index(i + 1)));
    let share = random.between(0.0, 0.3) * (6.0 / count as f64).min(1.0);
    for own in 0..count {
        for other in 0..count {
            if own == other || !random.chance(share) {
                continue;
            }
            let is_above = place[own] > place[other];
            let name = case.lenses[other].name.clone();
            let pattern = format!("{}*", &name[..1]);
            let fits = |i: usize| i == own || (place[own] > place[i]) == is_above;
            let all_fit = (0..count).filter(|i| matches(&pattern, &case.lenses[*i].name)).all(fits);
            let written = if all_fit && random.chance(0.4) { pattern } else { name };
            let lens = &mut case.lenses[own];
            match (is_above, random.index(2)) {
                (false, _) => lens.under.push(written),
                (true, 0) => lens.over.push(written),
                (true, _) => lens.hides.push(written),
            }
        }
    }
}
