//! What can go wrong on a graphics device, with numbers.

use crate::frame::NoMemory;

/// A picture that this device cannot make.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum Error {
    #[error("no graphics adapter{wanted}; found: {found}")]
    NoAdapter {
        /// What was asked for, starting with a space, or empty.
        wanted: String,
        /// All adapters there are, or "none".
        found: String,
    },
    #[error("the {adapter} has not enough {what}")]
    Lacking { adapter: String, what: String },
    #[error("the device could not be opened: {0}")]
    Device(String),
    #[error("{what} need {needed} bytes, and the device allows {allowed}")]
    TooLarge { what: String, needed: u64, allowed: u64 },
    #[error("the texture {name} is {size} pixels wide or high, and the device allows {allowed}")]
    TextureTooLarge { name: String, size: u32, allowed: u32 },
    #[error("the textures need {needed} pages of {page} pixels squared, and the device allows {allowed}")]
    TooManyTextures { needed: u32, page: u32, allowed: u32 },
    #[error("the device has no room for {what} ({bytes} bytes): {reason}")]
    NoRoom { what: String, bytes: u64, reason: String },
    #[error(transparent)]
    NoMemory(#[from] NoMemory),
    #[error("the plan was made for another scene than {what}")]
    OtherScene { what: &'static str },
    #[error(
        "the target is {} x {} pixels, and the plan's picture {} x {}",
        .target[0], .target[1], .picture[0], .picture[1]
    )]
    TargetSize { target: [u32; 2], picture: [u32; 2] },
    #[error("a target of the format {format} was given, and {wanted}")]
    TargetFormat { format: String, wanted: String },
    #[error("the device reported: {0}")]
    Lost(String),
}
