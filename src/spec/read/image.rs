//! `[image]`.

use toml::de::DeValue;

use super::item::Item;
use super::keys;
use super::table::Table;
use crate::InputError;
use crate::spec::{Color, ImageSpec, ToneMapping};

pub fn read(item: &Item) -> Result<ImageSpec, InputError> {
    let table = Table::open(item, "[image]", keys::IMAGE)?;
    let default = ImageSpec::default();
    Ok(ImageSpec {
        size: table.read("size", size).unwrap_or(default.size),
        samples: table.read("samples", samples).unwrap_or(default.samples),
        background: table.read("background", background).unwrap_or(default.background),
        tone_mapping: table.read("tone_mapping", tone_mapping).unwrap_or(default.tone_mapping),
    })
}

fn size(item: &Item) -> Result<[u32; 2], InputError> {
    const WANTED: &str = "[width, height] in pixels";
    let sides = item.list(WANTED)?;
    let [width, height] = sides.as_slice() else {
        return Err(item.error(format!("`size` must be {WANTED}, but has {} numbers", sides.len())));
    };
    Ok([side(width)?, side(height)?])
}

fn side(item: &Item) -> Result<u32, InputError> {
    item.integer(1, i64::from(ImageSpec::LARGEST_SIDE)).map(|side| side as u32)
}

fn samples(item: &Item) -> Result<u32, InputError> {
    match item.integer(i64::MIN, i64::MAX)? {
        samples @ (1 | 4 | 9 | 16) => Ok(samples as u32),
        other => Err(item.error(format!("`samples` must be 1, 4, 9 or 16, not {other}"))),
    }
}

fn tone_mapping(item: &Item) -> Result<ToneMapping, InputError> {
    item.choice(&[("none", ToneMapping::None), ("neutral", ToneMapping::Neutral)])
}

/// `None` is transparent.
fn background(item: &Item) -> Result<Option<Color>, InputError> {
    match item.value {
        DeValue::String(text) if text == "transparent" => Ok(None),
        _ => item.color().map(Some),
    }
}
