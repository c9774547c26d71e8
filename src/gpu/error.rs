//! What can go wrong on a graphics device, with numbers.

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
    #[error("the adapter {adapter} has not enough {what}")]
    Lacking { adapter: String, what: String },
    #[error("the device could not be opened: {0}")]
    Device(String),
    #[error("{what} need {needed} bytes, and the device allows {allowed}")]
    TooLarge { what: String, needed: u64, allowed: u64 },
    #[error("the texture {name} is {size} pixels wide or high, and the device allows {allowed}")]
    TextureTooLarge { name: String, size: u32, allowed: u32 },
    #[error("the textures need {needed} pages of {page} pixels squared, and the device allows {allowed}")]
    TooManyTextures { needed: u32, page: u32, allowed: u32 },
    #[error("the device reported: {0}")]
    Lost(String),
}
