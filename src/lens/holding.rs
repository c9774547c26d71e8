//! Whether a compound holds a point while one part after the other begins or ends to hold it: a change costs as much as
//! the tree is deep, however many parts there are.

use super::Tree;

/// Has no parent, or no place.
const NONE: u32 = u32::MAX;

/// A tree of parts, flat, with what is known of each of its nodes. Keeps its allocations from tree to tree.
#[derive(Default)]
pub struct Holding {
    nodes: Vec<Node>,
    /// For each part its first place in the tree; a part that stands there several times has a chain of places.
    leaves: Vec<u32>,
}

struct Node {
    parent: u32,
    /// It is taken away from what its parent holds.
    is_negated: bool,
    /// How many of its children, of those it needs, are as it needs them.
    met: u32,
    needed: u32,
    holds: bool,
    /// Of a part: the next place of the same part.
    next: u32,
}

impl Holding {
    /// Starts with a tree of so many parts outside all of them.
    pub fn start(&mut self, tree: &Tree, parts: usize) {
        self.nodes.clear();
        self.leaves.clear();
        self.leaves.resize(parts, NONE);
        self.add(tree, NONE, false);
    }

    fn add(&mut self, tree: &Tree, parent: u32, is_negated: bool) {
        let own = self.nodes.len() as u32;
        let (list, met, needed): (&[Tree], usize, usize) = match tree {
            Tree::Part(_) => (&[], 0, 1),
            Tree::Union(list) => (list, 0, 1),
            Tree::Intersection(list) => (list, 0, list.len()),
            // All but the first must not hold, and nothing does yet.
            Tree::Difference(list) => (list, list.len() - 1, list.len()),
        };
        let next = match tree {
            Tree::Part(part) => std::mem::replace(&mut self.leaves[*part], own),
            _ => NONE,
        };
        self.nodes.push(Node { parent, is_negated, met: met as u32, needed: needed as u32, holds: false, next });
        for (place, child) in list.iter().enumerate() {
            self.add(child, own, place > 0 && matches!(tree, Tree::Difference(_)));
        }
    }

    /// Whether the whole holds the point.
    pub fn holds(&self) -> bool {
        self.nodes.first().is_some_and(|root| root.holds)
    }

    /// A part begins or ends to hold the point; says whether the whole then does.
    pub fn set(&mut self, part: usize, holds: bool) -> bool {
        let mut leaf = self.leaves[part];
        while leaf != NONE {
            self.change(leaf, holds);
            leaf = self.nodes[leaf as usize].next;
        }
        self.holds()
    }

    fn change(&mut self, leaf: u32, holds: bool) {
        let (mut at, mut holds) = (leaf, holds);
        while let Some(node) = self.nodes.get_mut(at as usize).filter(|node| node.holds != holds) {
            node.holds = holds;
            let is_as_needed = holds != node.is_negated;
            at = node.parent;
            let Some(parent) = self.nodes.get_mut(at as usize) else { return };
            parent.met = if is_as_needed { parent.met + 1 } else { parent.met - 1 };
            holds = parent.met >= parent.needed;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

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
    fn changes_one_by_one_say_what_the_tree_says() {
        let mut state = 1u32;
        let mut next = || {
            state = state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            state >> 16
        };
        let mut holding = Holding::default();
        let mut held = 0;
        for _ in 0..500 {
            let tree = tree(4, &mut next);
            holding.start(&tree, 8);
            let mut inside = 0u32;
            for _ in 0..40 {
                let (part, holds) = (next() % 8, next() % 2 == 1);
                inside = inside & !(1 << part) | u32::from(holds) << part;
                let expected = tree.holds(&|part| inside >> part & 1 == 1);
                assert_eq!(holding.set(part as usize, holds), expected, "{tree:?} {inside:b}");
                held += usize::from(expected);
            }
        }
        assert!((2_000..18_000).contains(&held), "{held} of 20,000 hold");
    }
}
