//! Which graphs have an order, which order, and what the error says of those that have none.

use lenspeel::InputError;
use lenspeel::plan::{LensSet, PriorityGraph};
use lenspeel::spec::Pattern;

use crate::case::{Case, random_acyclic, random_edges};
use crate::order::{edges, has_cycle, total_order};
use crate::random::Random;

const CASES: usize = 2000;

fn planned_order(case: &Case) -> Vec<usize> {
    case.plan().lenses.iter().map(|lens| lens.index).collect()
}

#[test]
fn the_total_order_is_that_of_section_3() {
    let mut random = Random::new(10);
    for number in 0..CASES {
        let case = random_acyclic(&mut random, 9, 0.15);
        let file: Vec<usize> = (0..case.lenses.len()).collect();
        let expected = total_order(&case, &edges(&case), &file);
        assert_eq!(planned_order(&case), expected, "case {number}\n{}", case.toml());
    }
}

/// Negative control: the same comparison against the order of a file whose first two lenses stand the other way round.
#[test]
fn an_order_of_another_file_differs_somewhere() {
    let mut random = Random::new(10);
    let differs = |_| {
        let case = random_acyclic(&mut random, 9, 0.15);
        let mut file: Vec<usize> = (0..case.lenses.len()).collect();
        file.swap(0, 1);
        planned_order(&case) != total_order(&case, &edges(&case), &file)
    };
    assert!((0..100).map(differs).filter(|differs| *differs).count() > 10);
}

#[test]
fn exactly_the_graphs_with_a_cycle_are_refused() {
    let mut random = Random::new(11);
    let (mut refused, mut accepted, mut warned) = (0, 0, 0);
    for _ in 0..CASES {
        let case = random_edges(&mut random, 7);
        let (spec, all) = (case.spec(), edges(&case));
        let is_enabled = |lens: &usize| case.lenses[*lens].enabled;
        let between_enabled = all.iter().copied().filter(|(below, above)| is_enabled(below) && is_enabled(above));
        let cyclic = has_cycle(case.lenses.len(), &between_enabled.collect::<Vec<_>>());
        match PriorityGraph::new(&spec) {
            Ok(graph) => {
                assert!(!cyclic, "a cycle was not found\n{}", case.toml());
                accepted += 1;
                // One that only disabled lenses close is a warning that prints it.
                let warnings = graph.idle_cycles(&spec);
                assert_eq!(!warnings.is_empty(), has_cycle(case.lenses.len(), &all), "{}", case.toml());
                for warning in &warnings {
                    let (disabled, _) = warning.split_once(" enabled, ").expect("it says who is disabled");
                    let names = disabled
                        .rsplit("once ")
                        .next()
                        .unwrap_or_default()
                        .trim_end_matches([' ', 'i', 's', 'a', 'r', 'e']);
                    let is_disabled = |name: &str| case.lenses.iter().any(|lens| lens.name == name && !lens.enabled);
                    assert!(names.split(", ").all(is_disabled), "{warning}\n{}", case.toml());
                    assert!(warning.contains("goes in a circle: "), "{warning}");
                }
                warned += usize::from(!warnings.is_empty());
            }
            Err(error) => {
                assert!(cyclic, "there is no cycle: {error}\n{}", case.toml());
                check_cycle(&case, &error);
                refused += 1;
            }
        }
    }
    assert!(refused > CASES / 10 && accepted > CASES / 10, "{refused} refused, {accepted} accepted");
    assert!(warned > CASES / 50, "{warned} warned of");
}

/// The whole cycle is printed, and each edge of it is one that the named line declares.
fn check_cycle(case: &Case, error: &InputError) {
    let text = case.toml();
    let (_, cycle) = error.message.split_once("goes in a circle: ").expect("the message names the cycle");
    let (names, edges) = cycle.split_once(": ").expect("the cycle, then its edges");
    let names: Vec<&str> = names.split(" < ").collect();
    assert!(names.len() > 2 && names.first() == names.last(), "{names:?}");
    let distinct: std::collections::BTreeSet<&str> = names.iter().copied().collect();
    assert_eq!(distinct.len(), names.len() - 1, "{names:?} passes a lens twice");
    let edges: Vec<&str> = edges.split(", ").collect();
    assert_eq!(edges.len(), names.len() - 1);
    assert_eq!(error.labels.len(), edges.len());
    for ((pair, edge), (span, _)) in names.windows(2).zip(edges).zip(&error.labels) {
        let words: Vec<&str> = edge.split(['`', ' ', '(', ')']).filter(|word| !word.is_empty()).collect();
        let ["line", line, key, "puts", below, "below", above] = words[..] else {
            panic!("an edge reads {words:?}");
        };
        assert_eq!([below, above], [pair[0], pair[1]]);
        let line: usize = line.parse().expect("a line number");
        assert!(text.lines().nth(line - 1).is_some_and(|l| l.starts_with(key)), "line {line} has no `{key}`");
        let (owner, other) = if key == "under" { (below, above) } else { (above, below) };
        let block = text[..span.start].rfind("name = ").map(|at| &text[at..]).expect("a lens has a name");
        assert!(block.starts_with(&format!("name = \"{owner}\"")), "line {line} belongs to another lens");
        let pattern = text[span.clone()].trim_matches('"');
        assert!(Pattern::new(pattern).matches(other), "`{pattern}` does not match `{other}`");
        assert_eq!(1 + text[..span.start].matches('\n').count(), line);
    }
}

/// Lenses that are disabled are in no set, and the ranks are those of the enabled ones without a gap.
#[test]
fn ranks_are_those_of_the_enabled_lenses() {
    let mut random = Random::new(12);
    for _ in 0..200 {
        let case = random_acyclic(&mut random, 6, 0.2);
        let plan = case.plan();
        let mut indices: Vec<usize> = plan.lenses.iter().map(|lens| lens.index).collect();
        indices.sort_unstable();
        let enabled: Vec<usize> = (0..case.lenses.len()).filter(|i| case.lenses[*i].enabled).collect();
        assert_eq!(indices, enabled);
        let hides =
            plan.lenses.iter().enumerate().all(|(rank, lens)| lens.hides.minus(LensSet::below(rank)).is_empty());
        assert!(hides, "a lens hides only what is below it");
    }
}
