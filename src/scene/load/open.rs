//! Files beside the model and the buffers they hold.

use std::borrow::Cow;
use std::path::Path;

use gltf::json;

use super::uri::{self, Target};
use super::{Fetch, object};
use crate::InputError;

/// 4 GiB: what GLB can address; more is surely not meant.
const MAX_FILE_BYTES: u64 = 1 << 32;

/// Reads a regular file; devices and pipes, which may never end, are refused.
pub fn read_file(path: &Path) -> Result<Vec<u8>, InputError> {
    let failed = |e: std::io::Error| InputError::new(format!("cannot read {}: {e}", path.display()));
    let meta = std::fs::metadata(path).map_err(failed)?;
    if !meta.is_file() {
        return Err(InputError::new(format!("cannot read {}: not a file", path.display())));
    }
    if meta.len() > MAX_FILE_BYTES {
        return Err(InputError::new(format!("{}: {} bytes, at most {MAX_FILE_BYTES}", path.display(), meta.len())));
    }
    std::fs::read(path).map_err(failed)
}

/// Reads a file named by a relative URI.
pub fn read_beside(folder: &Path, relative: &str) -> Result<Vec<u8>, InputError> {
    read_file(&folder.join(relative))
}

/// The bytes a URI stands for.
pub fn bytes_of(uri: &str, fetch: &mut Fetch<'_>) -> Result<Vec<u8>, InputError> {
    match uri::parse(uri).map_err(InputError::new)? {
        Target::Data(bytes) => Ok(bytes),
        Target::Relative(path) => fetch(&path),
    }
}

/// All buffers of the file, each with at least the bytes it declares.
pub fn buffers<'a>(
    root: &json::Root,
    name: &str,
    bin: Option<&'a [u8]>,
    fetch: &mut Fetch<'_>,
) -> Result<Vec<Cow<'a, [u8]>>, InputError> {
    let load = |(index, buffer): (usize, &json::Buffer)| {
        let place = format!("{name}: {}", object("buffer", index, buffer.name.as_deref()));
        let bytes = match (&buffer.uri, bin) {
            (Some(uri), _) => Cow::Owned(
                bytes_of(uri, fetch).map_err(|e| InputError { message: format!("{place}: {}", e.message), ..e })?,
            ),
            (None, Some(bin)) if index == 0 => Cow::Borrowed(bin),
            (None, _) => {
                return Err(InputError::new(format!("{place}: it has neither a URI nor a binary chunk"))
                    .help("only buffer 0 of a GLB file may leave its URI out"));
            }
        };
        if (bytes.len() as u64) < buffer.byte_length.0 {
            let (declared, there) = (buffer.byte_length.0, bytes.len());
            return Err(InputError::new(format!("{place}: {declared} bytes declared, {there} there"))
                .help("the file may be cut short"));
        }
        Ok(bytes)
    };
    root.buffers.iter().enumerate().map(load).collect()
}
