//! Appearance, translated from `shaders/appearance/*.wgsl` at build time: filters, lighting, glass.
#![allow(clippy::all, clippy::pedantic, unused, missing_docs)]

include!(concat!(env!("OUT_DIR"), "/appearance.rs"));

/// The WGSL this module was made from.
pub const WGSL: &str = include_str!(concat!(env!("OUT_DIR"), "/appearance.wgsl"));
