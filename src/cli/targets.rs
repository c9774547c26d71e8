//! The files a render writes: each of its own, none of them the spec, all in folders that are there.

use std::path::{Path, PathBuf};

use super::args::RenderArgs;
use crate::InputError;
use crate::output::Aov;

/// Finds what would fail or overwrite something only after the work is done.
pub fn check(args: &RenderArgs) -> Result<(), InputError> {
    let mut known = vec![(place(&args.spec)?, "the spec".to_string())];
    for (path, what) in targets(args) {
        if path.is_dir() {
            let message = format!("{} is to be {what}, but it is a folder", path.display());
            return Err(InputError::new(message).help("name a file in it"));
        }
        let here = place(&path)?;
        if let Some((_, other)) = known.iter().find(|(taken, _)| *taken == here) {
            let message = format!("{} would be {what} and {other}", path.display());
            return Err(InputError::new(message).help("give each its own name"));
        }
        known.push((here, what));
    }
    Ok(())
}

fn targets(args: &RenderArgs) -> Vec<(PathBuf, String)> {
    let mut targets = vec![(args.output.clone(), "the picture".to_string())];
    for (aov, path) in &args.aov {
        targets.push((path.clone(), format!("the {} map", aov.name())));
        if *aov == Aov::Region {
            targets.push((path.with_extension("json"), "the table of the region map".into()));
        }
    }
    targets.extend(args.stats.clone().map(|path| (path, "the statistics".into())));
    targets
}

/// One name for every way to write a path: its folder as the system knows it, and the file's name.
fn place(path: &Path) -> Result<PathBuf, InputError> {
    let name = path.file_name().ok_or_else(|| {
        InputError::new(format!("`{}` names no file", path.display())).help("give a file name, as in picture.png")
    })?;
    let folder = match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    };
    let folder = std::fs::canonicalize(folder).map_err(|e| {
        InputError::new(format!("the folder {} cannot be used: {e}", folder.display())).help("make it first")
    })?;
    Ok(folder.join(name))
}
