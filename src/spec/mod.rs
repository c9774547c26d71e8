//! The lens-spec file: its typed mirror, exactly as written, before any model is opened.

mod color;
mod pattern;
mod types;

pub use color::Color;
pub use pattern::Pattern;
pub use types::*;
