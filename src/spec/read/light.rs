//! `[light]`. What it leaves out is dark.

use super::item::Item;
use super::keys;
use super::table::Table;
use crate::InputError;
use crate::spec::{Color, DirectionalSpec, LightSpec, NumberRange};

pub fn read(item: &Item) -> Result<LightSpec, InputError> {
    let table = Table::open(item, "[light]", keys::LIGHT)?;
    Ok(LightSpec {
        ambient: table.read("ambient", brightness).unwrap_or(0.0),
        directional: table.read("directional", directionals).unwrap_or_default(),
    })
}

fn brightness(item: &Item) -> Result<f32, InputError> {
    item.number32(NumberRange::NOT_NEGATIVE)
}

fn directionals(item: &Item) -> Result<Vec<DirectionalSpec>, InputError> {
    item.each("a list of lights, each under [[light.directional]]", directional)
}

fn directional(item: &Item) -> Result<DirectionalSpec, InputError> {
    let table = Table::open(item, "[[light.directional]]", keys::DIRECTIONAL)?;
    Ok(DirectionalSpec {
        direction: table.need("direction")?.direction()?,
        color: table.read("color", Item::opaque_color).unwrap_or(Color::rgb(255, 255, 255)),
        intensity: table.read("intensity", brightness).unwrap_or(1.0),
    })
}
