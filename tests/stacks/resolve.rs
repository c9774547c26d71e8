//! Every set of up to six lenses on random graphs: displayed, S and the stack of every fragment.

use lenspeel::plan::{Instance, Item, LensSet, Plan, survivors};
use lenspeel::spec::Pattern;

use crate::case::{ALTERNATES, Case, random_acyclic, shuffled};
use crate::order::{edges, total_order};
use crate::random::Random;
use crate::worlds::{Displayed, Fragment, Origin, Point};

const CASES: usize = 300;
const MOST_LENSES: usize = 6;

/// Whether a lens of the case names another in `hides`.
fn hides(case: &Case, above: usize, below: usize) -> bool {
    let name = &case.lenses[below].name;
    above != below && case.lenses[above].hides.iter().any(|p| Pattern::new(p.clone()).matches(name))
}

fn origin(plan: &Plan, item: &Item) -> Origin {
    let content = &plan.contents[item.content];
    match (&content.only, content.model) {
        (Some(only), _) => {
            let written = only.nodes[0].to_string();
            let known = ["helper", "bolt", "gear", "cover"].into_iter().find(|name| *name == written);
            Origin::Nodes(known.expect("the case names this node"))
        }
        (None, 0) => Origin::Scene,
        (None, model) => Origin::Alternate(model - 1),
    }
}

/// An item where it stands.
fn in_place<'a>(plan: &'a Plan, item: &Item) -> &'a Instance {
    let is_item = |instance: &&Instance| plan.items[instance.item].first_triangle == item.first_triangle;
    plan.instances.iter().find(is_item).expect("every item stands in place")
}

/// What the plan says of an item at a point inside the given lenses (positions in the file).
fn planned(plan: &Plan, item: &Item, inside: &[usize]) -> Option<Displayed> {
    let ranks: LensSet = (0..plan.lenses.len()).filter(|rank| inside.contains(&plan.lenses[*rank].index)).collect();
    let verdict = plan.walk(in_place(plan, item), |_| ranks);
    let files = |set: LensSet| set.iter().map(|rank| plan.lenses[rank].index).collect();
    verdict.displayed.then(|| Displayed { set: files(verdict.set), stack: files(verdict.stack) })
}

/// How many (set, fragment) pairs the two readings were asked for, and the first on which they differ.
fn compare(case: &Case, order: &[usize]) -> (usize, Option<String>) {
    let plan = case.plan();
    let mut asked = 0;
    for bits in 0..1usize << case.lenses.len() {
        let inside: Vec<usize> = (0..case.lenses.len()).filter(|i| bits >> i & 1 == 1).collect();
        let point = Point {
            case,
            order,
            inside: &|lens| inside.contains(&lens),
            hides: &|above, below| hides(case, above, below),
        };
        for item in &plan.items {
            let fragment = Fragment { origin: origin(&plan, item), node: item.node };
            let (planned, literal) = (planned(&plan, item, &inside), point.displayed(fragment));
            asked += 1;
            if planned != literal {
                let text = format!("inside {inside:?}, {fragment:?}: plan {planned:?}, literally {literal:?}");
                return (asked, Some(format!("{text}\n{}", case.toml())));
            }
        }
    }
    (asked, None)
}

#[test]
fn every_set_resolves_as_the_chain_of_worlds_says() {
    let mut random = Random::new(1);
    let mut asked = 0;
    for number in 0..CASES {
        let case = random_acyclic(&mut random, MOST_LENSES, 0.25);
        let file: Vec<usize> = (0..case.lenses.len()).collect();
        let (count, difference) = compare(&case, &total_order(&case, &edges(&case), &file));
        assert!(difference.is_none(), "case {number}: {}", difference.unwrap_or_default());
        asked += count;
    }
    assert!(asked > 20 * CASES, "only {asked} fragments were compared");
}

/// The cases reach what they are made for.
#[test]
fn the_cases_have_shown_and_erased_fragments_and_hidden_lenses() {
    let mut random = Random::new(1);
    let (mut shown, mut gone, mut hidden, mut object) = (0, 0, 0, 0);
    for _ in 0..CASES {
        let plan = random_acyclic(&mut random, MOST_LENSES, 0.25).plan();
        let all: Vec<usize> = plan.lenses.iter().map(|lens| lens.index).collect();
        for item in &plan.items {
            match planned(&plan, item, &all) {
                None => gone += 1,
                Some(displayed) => {
                    shown += usize::from(item.is_alternate());
                    hidden += usize::from(displayed.set != displayed.stack);
                    object += usize::from(!item.object.is_empty());
                }
            }
        }
    }
    assert!(shown > 100 && gone > 100 && hidden > 100 && object > 50, "{shown} {gone} {hidden} {object}");
}

/// The fragments that the scene has and those that any content has are the items of the plan, no more and no fewer.
#[test]
fn items_are_the_fragments_of_the_contents() {
    let mut random = Random::new(2);
    for _ in 0..CASES {
        let plan = random_acyclic(&mut random, MOST_LENSES, 0.25).plan();
        for (index, content) in plan.contents.iter().enumerate() {
            let items: Vec<&Item> = plan.items.iter().filter(|item| item.content == index).collect();
            let origin = items.first().map_or(Origin::Scene, |item| origin(&plan, item));
            assert_eq!(content.model == 0, !matches!(origin, Origin::Alternate(_)));
            let nodes: Vec<usize> = items.iter().map(|item| item.node).collect();
            let expected: Vec<usize> =
                (0..origin.rows().len()).filter(|node| Fragment { origin, node: *node }.exists()).collect();
            assert_eq!(nodes, expected, "{origin:?}");
        }
        assert!(plan.contents.len() <= 1 + ALTERNATES.len() + 4);
    }
}

/// Negative control: with two lenses swapped in the literal reading, some fragment must differ.
#[test]
fn a_swapped_pair_of_lenses_is_noticed() {
    let mut random = Random::new(3);
    let (mut swapped, mut noticed) = (0, 0);
    for _ in 0..CASES {
        let case = random_acyclic(&mut random, MOST_LENSES, 0.25);
        let file: Vec<usize> = (0..case.lenses.len()).collect();
        let mut order = total_order(&case, &edges(&case), &file);
        if let [a, b, ..] = shuffled(&mut random, order.len())[..] {
            order.swap(a, b);
            swapped += 1;
            noticed += usize::from(compare(&case, &order).1.is_some());
        }
    }
    // Not all: the scopes of some pairs have no fragment in common.
    assert!(noticed * 2 > swapped && swapped > 50, "{noticed} of {swapped} swaps were noticed");
}

/// The stack of a region, found without regard to content, is that of a surface on which nothing removes content.
#[test]
fn survivors_of_a_region_are_those_of_an_untouched_fragment() {
    let mut random = Random::new(4);
    for _ in 0..CASES {
        let plan = random_acyclic(&mut random, MOST_LENSES, 0.25).plan();
        for item in plan.items.iter().filter(|item| !item.is_alternate()) {
            for bits in 0..1usize << plan.lenses.len() {
                let inside: LensSet = (0..plan.lenses.len()).filter(|rank| bits >> rank & 1 == 1).collect();
                let verdict = plan.walk(in_place(&plan, item), |_| inside);
                assert_eq!(verdict.stack, survivors(&plan.lenses, verdict.set));
            }
        }
    }
}
