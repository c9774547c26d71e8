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
use super::open::{self, Fault, Fetch};
use super::warnings::Warnings;
use super::{File, object};
use crate::InputError;
use crate::scene::{Budget, Image};

/// Memory of an image, a pixel: as it is kept, with its mip levels, and while it is decoded. Compressed images can claim
/// any size in a few bytes.
const PIXEL_BYTES: u64 = 16;
/// Bytes of what an image holds beside its pixels, as a colour profile.
const BESIDE_PIXELS: u64 = 64 << 20;

/// All images of the file, of which only those in `used` (ascending) are decoded; and of each whether it could not be.
pub fn load(
    file: &File<'_>,
    used: &[usize],
    fetch: &mut Fetch<'_>,
    budget: &mut Budget,
    warnings: &mut Warnings,
) -> Result<(Vec<Image>, Vec<bool>), InputError> {
    let mut encoded = Vec::with_capacity(used.len());
    let mut is_unread = vec![false; file.root().images.len()];
    for &index in used {
        let place = label(file, index);
        let before = *budget;
        match bytes(file, index, &place, fetch, budget)
            .and_then(|bytes| take(bytes, &format!("{}: {place}", file.name), budget))
        {
            Ok(bytes) => encoded.push((index, bytes)),
            Err(Fault::Missing(error)) => {
                *budget = before;
                warnings.add(place, without(&error));
                is_unread[index] = true;
            }
            Err(refused) => return Err(refused.into()),
        }
    }
    let decoded: Vec<_> = encoded.par_iter().map(|(_, bytes)| decode(bytes)).collect();
    let own = encoded.iter().filter(|(_, bytes)| matches!(bytes, Cow::Owned(_)));
    budget.give_back(own.map(|(_, bytes)| bytes.len() as u64).sum());
    let name = |i: &json::Image| i.name.clone().or(file_name(i)).unwrap_or_default();
    let blank = |i: &json::Image| Image { name: name(i), width: 1, height: 1, pixels: vec![[255; 4]] };
    let mut images: Vec<Image> = file.root().images.iter().map(blank).collect();
    for ((index, bytes), result) in encoded.iter().zip(decoded) {
        match result {
            Ok(image) => images[*index] = Image { name: std::mem::take(&mut images[*index].name), ..image },
            Err(error) => {
                budget.give_back(size(bytes).map_or(0, |(width, height)| width * height * PIXEL_BYTES));
                warnings.add(label(file, *index), without(&undecodable(&error)));
                is_unread[*index] = true;
            }
        }
    }
    Ok((images, is_unread))
}

fn label(file: &File<'_>, index: usize) -> String {
    let json = &file.root().images[index];
    object("image", index, json.name.clone().or(file_name(json)).as_deref())
}

/// A warning in the place of an error.
fn without(error: &InputError) -> String {
    format!("{}: materials are drawn without it", error.message)
}

/// An image without a name goes by its file's.
fn file_name(json: &json::Image) -> Option<String> {
    json.uri.clone().filter(|uri| !uri.starts_with("data:"))
}

fn bytes<'f>(
    file: &'f File<'_>,
    index: usize,
    place: &str,
    fetch: &mut Fetch<'_>,
    budget: &mut Budget,
) -> Result<Cow<'f, [u8]>, Fault> {
    let json = &file.root().images[index];
    match (&json.uri, json.buffer_view) {
        (Some(uri), _) => open::bytes_of(uri, fetch, budget).map(Cow::Owned).map_err(|fault| match fault {
            Fault::Refused(_) => fault.of(&format!("{}: {place}", file.name)),
            missing => missing,
        }),
        (None, Some(view)) => view_bytes(file, view.value(), place).map(Cow::Borrowed).map_err(Fault::Refused),
        (None, None) => Err(Fault::Missing(InputError::new("it has neither a URI nor a buffer view"))),
    }
}

/// Takes the memory of an image before it is decoded.
fn take<'a>(bytes: Cow<'a, [u8]>, place: &str, budget: &mut Budget) -> Result<Cow<'a, [u8]>, Fault> {
    let (width, height) = size(&bytes).map_err(|e| Fault::Missing(undecodable(&e)))?;
    let what = || format!("{place}, with {width} x {height} pixels");
    budget.take(width * height * PIXEL_BYTES, what).map_err(Fault::Refused)?;
    Ok(bytes)
}

/// Width and height, as an image claims them.
fn size(bytes: &[u8]) -> image::ImageResult<(u64, u64)> {
    let (width, height) = reader(bytes)?.into_dimensions()?;
    Ok((width.into(), height.into()))
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

fn decode(bytes: &[u8]) -> image::ImageResult<Image> {
    let (width, height) = size(bytes)?;
    let mut reader = reader(bytes)?;
    // The budget has allowed these pixels; the crate's own limit is lower.
    let mut limits = image::Limits::default();
    limits.max_alloc = Some(width * height * PIXEL_BYTES + BESIDE_PIXELS);
    reader.limits(limits);
    let rgba = reader.decode()?.into_rgba8();
    let pixels = rgba.pixels().map(|pixel| pixel.0).collect();
    Ok(Image { name: String::new(), width: rgba.width(), height: rgba.height(), pixels })
}

impl Image {
    /// A PNG or JPEG file of its own, for a filter.
    pub(in crate::scene) fn load(path: &std::path::Path, budget: &mut Budget) -> Result<Image, InputError> {
        let name = path.display().to_string();
        let bytes = open::read_file(path, budget)?;
        let read = take(Cow::Borrowed(&bytes), &name, budget);
        let image = read.and_then(|bytes| decode(&bytes).map_err(|e| Fault::Missing(undecodable(&e))));
        budget.give_back(bytes.len() as u64);
        image.map(|image| Image { name: name.clone(), ..image }).map_err(|fault| match fault {
            Fault::Missing(_) => fault.of(&name).into(),
            Fault::Refused(error) => error,
        })
    }
}

fn undecodable(error: &image::ImageError) -> InputError {
    InputError::new(format!("it does not decode: {error}")).help("expected PNG or JPEG")
}
