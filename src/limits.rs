//! How large a spec may be, and how much work deciding and drawing it may take: all in one place, so that what is
//! accepted ends. Numbers are generous; a message that refuses says them.

pub use crate::lens::{MAX_LENSES, MAX_PARTS, MAX_RULES};

/// Bytes of a spec file.
pub const MAX_SPEC_BYTES: u64 = 16 << 20;

/// Lenses of one file, disabled ones included.
pub const MAX_WRITTEN_LENSES: usize = 4096;

/// Characters of the name of a lens or an alternate.
pub const MAX_NAME: usize = 256;

/// Pairs of lenses that `over`, `under` and `hides` of one file put in order.
pub const MAX_EDGES: usize = 1 << 20;

/// Planes of polytopes and corners of flat lenses, of all lenses together, disabled ones included. A polytope is cut out
/// plane by plane, which takes time by the square of their number.
pub const MAX_PLANES: usize = 16_384;

/// Comparisons of patterns with names of nodes and materials, and with names of lenses; a few nanoseconds each.
pub const MAX_COMPARISONS: u64 = 1 << 28;

/// Regions that a search lists.
pub const MAX_REGIONS: usize = 1 << 16;

/// Work of a search for regions, about a nanosecond each.
pub const REGION_WORK: u64 = 1_500_000_000;

/// Regions that are not in view of which `explain` tells.
pub const MAX_TOLD: usize = 1000;

/// Loop iterations that a user's own filters (`wgsl`) may take for one picture on the CPU, as
/// [`LOOP_BUDGET`](crate::custom::LOOP_BUDGET) counts them for one call.
pub const FILTER_ITERATIONS: u64 = 1 << 31;

/// Characters of one word, such as a name, in a message; longer ones are cut.
pub const MAX_SHOWN: usize = 512;
