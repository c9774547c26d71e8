//! How the parts of a volume are put together.

/// The most parts that the enabled lenses of one spec may have together.
pub const MAX_PARTS: usize = 1024;

/// Union, intersection and difference over parts; every list has at least one entry.
#[derive(Debug, Clone, PartialEq)]
pub enum Tree {
    /// Into [`super::Volume::parts`].
    Part(usize),
    Union(Vec<Tree>),
    Intersection(Vec<Tree>),
    /// The first less the others.
    Difference(Vec<Tree>),
}

/// What the three ways of putting together mean to some property of parts.
pub struct Algebra<T> {
    pub union: fn(T, T) -> T,
    pub intersection: fn(T, T) -> T,
    pub difference: fn(T, T) -> T,
}

impl Tree {
    /// The property of the whole from that of each part.
    pub fn fold<T>(&self, algebra: &Algebra<T>, part: &impl Fn(usize) -> T) -> Option<T> {
        let (list, join) = match self {
            Tree::Part(index) => return Some(part(*index)),
            Tree::Union(list) => (list, algebra.union),
            Tree::Intersection(list) => (list, algebra.intersection),
            Tree::Difference(list) => (list, algebra.difference),
        };
        list.iter().filter_map(|tree| tree.fold(algebra, part)).reduce(join)
    }

    /// Whether a point is in the whole, given which parts hold it.
    pub fn holds(&self, inside: &impl Fn(usize) -> bool) -> bool {
        let algebra =
            Algebra { union: |a, b| a || b, intersection: |a, b| a && b, difference: |a: bool, b: bool| a && !b };
        self.fold(&algebra, inside).unwrap_or(false)
    }

    /// The parts between which the whole lies: all but those that are only taken away.
    pub fn added_parts(&self) -> Vec<usize> {
        let both = |mut a: Vec<usize>, b: Vec<usize>| {
            a.extend(b);
            a
        };
        let algebra = Algebra { union: both, intersection: both, difference: |a, _| a };
        self.fold(&algebra, &|part| vec![part]).unwrap_or_default()
    }
}

#[cfg(test)]
mod tests {
    use super::Tree::{self, Difference, Intersection, Part, Union};

    fn rows(tree: &Tree) -> Vec<usize> {
        (0..8).filter(|row| tree.holds(&|part| row >> part & 1 == 1)).collect()
    }

    #[test]
    fn lists_nest_and_a_difference_takes_all_others_away() {
        let three = || vec![Part(0), Part(1), Part(2)];
        assert_eq!(rows(&Union(three())), [1, 2, 3, 4, 5, 6, 7]);
        assert_eq!(rows(&Intersection(three())), [7]);
        assert_eq!(rows(&Difference(three())), [1]);
        let shared = Intersection(vec![Part(1), Part(2)]);
        assert_eq!(rows(&Difference(vec![Part(0), shared.clone()])), [1, 3, 5]);
        assert_eq!(rows(&Union(vec![Part(0), shared])), [1, 3, 5, 6, 7]);
    }

    #[test]
    fn what_is_taken_away_from_what_is_taken_away_is_not_added() {
        let tree = Difference(vec![Union(vec![Part(0), Part(3)]), Difference(vec![Part(1), Part(2)])]);
        assert_eq!(tree.added_parts(), [0, 3]);
    }
}
