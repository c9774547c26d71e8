//! Images: painted by a function of texture coordinates, encoded as PNG or JPEG.

use image::{DynamicImage, ExtendedColorType, ImageEncoder, RgbImage, RgbaImage, codecs};

use super::det;

/// A colour with components 0..255 (sRGB), as mixing and clamping need it.
pub type Paint = [f64; 3];

pub fn paint(hex: u32) -> Paint {
    det::srgb_bytes(hex).map(f64::from)
}

pub fn mix(a: Paint, b: Paint, t: f64) -> Paint {
    let t = t.clamp(0.0, 1.0);
    std::array::from_fn(|i| det::lerp(a[i], b[i], t))
}

pub fn scale(a: Paint, factor: f64) -> Paint {
    a.map(|c| c * factor)
}

/// The colour at `x` of stops with rising positions, mixed between them.
pub fn ramp(stops: &[(f64, u32)], x: f64) -> Paint {
    let next = stops.iter().position(|(at, _)| *at >= x).unwrap_or(stops.len() - 1);
    let (a, b) = (stops[next.saturating_sub(1)], stops[next]);
    let t = if b.0 > a.0 { (x - a.0) / (b.0 - a.0) } else { 0.0 };
    mix(paint(a.1), paint(b.1), t)
}

/// Paints an image; `color` gets u and v in 0..1 at the pixel centre, v downwards.
pub fn rgb(width: u32, height: u32, color: impl Fn(f64, f64) -> Paint) -> RgbImage {
    RgbImage::from_fn(width, height, |x, y| {
        let (u, v) = center(x, y, width, height);
        image::Rgb(color(u, v).map(byte))
    })
}

/// Like [`rgb`] with alpha 0..1.
pub fn rgba(width: u32, height: u32, color: impl Fn(f64, f64) -> (Paint, f64)) -> RgbaImage {
    RgbaImage::from_fn(width, height, |x, y| {
        let (u, v) = center(x, y, width, height);
        let (c, alpha) = color(u, v);
        image::Rgba([byte(c[0]), byte(c[1]), byte(c[2]), byte(alpha * 255.0)])
    })
}

fn center(x: u32, y: u32, width: u32, height: u32) -> (f64, f64) {
    ((f64::from(x) + 0.5) / f64::from(width), (f64::from(y) + 0.5) / f64::from(height))
}

fn byte(c: f64) -> u8 {
    c.round().clamp(0.0, 255.0) as u8
}

pub fn png(image: impl Into<DynamicImage>) -> Vec<u8> {
    use codecs::png::{CompressionType, FilterType, PngEncoder};
    let image = image.into();
    let mut bytes = Vec::new();
    let color: ExtendedColorType = image.color().into();
    PngEncoder::new_with_quality(&mut bytes, CompressionType::Best, FilterType::Adaptive)
        .write_image(image.as_bytes(), image.width(), image.height(), color)
        .expect("an 8-bit image in memory can be encoded");
    bytes
}

pub fn jpeg(image: &RgbImage, quality: u8) -> Vec<u8> {
    let mut bytes = Vec::new();
    codecs::jpeg::JpegEncoder::new_with_quality(&mut bytes, quality)
        .encode_image(image)
        .expect("an 8-bit image in memory can be encoded");
    bytes
}
