//! The tree of a lens, or the condition of a rule, as a program in postfix order: twin of `shaders/gpu/program.wgsl`.

use std::cmp::Reverse;

use crate::lens::Tree;
use crate::plan::{LensSet, Test};

const INSIDE: u32 = 0;
const OUTSIDE: u32 = 1;
const BOTH: u32 = 2;
const EITHER: u32 = 3;

/// The program of a tree: a word for each part, and one for each two values that become one.
pub fn program(tree: &Tree) -> Vec<u32> {
    tree_code(tree, false).words
}

/// The program of a rule's condition, with the sets of lenses that its words number: one of a set must be there.
pub fn condition(test: &Test) -> (Vec<LensSet>, Vec<u32>) {
    let mut names = Vec::new();
    let words = test_code(test, false, &mut names).words;
    (names, words)
}

/// Whether a tree is all its parts in turn, joined in one way: then a count of them tells what its program does.
pub fn is_flat(tree: &Tree) -> bool {
    let (Tree::Union(list) | Tree::Intersection(list) | Tree::Difference(list)) = tree else { return false };
    list.len() > 1 && list.iter().enumerate().all(|(number, part)| *part == Tree::Part(number))
}

struct Code {
    words: Vec<u32>,
    /// How many values it holds at once.
    depth: usize,
}

impl Code {
    fn leaf(number: usize, negated: bool) -> Self {
        Self { words: vec![(number as u32) << 2 | if negated { OUTSIDE } else { INSIDE }], depth: 1 }
    }

    /// The deepest first, so that the depth grows like the logarithm of the leaves (Sethi and Ullman 1970) and the
    /// shader's 32 bits are enough for any tree.
    fn join(mut codes: Vec<Code>, both: bool) -> Self {
        codes.sort_by_key(|code| Reverse(code.depth));
        let mut joined = Self { words: Vec::new(), depth: 0 };
        for (i, code) in codes.into_iter().enumerate() {
            joined.depth = joined.depth.max(code.depth + usize::from(i > 0));
            joined.words.extend(code.words);
            joined.words.extend((i > 0).then_some(if both { BOTH } else { EITHER }));
        }
        joined
    }
}

/// A part that is taken away is asked whether it is outside, so there are no differences.
fn tree_code(tree: &Tree, negated: bool) -> Code {
    let (list, is_intersection) = match tree {
        Tree::Part(part) => return Code::leaf(*part, negated),
        Tree::Union(list) => (list, false),
        Tree::Intersection(list) | Tree::Difference(list) => (list, true),
    };
    let is_taken_away = |i: usize| i > 0 && matches!(tree, Tree::Difference(_));
    let codes = list.iter().enumerate().map(|(i, part)| tree_code(part, negated != is_taken_away(i)));
    Code::join(codes.collect(), is_intersection != negated)
}

fn test_code(test: &Test, negated: bool, names: &mut Vec<LensSet>) -> Code {
    match test {
        Test::Any(lenses) => {
            names.push(*lenses);
            Code::leaf(names.len() - 1, negated)
        }
        Test::Not(inner) => test_code(inner, !negated, names),
        Test::And(left, right) | Test::Or(left, right) => {
            let codes = vec![test_code(left, negated, names), test_code(right, negated, names)];
            Code::join(codes, matches!(test, Test::And(..)) != negated)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What the shader does.
    fn run(words: &[u32], inside: u32) -> bool {
        let mut stack = 0u32;
        for word in words {
            stack = match word & 3 {
                BOTH => stack >> 1 & (stack | !1),
                EITHER => stack >> 1 | stack & 1,
                kind => stack << 1 | u32::from((inside >> (word >> 2) & 1 == 1) == (kind == INSIDE)),
            };
        }
        stack & 1 == 1
    }

    fn tree(depth: u32, next: &mut impl FnMut() -> u32) -> Tree {
        if depth == 0 {
            return Tree::Part(next() as usize % 8);
        }
        let list = (0..1 + next() % 3).map(|_| tree(next() % depth, next)).collect();
        match next() % 3 {
            0 => Tree::Union(list),
            1 => Tree::Intersection(list),
            _ => Tree::Difference(list),
        }
    }

    #[test]
    fn programs_say_what_their_trees_say() {
        let mut state = 1u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state >> 16
        };
        for _ in 0..300 {
            let tree = tree(4, &mut next);
            let words = program(&tree);
            for inside in 0..256 {
                assert_eq!(run(&words, inside), tree.holds(&|part| inside >> part & 1 == 1), "{tree:?}");
            }
        }
    }

    #[test]
    fn conditions_say_what_their_tests_say() {
        let any = |lens: usize| Box::new(Test::Any(LensSet::only(lens)));
        let either = Test::Or(any(3), Box::new(Test::Not(any(4))));
        let test = Test::Not(Box::new(Test::And(any(5), Box::new(either))));
        let (names, words) = condition(&test);
        for lenses in 0..64u32 {
            let set: LensSet = (0..6).filter(|lens| lenses >> lens & 1 == 1).collect();
            let met = |(i, name): (usize, &LensSet)| u32::from(!(*name & set).is_empty()) << i;
            assert_eq!(run(&words, names.iter().enumerate().map(met).sum()), test.holds(set), "{set:?}");
        }
    }

    /// What the shader does with a flat lens.
    #[test]
    fn counts_say_what_flat_trees_say() {
        let parts = || (0..5).map(Tree::Part).collect();
        for tree in [Tree::Union(parts()), Tree::Intersection(parts()), Tree::Difference(parts())] {
            assert!(is_flat(&tree));
            let words = program(&tree);
            let token = |part: usize| words[(2 * part).saturating_sub(1)];
            for inside in 0..32u32 {
                let is_met = |part: &usize| (inside >> part & 1 == 1) == (token(*part) & 3 == INSIDE);
                let met = (0..5).filter(is_met).count();
                let needed = if words[2] & 3 == BOTH { 5 } else { 1 };
                assert_eq!(met >= needed, tree.holds(&|part| inside >> part & 1 == 1), "{tree:?} {inside:b}");
            }
        }
        assert!(!is_flat(&Tree::Part(0)));
        assert!(!is_flat(&Tree::Union(vec![Tree::Part(1), Tree::Part(0)])));
        assert!(!is_flat(&Tree::Union(vec![Tree::Part(0), Tree::Union(parts())])));
    }

    #[test]
    fn a_chain_of_any_length_needs_two_values() {
        let chain = (1..1000).fold(Tree::Part(0), |tree, part| Tree::Difference(vec![Tree::Part(part), tree]));
        assert_eq!(tree_code(&chain, false).depth, 2);
    }
}
