//! The whole file: from bytes to [`Spec`].

use std::fs::File;
use std::io::Read;
use std::path::Path;

use toml::de::DeTable;

use super::item::{self, Item};
use super::table::Table;
use super::{camera, image, keys, later, lens, light, links, overlap, scene, set};
use crate::InputError;
use crate::file_kind::FileKind;
use crate::limits::MAX_SPEC_BYTES;
use crate::spec::{NumberRange, Source, Spec};

impl Spec {
    /// Reads a spec file; relative paths in it start at its folder.
    pub fn load(path: &Path) -> Result<Spec, InputError> {
        Self::load_with(path, &[])
    }

    /// The same with settings, see [`Spec::parse_with`].
    pub fn load_with(path: &Path, settings: &[String]) -> Result<Spec, InputError> {
        let name = path.display().to_string();
        let failed =
            |error| InputError::new(format!("cannot read the spec file {name}: {error}")).help("check the path");
        let bytes = File::open(path).and_then(read_bounded).map_err(failed)?;
        Self::from_bytes(&bytes, &name, path.parent().unwrap_or(Path::new("")), settings)
    }

    /// Reads a spec from a pipe, no more of it than a spec may have.
    pub fn read(pipe: impl Read, name: &str, folder: &Path, settings: &[String]) -> Result<Spec, InputError> {
        let failed = |error| InputError::new(format!("cannot read the spec from {name}: {error}"));
        Self::from_bytes(&read_bounded(pipe).map_err(failed)?, name, folder, settings)
    }

    /// Reads a spec as it came from a file or a pipe. `name` stands for it in messages; relative paths start at
    /// `folder`; settings as in [`Spec::parse_with`].
    pub fn from_bytes(bytes: &[u8], name: &str, folder: &Path, settings: &[String]) -> Result<Spec, InputError> {
        let kind = FileKind::of(bytes);
        if kind.is_model() {
            let message = format!("{name} is {}, and a lens spec is expected", kind.name);
            return Err(
                InputError::new(message).help(format!("`lenspeel init {name} -o SPEC.toml` writes a spec for it"))
            );
        }
        if bytes.len() as u64 > MAX_SPEC_BYTES {
            return Err(too_large(name));
        }
        let text = std::str::from_utf8(bytes).map_err(|error| {
            let at = error.valid_up_to();
            InputError::new(format!("the spec file {name} is not text: byte {at} is not UTF-8"))
                .help("a spec is a TOML file saved as UTF-8")
        })?;
        Self::parse_with(text, name, folder, settings)
    }

    /// Reads a spec from its text. `name` stands for the file in messages; relative paths start at `folder`.
    pub fn parse(text: &str, name: &str, folder: &Path) -> Result<Spec, InputError> {
        Self::parse_with(text, name, folder, &[])
    }

    /// The same with settings: each is `KEY=VALUE` with a dotted key (`lens.probe.center`, where `probe` is the lens of
    /// that name) and a TOML value, and holds as if the file said so.
    pub fn parse_with(text: &str, name: &str, folder: &Path, settings: &[String]) -> Result<Spec, InputError> {
        let source = Source::with_settings(name, text, settings);
        if source.text.len() as u64 > MAX_SPEC_BYTES {
            return Err(too_large(name));
        }
        let mut parts = source.parts();
        let of_file = parts.next().unwrap_or_default();
        let mut document = DeTable::parse(&source.text[of_file]).map_err(|error| not_toml(&source, &error))?;
        for part in parts {
            set::apply(document.get_mut(), &source, part)?;
        }
        let file = item::File::new(&source, folder);
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

/// Up to one byte more than a spec may have.
fn read_bounded(file: impl Read) -> std::io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    file.take(MAX_SPEC_BYTES + 1).read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn too_large(name: &str) -> InputError {
    InputError::new(format!("the spec {name} has more than {MAX_SPEC_BYTES} bytes"))
        .help("long lists of points belong into a model: see the shape `mesh`")
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_never_ends_is_refused() {
        let error = Spec::read(std::io::repeat(b'#'), "<stdin>", Path::new(""), &[]).expect_err("it has no end");
        assert!(error.message.contains("more than 16777216 bytes"), "{error}");
        // Cut in the middle of a letter, it is text all the same.
        let letters = "é".as_bytes().iter().copied().cycle().take(1 + MAX_SPEC_BYTES as usize).collect::<Vec<u8>>();
        let error = Spec::from_bytes(&letters, "a test", Path::new(""), &[]).expect_err("it is too long");
        assert!(error.message.contains("more than 16777216 bytes"), "{error}");
    }
}
