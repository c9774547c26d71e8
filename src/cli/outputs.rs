//! The files a render writes: each of its own, none of them one it reads, all in folders that are there.

use std::path::{Path, PathBuf};

use super::args::RenderArgs;
use super::streams::write_out;
use crate::InputError;
use crate::output::{Aov, Place, write_whole};
use crate::scene::files;
use crate::spec::Spec;

/// Stands for standard output, and for standard input.
pub const STREAM: &str = "-";

/// One file to be written.
struct Output {
    path: PathBuf,
    what: String,
    extension: &'static str,
}

/// Finds what would fail or overwrite something only after the work is done.
pub fn check(args: &RenderArgs, spec: &Spec) -> Result<(), InputError> {
    let inputs = files(spec).into_iter().chain([(args.spec.spec.clone(), "the spec")]);
    let mut known: Vec<(PathBuf, String)> =
        inputs.filter_map(|(path, what)| Some((std::fs::canonicalize(path).ok()?, what.to_string()))).collect();
    for Output { path, what, extension } in outputs(args)? {
        let here = place(&path, &what)?;
        if let Some((_, other)) = known.iter().find(|(taken, _)| *taken == here) {
            let message = format!("{} would be {what} and {other}", shown(&path));
            return Err(InputError::new(message).help("give each its own name"));
        }
        check_whole(&path, &what, extension)?;
        known.push((here, what));
    }
    Ok(())
}

/// Writes a file, or standard output where that was named.
pub fn write(path: &Path, bytes: &[u8]) -> Result<(), InputError> {
    if is_stream(path) { write_out(|out| out.write_all(bytes)) } else { write_whole(path, bytes) }
}

pub fn is_stream(path: &Path) -> bool {
    path.as_os_str() == STREAM
}

/// As messages call it.
pub fn shown(path: &Path) -> String {
    if is_stream(path) { "standard output".to_string() } else { path.display().to_string() }
}

fn outputs(args: &RenderArgs) -> Result<Vec<Output>, InputError> {
    let output = |path: &Path, what: &str, extension| Output { path: path.into(), what: what.into(), extension };
    let mut outputs = vec![output(&args.output, "the picture", "png")];
    for (aov, path) in &args.aov {
        outputs.push(output(path, &format!("the {} map", aov.name()), aov.extension()));
        if *aov == Aov::Region {
            if is_stream(path) || matches!(Place::of(path)?, Place::Stream(_)) {
                let message = format!("the region map goes to {}, and its table has no place beside it", shown(path));
                return Err(InputError::new(message).help("name a file, as in region=regions.png"));
            }
            outputs.push(output(&path.with_extension("json"), "the table of the region map", "json"));
        }
    }
    outputs.extend(args.stats.as_deref().map(|path| output(path, "the statistics", "json")));
    Ok(outputs)
}

/// One name for every way to write a path: its folder as the system knows it, and the file's name.
fn place(path: &Path, what: &str) -> Result<PathBuf, InputError> {
    if is_stream(path) {
        return Ok(STREAM.into());
    }
    if path.is_dir() {
        let message = format!("{} is to be {what}, but it is a folder", path.display());
        return Err(InputError::new(message).help("name a file in it"));
    }
    let name = path.file_name().ok_or_else(|| {
        InputError::new(format!("`{}` names no file", path.display())).help("give a file name, as in picture.png")
    })?;
    let folder = crate::output::folder_of(path);
    if !folder.is_dir() {
        let why = if folder.exists() { "it is a file" } else { "it is not there" };
        return Err(InputError::new(format!("the folder {} cannot be used: {why}", folder.display()))
            .help(format!("{} needs a folder; make it first", name.display())));
    }
    let place = Place::of(path)?;
    let Place::File(file) = &place else { return Ok(place.path().to_path_buf()) };
    let folder = std::fs::canonicalize(crate::output::folder_of(file));
    let folder = folder.map_err(|e| InputError::new(format!("{} cannot be written: {e}", path.display())))?;
    Ok(folder.join(file.file_name().unwrap_or(name)))
}

/// A name that says what it holds says it truly, a name that says nothing may hold anything; and it can be written.
pub fn check_whole(path: &Path, what: &str, wanted: &str) -> Result<(), InputError> {
    let place = if is_stream(path) { return Ok(()) } else { Place::of(path)? };
    match path.extension().filter(|_| matches!(place, Place::File(_))) {
        Some(extension) if !extension.eq_ignore_ascii_case(wanted) => {
            let message = format!("{}: {what} is written as {}", path.display(), wanted.to_uppercase());
            let name = path.with_extension(wanted);
            Err(InputError::new(message).help(format!("name it {}", name.display())))
        }
        _ => place.check(),
    }
}
