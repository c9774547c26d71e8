//! The tree of a lens as a program in postfix order: twin of `shaders/gpu/program.wgsl`.

use std::cmp::Reverse;

use crate::lens::Tree;

const INSIDE: u32 = 0;
const OUTSIDE: u32 = 1;
const BOTH: u32 = 2;
const EITHER: u32 = 3;

/// The program of a tree: a word for each part, and one for each two values that become one.
pub fn program(tree: &Tree) -> Vec<u32> {
    code(tree, false).words
}

struct Code {
    words: Vec<u32>,
    /// How many values it holds at once.
    depth: usize,
}

/// A part that is taken away is asked whether it is outside, so there are no differences.
fn code(tree: &Tree, negated: bool) -> Code {
    let (list, is_intersection) = match tree {
        Tree::Part(part) => {
            let word = (*part as u32) << 2 | if negated { OUTSIDE } else { INSIDE };
            return Code { words: vec![word], depth: 1 };
        }
        Tree::Union(list) => (list, false),
        Tree::Intersection(list) | Tree::Difference(list) => (list, true),
    };
    let is_taken_away = |i: usize| i > 0 && matches!(tree, Tree::Difference(_));
    let mut codes: Vec<Code> = list.iter().enumerate().map(|(i, t)| code(t, negated != is_taken_away(i))).collect();
    // The deepest first, so that the depth grows like the logarithm of the parts (Sethi and Ullman 1970) and the
    // shader's 32 bits are enough for any tree.
    codes.sort_by_key(|code| Reverse(code.depth));
    let join = if is_intersection != negated { BOTH } else { EITHER };
    let mut joined = Code { words: Vec::new(), depth: 0 };
    for (i, code) in codes.into_iter().enumerate() {
        joined.depth = joined.depth.max(code.depth + usize::from(i > 0));
        joined.words.extend(code.words);
        joined.words.extend((i > 0).then_some(join));
    }
    joined
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
    fn a_chain_of_any_length_needs_two_values() {
        let chain = (1..1000).fold(Tree::Part(0), |tree, part| Tree::Difference(vec![Tree::Part(part), tree]));
        assert_eq!(code(&chain, false).depth, 2);
    }
}
