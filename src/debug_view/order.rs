//! Who acts on each pixel's visible fragment, in the total order.

use super::legend::{Entry, Legend, share_text};
use super::palette::{dimmed, distinct, mix};
use super::sheet::Map;
use crate::drawing::Rgb;
use crate::frame::{Aovs, Frame, InFront};
use crate::output::Actor;
use crate::plan::{LensSet, Plan};

/// Pixels of a stripe of the topmost lens, and of all stripes of those below together.
const STRIPE: i32 = 8;
const COVER: f32 = 0.72;

pub fn draw(plan: &Plan, picture: &Frame, aovs: &Aovs, in_front: &InFront) -> Frame {
    let stack = |at: usize| aovs.region(at).map_or(LensSet::EMPTY, |region| region.stack);
    let color = |at: usize, place: [i32; 2]| match acting(stack(at), place) {
        Some(rank) => mix(dimmed(picture.pixels[at]), distinct(rank), COVER),
        None => dimmed(picture.pixels[at]),
    };
    let label = |index: u32| {
        let stack = aovs.table.get(index as usize)?.stack;
        (!stack.is_empty()).then(|| stack.len().to_string())
    };
    let notes = [
        "Colour: the topmost that acts on the",
        "visible surface; thin stripes: those",
        "below it. Numbers: how many act.",
    ];
    let legend = Legend::new("Order, highest first", &notes, entries(plan, aovs, in_front));
    Map { size: picture.size, values: &aovs.regions, color: &color, label: &label }.with_legend(&legend)
}

/// The rank whose colour a stack shows at a place: half of each stripe is the topmost one's.
fn acting(stack: LensSet, [x, y]: [i32; 2]) -> Option<usize> {
    let top = stack.top()?;
    let below = stack.len() as i32 - 1;
    let along = (x + y).rem_euclid(2 * STRIPE);
    if below == 0 || along < STRIPE {
        return Some(top);
    }
    // The higher, the nearer to the topmost one's stripe.
    let place = (along - STRIPE) * below / STRIPE;
    stack.iter().nth((below - 1 - place) as usize)
}

/// The rules that act somewhere, the last of the file first, then all lenses from the highest down.
fn entries(plan: &Plan, aovs: &Aovs, in_front: &InFront) -> Vec<Entry> {
    let lenses = plan.lenses.len();
    let mut pixels = vec![0usize; lenses + plan.rules.len()];
    for at in 0..aovs.regions.len() {
        if let Some(region) = aovs.region(at) {
            region.stack.iter().for_each(|rank| pixels[rank] += 1);
        }
    }
    let entry = |rank: usize| {
        let name = match plan.rule_of(rank) {
            Some(_) => Actor::of(plan, rank).to_string(),
            None => format!("{}. {}", rank + 1, plan.lenses[rank].name),
        };
        let share = match pixels[rank] {
            0 => "  on nothing visible".to_string(),
            count => share_text(count, aovs.regions.len()),
        };
        let share_of = |counts: &[u64]| share_text(counts[rank] as usize, aovs.regions.len());
        let mut more_lines = Vec::new();
        if in_front.removes[rank] > 0 {
            more_lines.push(format!("takes something away:{}", share_of(&in_front.removes)));
        }
        if in_front.seen_through[rank] > 0 {
            more_lines.push(format!("on what is seen through:{}", share_of(&in_front.seen_through)));
        }
        let filters: Vec<&str> = plan.filter_names(rank).collect();
        let more = match plan.lenses.get(rank) {
            Some(lens) if lens.overrides => "; overrides all below".to_string(),
            Some(lens) if !lens.hides.is_empty() => format!("; hides {}", plan.names(lens.hides).join(", ")),
            _ => String::new(),
        };
        let color: Rgb = distinct(rank);
        let lines = [name + &share, filters.join(", ") + &more].into_iter().chain(more_lines);
        Entry { color, lines: lines.collect() }
    };
    let is_listed = |rank: &usize| *rank < lenses || pixels[*rank] > 0 || in_front.removes[*rank] > 0;
    (0..pixels.len()).rev().filter(is_listed).map(entry).collect()
}
