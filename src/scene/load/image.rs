//! PNG and JPEG images, decoded in parallel to 8-bit RGBA.
//!
//! Images that no material uses ([`Model::used_images`](crate::scene::Model::used_images)) are not decoded: they may be of a kind we do not read (a fallback for
//! an extension, say). One white pixel stands in their place, so that indices stay those of the file.

use std::borrow::Cow;
use std::io::Cursor;

use gltf::json;
use image::{ImageFormat, ImageReader};
use rayon::prelude::*;

use super::accessor::view_bytes;
use super::{Fetch, File, object, open};
use crate::InputError;
use crate::scene::Image;

/// Pixels of all images together: 1 GiB decoded. Compressed images can claim any size in a few bytes.
const MAX_PIXELS: u64 = 1 << 28;

/// All images of the file; only those in `used` (ascending) are decoded.
pub fn load(file: &File<'_>, used: &[usize], fetch: &mut Fetch<'_>) -> Result<Vec<Image>, InputError> {
    let mut encoded = Vec::with_capacity(used.len());
    let mut pixels = 0u64;
    for &index in used {
        let bytes = bytes(file, index, fetch)?;
        let (width, height) =
            reader(&bytes).and_then(|r| r.into_dimensions()).map_err(|e| undecodable(file, index, &e))?;
        pixels = pixels.saturating_add(u64::from(width) * u64::from(height));
        if pixels > MAX_PIXELS {
            let what = format!("with its {width} x {height} pixels the images have more than {MAX_PIXELS} in all");
            return Err(file.error(label(file, index), what).help("use smaller textures"));
        }
        encoded.push((index, bytes));
    }
    let decoded: Vec<_> = encoded.par_iter().map(|(index, bytes)| decode(file, *index, bytes)).collect();
    let name = |i: &json::Image| i.name.clone().or(file_name(i)).unwrap_or_default();
    let blank = |i: &json::Image| Image { name: name(i), width: 1, height: 1, pixels: vec![[255; 4]] };
    let mut images: Vec<Image> = file.root().images.iter().map(blank).collect();
    for (index, result) in used.iter().zip(decoded) {
        images[*index] = Image { name: std::mem::take(&mut images[*index].name), ..result? };
    }
    Ok(images)
}

fn label(file: &File<'_>, index: usize) -> String {
    let json = &file.root().images[index];
    object("image", index, json.name.clone().or(file_name(json)).as_deref())
}

/// An image without a name goes by its file's.
fn file_name(json: &json::Image) -> Option<String> {
    json.uri.clone().filter(|uri| !uri.starts_with("data:"))
}

fn bytes<'f>(file: &'f File<'_>, index: usize, fetch: &mut Fetch<'_>) -> Result<Cow<'f, [u8]>, InputError> {
    let json = &file.root().images[index];
    let place = label(file, index);
    match (&json.uri, json.buffer_view) {
        (Some(uri), _) => open::bytes_of(uri, fetch)
            .map(Cow::Owned)
            .map_err(|e| InputError { message: format!("{}: {place}: {}", file.name, e.message), ..e }),
        (None, Some(view)) => view_bytes(file, view.value(), &place).map(Cow::Borrowed),
        (None, None) => Err(file.error(place, "it has neither a URI nor a buffer view")),
    }
}

/// The bytes tell the format; names and MIME types in files are often wrong.
fn reader(bytes: &[u8]) -> image::ImageResult<ImageReader<Cursor<&[u8]>>> {
    let format = image::guess_format(bytes)?;
    if !matches!(format, ImageFormat::Png | ImageFormat::Jpeg) {
        let hint = image::error::ImageFormatHint::Exact(format);
        return Err(image::ImageError::Unsupported(hint.into()));
    }
    Ok(ImageReader::with_format(Cursor::new(bytes), format))
}

fn decode(file: &File<'_>, index: usize, bytes: &[u8]) -> Result<Image, InputError> {
    let decoded = reader(bytes).and_then(|r| r.decode()).map_err(|e| undecodable(file, index, &e))?;
    Ok(rgba8(decoded))
}

fn rgba8(decoded: image::DynamicImage) -> Image {
    let rgba = decoded.into_rgba8();
    let (width, height) = rgba.dimensions();
    let pixels = rgba.pixels().map(|p| p.0).collect();
    Image { name: String::new(), width, height, pixels }
}

impl Image {
    /// A PNG or JPEG file of its own, for a filter.
    pub fn load(path: &std::path::Path) -> Result<Image, InputError> {
        let name = path.display().to_string();
        let bytes = open::read_file(path)?;
        let fail = |e: image::ImageError| {
            InputError::new(format!("{name}: it does not decode: {e}")).help("expected PNG or JPEG")
        };
        let (width, height) = reader(&bytes).and_then(|r| r.into_dimensions()).map_err(fail)?;
        if u64::from(width) * u64::from(height) > MAX_PIXELS {
            let message = format!("{name}: it has {width} x {height} pixels, and at most {MAX_PIXELS} are read");
            return Err(InputError::new(message).help("use a smaller image"));
        }
        let decoded = reader(&bytes).and_then(|r| r.decode()).map_err(fail)?;
        Ok(Image { name, ..rgba8(decoded) })
    }
}

fn undecodable(file: &File<'_>, index: usize, error: &image::ImageError) -> InputError {
    file.error(label(file, index), format!("it does not decode: {error}")).help("expected PNG or JPEG")
}
