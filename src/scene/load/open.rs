//! Files beside the model and the buffers they hold.

use std::borrow::Cow;
use std::io::Read;
use std::path::Path;

use gltf::json;

use super::object;
use super::uri::{self, Target};
use crate::InputError;
use crate::scene::Budget;

/// 4 GiB: what GLB can address; more is surely not meant.
const MAX_FILE_BYTES: u64 = 1 << 32;

/// Why something that a file names is not there.
#[derive(Debug)]
pub enum Fault {
    /// It cannot be read: an image may be done without.
    Missing(InputError),
    /// It must not be read, or takes too much.
    Refused(InputError),
}

impl Fault {
    /// The same about an object of a file.
    pub fn of(self, place: &str) -> Self {
        let named = |e: InputError| InputError { message: format!("{place}: {}", e.message), ..e };
        match self {
            Fault::Missing(error) => Fault::Missing(named(error)),
            Fault::Refused(error) => Fault::Refused(named(error)),
        }
    }
}

impl From<Fault> for InputError {
    fn from(fault: Fault) -> Self {
        let (Fault::Missing(error) | Fault::Refused(error)) = fault;
        error
    }
}

/// Fetches a path that a file names, of at most so many bytes.
pub type Fetch<'f> = dyn FnMut(&str, u64) -> Result<Vec<u8>, Fault> + 'f;

/// Reads a regular file, whose bytes are taken from the budget; devices and pipes, which may never end, are refused.
pub fn read_file(path: &Path, budget: &mut Budget) -> Result<Vec<u8>, InputError> {
    let bytes = read(path, budget.left())?;
    budget.take(bytes.len() as u64, || path.display().to_string())?;
    Ok(bytes)
}

/// The same, of at most so many bytes.
pub fn read(path: &Path, most: u64) -> Result<Vec<u8>, Fault> {
    let failed = |e: std::io::Error| Fault::Missing(InputError::new(format!("cannot read {}: {e}", path.display())));
    let meta = std::fs::metadata(path).map_err(failed)?;
    if !meta.is_file() {
        return Err(Fault::Missing(InputError::new(format!("cannot read {}: not a file", path.display()))));
    }
    let most = most.min(MAX_FILE_BYTES);
    let too_large = |bytes: u64| {
        let name = path.display().to_string();
        Fault::Refused(if bytes > MAX_FILE_BYTES {
            InputError::new(format!("{name}: {bytes} bytes, at most {MAX_FILE_BYTES} are read"))
        } else {
            Budget::new(most).refusal(bytes, &name)
        })
    };
    if meta.len() > most {
        return Err(too_large(meta.len()));
    }
    let mut bytes = Vec::with_capacity(meta.len() as usize);
    // Some files are longer than they say.
    std::fs::File::open(path).and_then(|file| file.take(most + 1).read_to_end(&mut bytes)).map_err(failed)?;
    if bytes.len() as u64 > most { Err(too_large(bytes.len() as u64)) } else { Ok(bytes) }
}

/// Reads a file that a model in `folder` names. It must lie in that folder, links followed, unless `allow_outside`.
pub fn read_beside(folder: &Path, path: &str, allow_outside: bool, most: u64) -> Result<Vec<u8>, Fault> {
    let file = folder.join(path);
    if !allow_outside {
        if uri::leads_out(path) {
            return Err(outside(path));
        }
        let folder = if folder.as_os_str().is_empty() { Path::new(".") } else { folder };
        let real = |path: &Path| {
            let failed = |e| Fault::Missing(InputError::new(format!("cannot read {}: {e}", path.display())));
            std::fs::canonicalize(path).map_err(failed)
        };
        if !real(&file)?.starts_with(real(folder)?) {
            return Err(outside(path));
        }
    }
    read(&file, most)
}

/// The refusal of a path that leads out of the model's folder.
pub fn outside(path: &str) -> Fault {
    Fault::Refused(
        InputError::new(format!("`{path}` leads out of the folder of the model"))
            .help("where you trust the file, `--allow-outside` opens it (in the library: `OpenOptions`)"),
    )
}

/// The bytes a URI stands for, taken from the budget.
pub fn bytes_of(uri: &str, fetch: &mut Fetch<'_>, budget: &mut Budget) -> Result<Vec<u8>, Fault> {
    let bytes = match uri::parse(uri).map_err(|what| Fault::Missing(InputError::new(what)))? {
        Target::Data(bytes) => bytes,
        Target::Relative(path) => fetch(&path, budget.left())?,
    };
    budget.take(bytes.len() as u64, || "its bytes".into()).map_err(Fault::Refused)?;
    Ok(bytes)
}

/// The bytes of each buffer of the file, at least those it declares. A buffer without a URI has none: it is a place
/// for what an extension decodes.
pub fn buffers<'a>(
    root: &json::Root,
    name: &str,
    bin: Option<&'a [u8]>,
    fetch: &mut Fetch<'_>,
    budget: &mut Budget,
) -> Result<Vec<Option<Cow<'a, [u8]>>>, InputError> {
    let mut load = |(index, buffer): (usize, &json::Buffer)| {
        let place = format!("{name}: {}", object("buffer", index, buffer.name.as_deref()));
        let bytes = match (&buffer.uri, bin) {
            (Some(uri), _) => Cow::Owned(bytes_of(uri, fetch, budget).map_err(|fault| fault.of(&place))?),
            (None, Some(bin)) if index == 0 => Cow::Borrowed(bin),
            (None, _) => return Ok(None),
        };
        if (bytes.len() as u64) < buffer.byte_length.0 {
            let (declared, there) = (buffer.byte_length.0, bytes.len());
            return Err(InputError::new(format!("{place}: {declared} bytes declared, {there} there"))
                .help("the file may be cut short"));
        }
        Ok(Some(bytes))
    };
    root.buffers.iter().enumerate().map(&mut load).collect()
}
