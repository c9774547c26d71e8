//! Files that are either whole or not there.

use std::ffi::OsString;
use std::path::Path;

use crate::InputError;

/// Writes beside the target first and then renames, so that a failure leaves nothing half-written.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), InputError> {
    let mut name = path.file_name().map_or_else(OsString::new, OsString::from);
    name.push(format!(".{}.part", std::process::id()));
    let part = path.with_file_name(name);
    let written = std::fs::write(&part, bytes).and_then(|()| std::fs::rename(&part, path));
    written.map_err(|e| {
        // The part may not exist; what matters is the error that brought us here.
        let _ = std::fs::remove_file(&part);
        InputError::new(format!("{} cannot be written: {e}", path.display()))
            .help("check that the folder exists and may be written to")
    })
}
