//! Storage whose size only drawing shows: a frame that needs more is drawn again with room for it.

/// How much room a frame has, or needs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Room {
    /// Listed fragments of a window.
    pub fragments: u64,
    /// Crossings of one ray with one mesh of a lens.
    pub crossings: u32,
}

/// Words a sample in the counters that a frame leaves.
pub const COUNTERS: u64 = 2;

impl Room {
    /// The room that a renderer starts with. More than eight crossings with one mesh are rare.
    pub const FIRST: Room = Room { fragments: 64, crossings: 8 };

    /// What all samples of a frame need, from the counters that the frame has left: for each sample two words (u32).
    pub fn needed(counters: &[u8]) -> Self {
        let mut needed = Room { fragments: 0, crossings: 0 };
        for sample in counters.chunks_exact(4 * COUNTERS as usize) {
            let word = |at: usize| u32::from_le_bytes([sample[at], sample[at + 1], sample[at + 2], sample[at + 3]]);
            needed = needed.max(Room { fragments: u64::from(word(0)), crossings: word(4) });
        }
        needed
    }

    /// Enough for both.
    pub fn max(self, other: Self) -> Self {
        Self { fragments: self.fragments.max(other.fragments), crossings: self.crossings.max(other.crossings) }
    }

    pub fn holds(&self, needed: Self) -> bool {
        needed.fragments <= self.fragments && needed.crossings <= self.crossings
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_largest_sample_counts() {
        let counters: Vec<u8> = [3u32, 9, 7, 2].iter().flat_map(|w| w.to_le_bytes()).collect();
        let needed = Room::needed(&counters);
        assert_eq!(needed, Room { fragments: 7, crossings: 9 });
        assert!(!Room { fragments: 7, crossings: 8 }.holds(needed));
        assert!(!Room { fragments: 6, crossings: 9 }.holds(needed));
        assert!(Room { fragments: 7, crossings: 9 }.holds(needed));
    }
}
