//! PNG files.

use std::io::Cursor;
use std::path::Path;

use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

use super::write_whole;
use crate::InputError;
use crate::frame::Frame;

/// Writes the picture as 8-bit RGBA.
pub fn write_picture(path: &Path, frame: &Frame) -> Result<(), InputError> {
    encode(path, frame.pixels.as_flattened(), frame.size, ExtendedColorType::Rgba8)
}

/// Writes a map of one 16-bit number a pixel.
pub(super) fn write_gray16(path: &Path, values: &[u16], size: [u32; 2]) -> Result<(), InputError> {
    // The encoder takes samples in native order.
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_ne_bytes()).collect();
    encode(path, &bytes, size, ExtendedColorType::L16)
}

fn encode(path: &Path, bytes: &[u8], size: [u32; 2], color: ExtendedColorType) -> Result<(), InputError> {
    let mut png = Cursor::new(Vec::new());
    PngEncoder::new(&mut png)
        .write_image(bytes, size[0], size[1], color)
        .map_err(|e| InputError::new(format!("{} cannot be encoded: {e}", path.display())))?;
    write_whole(path, png.get_ref())
}
