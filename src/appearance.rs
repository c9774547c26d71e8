//! Appearance, translated from `shaders/appearance/*.wgsl` and `shaders/filters/*.wgsl` at build time: filters, lighting,
//! glass.
#![allow(clippy::all, clippy::pedantic, unused, missing_docs)]

include!(concat!(env!("OUT_DIR"), "/appearance.rs"));

/// The WGSL this module was made from.
pub const WGSL: &str = include_str!(concat!(env!("OUT_DIR"), "/appearance.wgsl"));

/// The same without the constants `HAS_...` that say which filters there are.
pub const FUNCTIONS: &str = include_str!(concat!(env!("OUT_DIR"), "/functions.wgsl"));

/// What stands in a filter's file.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilterFile {
    pub name: &'static str,
    /// What it does, for its users.
    pub text: &'static str,
    /// Whether it works on surfaces before they are lit, on lit colours, on coverage.
    pub stages: [bool; 3],
}

// The filters by the number that `OP_...` gives them.
include!(concat!(env!("OUT_DIR"), "/filters.rs"));
