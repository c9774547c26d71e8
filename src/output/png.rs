//! PNG files.

use std::io::Cursor;
use std::path::Path;

use image::{ExtendedColorType, ImageEncoder, codecs::png::PngEncoder};

use super::write_whole;
use crate::InputError;
use crate::frame::Frame;

/// Writes the picture as 8-bit RGBA.
pub fn write_picture(path: &Path, frame: &Frame) -> Result<(), InputError> {
    write_whole(path, &encode_picture(frame)?)
}

/// The bytes of that file.
pub fn encode_picture(frame: &Frame) -> Result<Vec<u8>, InputError> {
    encode(frame.pixels.as_flattened(), frame.size, ExtendedColorType::Rgba8)
}

/// A map of one 16-bit number a pixel.
pub(super) fn gray16(values: &[u16], size: [u32; 2]) -> Result<Vec<u8>, InputError> {
    // The encoder takes samples in native order.
    let bytes: Vec<u8> = values.iter().flat_map(|v| v.to_ne_bytes()).collect();
    encode(&bytes, size, ExtendedColorType::L16)
}

fn encode(bytes: &[u8], size: [u32; 2], color: ExtendedColorType) -> Result<Vec<u8>, InputError> {
    let mut png = Cursor::new(Vec::new());
    PngEncoder::new(&mut png)
        .write_image(bytes, size[0], size[1], color)
        .map_err(|e| InputError::new(format!("a picture cannot be encoded as PNG: {e}")))?;
    Ok(png.into_inner())
}
