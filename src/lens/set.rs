//! Sets of lenses as bits, one bit a rank of the total order.

/// The most lenses one spec may have enabled.
pub const MAX_LENSES: usize = 256;
/// The most overlap rules one spec may have.
pub const MAX_RULES: usize = 128;

const WORDS: usize = (MAX_LENSES + MAX_RULES) / 64;

/// A set of lenses by rank. In a stack the ranks behind the last lens stand for the overlap rules.
#[derive(Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord, Default)]
pub struct LensSet([u64; WORDS]);

impl LensSet {
    pub const EMPTY: LensSet = LensSet([0; WORDS]);

    /// All ranks below `rank`.
    pub fn below(rank: usize) -> Self {
        Self(std::array::from_fn(|word| match rank.saturating_sub(word * 64) {
            0 => 0,
            n if n >= 64 => u64::MAX,
            n => (1 << n) - 1,
        }))
    }

    pub fn insert(&mut self, rank: usize) {
        self.0[rank / 64] |= 1 << (rank % 64);
    }

    pub fn remove(&mut self, rank: usize) {
        self.0[rank / 64] &= !(1 << (rank % 64));
    }

    pub fn contains(&self, rank: usize) -> bool {
        self.0[rank / 64] >> (rank % 64) & 1 == 1
    }

    pub fn is_empty(&self) -> bool {
        self.0.iter().fold(0, |all, word| all | word) == 0
    }

    pub fn len(&self) -> usize {
        self.0.iter().map(|w| w.count_ones() as usize).sum()
    }

    /// The highest rank in the set.
    pub fn top(&self) -> Option<usize> {
        (0..WORDS).rev().find(|w| self.0[*w] != 0).map(|w| w * 64 + 63 - self.0[w].leading_zeros() as usize)
    }

    /// Ranks in rising order.
    pub fn iter(&self) -> impl Iterator<Item = usize> + use<> {
        let words = self.0;
        (0..WORDS).flat_map(move |w| {
            let mut rest = words[w];
            std::iter::from_fn(move || {
                let bit = rest.trailing_zeros();
                (rest != 0).then(|| {
                    rest &= rest - 1;
                    w * 64 + bit as usize
                })
            })
        })
    }

    pub fn minus(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] & !other.0[i]))
    }

    /// The set of one rank.
    pub fn only(rank: usize) -> Self {
        Self::from_iter([rank])
    }

    /// Bits `32 * index ..` as the GPU stores them.
    pub fn word(&self, index: usize) -> u32 {
        (self.0[index / 2] >> (32 * (index % 2))) as u32
    }

    pub fn from_words(words: &[u32]) -> Self {
        let mut set = Self::EMPTY;
        for (i, w) in words.iter().enumerate() {
            set.0[i / 2] |= u64::from(*w) << (32 * (i % 2));
        }
        set
    }
}

impl FromIterator<usize> for LensSet {
    fn from_iter<T: IntoIterator<Item = usize>>(ranks: T) -> Self {
        let mut set = Self::EMPTY;
        ranks.into_iter().for_each(|rank| set.insert(rank));
        set
    }
}

impl std::ops::BitAnd for LensSet {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] & other.0[i]))
    }
}

impl std::ops::BitOr for LensSet {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self(std::array::from_fn(|i| self.0[i] | other.0[i]))
    }
}

impl std::fmt::Debug for LensSet {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_set().entries(self.iter()).finish()
    }
}

#[cfg(test)]
mod tests {
    use super::LensSet;

    #[test]
    fn sets_cross_word_borders() {
        let set: LensSet = [0, 63, 64, 200, 255].into_iter().collect();
        assert_eq!(set.iter().collect::<Vec<_>>(), [0, 63, 64, 200, 255]);
        assert_eq!(set.top(), Some(255));
        assert_eq!(set.len(), 5);
        assert_eq!((set & LensSet::below(64)).iter().collect::<Vec<_>>(), [0, 63]);
        assert_eq!(LensSet::below(256).len(), 256);
        let words: Vec<u32> = (0..8).map(|i| set.word(i)).collect();
        assert_eq!(LensSet::from_words(&words), set);
        assert_eq!(set.minus(LensSet::below(65)).iter().collect::<Vec<_>>(), [200, 255]);
    }
}
