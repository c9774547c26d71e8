//! `[scene]`.

use std::path::PathBuf;

use toml::de::DeValue;

use super::item::Item;
use super::keys;
use super::lens::bound_name;
use super::table::{Table, entries};
use crate::InputError;
use crate::spec::{At, Backfaces, NumberRange, SceneChoice, SceneSpec};

pub fn read(item: &Item) -> Result<SceneSpec, InputError> {
    let table = Table::open(item, "[scene]", keys::SCENE)?;
    Ok(SceneSpec {
        file: table.need("file")?.path()?,
        scene: table.read("scene", choice),
        time: table.read("time", time),
        hide: table.read("hide", Item::patterns).unwrap_or_default(),
        backfaces: table.read("backfaces", backfaces).unwrap_or_default(),
        alternates: table.read("alternates", alternates).unwrap_or_default(),
    })
}

fn choice(item: &Item) -> Result<At<SceneChoice>, InputError> {
    let choice = match item.value {
        DeValue::Integer(_) => SceneChoice::Index(item.integer(0, i64::from(u32::MAX))? as usize),
        DeValue::String(_) => SceneChoice::Name(item.text()?.to_owned()),
        _ => return Err(item.wrong_type("a scene's name or its index")),
    };
    Ok(item.at(choice))
}

fn time(item: &Item) -> Result<At<f64>, InputError> {
    Ok(item.at(item.number(NumberRange::NOT_NEGATIVE)?))
}

fn backfaces(item: &Item) -> Result<Backfaces, InputError> {
    item.choice(&[("show", Backfaces::Show), ("as-material", Backfaces::AsMaterial)])
}

fn alternates(item: &Item) -> Result<Vec<(String, At<PathBuf>)>, InputError> {
    let DeValue::Table(map) = item.value else {
        return Err(item.wrong_type("a table of names and model files"));
    };
    let read = |(name, span, value)| -> Result<_, InputError> {
        let name: &str = name;
        bound_name("the name of an alternate", name)
            .map_err(|message| InputError::at(item.file.source, span, message).help("give it a shorter name"))?;
        Ok((name.to_owned(), Item::new(item.file, name, value).path()?))
    };
    entries(map).into_iter().map(read).collect()
}
