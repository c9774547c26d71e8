//! Pictures and AOVs as files.

mod aov;
mod file;
mod png;
mod regions;

pub use aov::{Aov, write_aov};
pub use file::write_whole;
pub use png::write_picture;
pub use regions::{Actor, Entry, FoundRegion, RegionMap, numbered, stack};
