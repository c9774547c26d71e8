//! The whole file: from bytes to [`Spec`].

use std::path::Path;

use toml::de::DeTable;

use super::item::{File, Item};
use super::table::Table;
use super::{camera, image, keys, later, lens, light, links, overlap, scene};
use crate::InputError;
use crate::limits::MAX_SPEC_BYTES;
use crate::spec::{NumberRange, Source, Spec};

impl Spec {
    /// Reads a spec file; relative paths in it start at its folder.
    pub fn load(path: &Path) -> Result<Spec, InputError> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|error| {
            InputError::new(format!("cannot read the spec file {name}: {error}")).help("check the path")
        })?;
        let text = String::from_utf8(bytes).map_err(|error| {
            let at = error.utf8_error().valid_up_to();
            InputError::new(format!("the spec file {name} is not text: byte {at} is not UTF-8"))
                .help("a spec is a TOML file saved as UTF-8")
        })?;
        Self::parse(&text, &name, path.parent().unwrap_or(Path::new("")))
    }

    /// Reads a spec from its text. `name` stands for the file in messages; relative paths start at `folder`.
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Spec, InputError> {
        if text.len() as u64 > MAX_SPEC_BYTES {
            let message = format!("the spec {name} has {} bytes, and at most {MAX_SPEC_BYTES} can be", text.len());
            return Err(InputError::new(message).help("long lists of points belong into a model: see the shape `mesh`"));
        }
        let source = Source::new(name, text);
        let document = DeTable::parse(text).map_err(|error| not_toml(&source, &error))?;
        let file = File::new(&source, folder);
        let table = Table::of_map(&file, "a spec", document.get_ref(), document.span(), keys::DOCUMENT);
        let spec = read(&table, &source);
        let mut faults = file.into_faults();
        match spec {
            Ok(spec) => {
                faults.finish()?;
                links::check(&spec)?;
                Ok(spec)
            }
            Err(error) => {
                faults.note(error.clone());
                Err(faults.finish().err().unwrap_or(error))
            }
        }
    }
}

fn not_toml(source: &Source, error: &toml::de::Error) -> InputError {
    let place = error.span().unwrap_or(0..0);
    InputError::at(source, place, format!("this is not valid TOML: {}", error.message()))
}

fn read(table: &Table, source: &Source) -> Result<Spec, InputError> {
    table.read("version", version);
    table.read("animation", animation);
    let camera = table.read("camera", camera::read);
    let image = table.read("image", image::read).unwrap_or_default();
    let light = table.read("light", light::read);
    let lenses = each(table, "lens", lens::read);
    let overlaps = each(table, "overlap", overlap::read);
    let scene = table.get("scene").ok_or_else(|| {
        InputError::at(source, 0..0, "a spec needs a [scene]").help("write [scene] and below it file = \"model.glb\"")
    })?;
    Ok(Spec { source: source.clone(), scene: scene::read(&scene)?, camera, image, light, lenses, overlaps })
}

/// An array of tables, empty where the file has none.
fn each<T>(table: &Table, key: &'static str, read: fn(&Item) -> Result<T, InputError>) -> Vec<T> {
    let wanted = format!("a list of tables, each under [[{key}]]");
    table.read(key, |item| item.each(&wanted, read)).unwrap_or_default()
}

fn version(item: &Item) -> Result<(), InputError> {
    match item.integer(i64::MIN, i64::MAX)? {
        1 => Ok(()),
        other => Err(item
            .error(format!("`version` is {other}, but this program reads version 1"))
            .help("write version = 1, or leave it out")),
    }
}

/// A still does not depend on duration and fps; tracks would move it.
fn animation(item: &Item) -> Result<(), InputError> {
    let table = Table::open(item, "[animation]", keys::ANIMATION)?;
    table.read("duration", |item| item.number(NumberRange::POSITIVE));
    table.read("fps", |item| item.number(NumberRange::POSITIVE));
    let Some(tracks) = table.get("track") else { return Ok(()) };
    let list = tracks.list("a list of tables, each under [[animation.track]]")?;
    list.iter().try_for_each(track)?;
    match list.first() {
        None => Ok(()),
        Some(first) => Err(later::feature(first, "[[animation.track]]", "remove the tracks to draw a still")),
    }
}

fn track(item: &Item) -> Result<(), InputError> {
    let table = Table::open(item, "[[animation.track]]", keys::TRACK)?;
    table.need("target")?.text()?;
    table.read("ease", |item| item.choice(&[("linear", ()), ("smooth", ()), ("step", ())]));
    for key in table.need("keys")?.list("a list of [seconds, value]")? {
        let pair = key.list("a list of [seconds, value]")?;
        let [time, _] = pair.as_slice() else {
            return Err(key.error(format!("a key of a track is [seconds, value], but this has {} parts", pair.len())));
        };
        time.number(NumberRange::NOT_NEGATIVE)?;
    }
    Ok(())
}
