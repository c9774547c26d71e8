//! Pictures and AOVs as files.

mod aov;
mod file;
mod png;
mod regions;

pub use aov::{Aov, EncodedAov, encode_aov};
pub(crate) use file::folder_of;
pub use file::{Place, write_whole};
pub use png::{encode_picture, write_picture};
pub use regions::{Actor, Entry, FoundRegion, RegionMap, numbered, stack};
