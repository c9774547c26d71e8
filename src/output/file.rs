//! Files that are either whole or as they were.

use std::fs::{self, File, OpenOptions};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU32, Ordering};

use crate::InputError;

/// As many symbolic links in a row as systems follow.
const MOST_LINKS: usize = 40;

/// What stands where a path leads.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Place {
    /// A file, or nothing yet, at the end of all links.
    File(PathBuf),
    /// A device, a pipe, an open descriptor: takes bytes as they come.
    Stream(PathBuf),
}

impl Place {
    /// Follows links, also those to files that are not there yet.
    pub fn of(path: &Path) -> Result<Self, InputError> {
        follow(path).map_err(|error| unwritable(path, &error))
    }

    pub fn path(&self) -> &Path {
        match self {
            Place::File(path) | Place::Stream(path) => path,
        }
    }

    /// Finds out what would fail without writing anything. A stream tells only when it is opened, which may wait.
    pub fn check(&self) -> Result<(), InputError> {
        match self {
            Place::File(path) => Part::beside(path).map(|_| ()).map_err(|error| unwritable(path, &error)),
            Place::Stream(_) => Ok(()),
        }
    }
}

/// Writes beside the target first and then renames, so that a failure leaves nothing half-written. A file that is
/// there keeps its mode; devices and pipes are written to.
pub fn write_whole(path: &Path, bytes: &[u8]) -> Result<(), InputError> {
    let written = match Place::of(path)? {
        Place::Stream(place) => {
            OpenOptions::new().append(true).open(place).and_then(|mut stream| stream.write_all(bytes))
        }
        Place::File(place) => replace(&place, bytes),
    };
    written.map_err(|error| unwritable(path, &error))
}

fn unwritable(path: &Path, error: &io::Error) -> InputError {
    InputError::new(format!("{} cannot be written: {error}", path.display()))
        .help("check that its folder exists, and that both may be written to")
}

fn follow(path: &Path) -> io::Result<Place> {
    let mut at = path.to_path_buf();
    for _ in 0..=MOST_LINKS {
        let kind = match fs::symlink_metadata(&at) {
            Ok(meta) => meta.file_type(),
            Err(error) if error.kind() == io::ErrorKind::NotFound => return Ok(Place::File(at)),
            Err(error) => return Err(error),
        };
        if kind.is_dir() {
            return Err(io::Error::new(io::ErrorKind::IsADirectory, "it is a folder"));
        } else if kind.is_file() {
            return Ok(Place::File(at));
        } else if !kind.is_symlink() || is_descriptor(&at) {
            return Ok(Place::Stream(at));
        }
        at = folder_of(&at).join(fs::read_link(&at)?);
    }
    Err(io::Error::other("its symbolic links lead in a circle"))
}

/// Linux shows open descriptors as links whose text may lead nowhere (`/dev/stdout` leads to one).
fn is_descriptor(link: &Path) -> bool {
    fs::canonicalize(folder_of(link)).is_ok_and(|folder| folder.starts_with("/proc"))
}

/// Where a file's name is to be looked up.
pub fn folder_of(path: &Path) -> &Path {
    match path.parent() {
        Some(folder) if !folder.as_os_str().is_empty() => folder,
        _ => Path::new("."),
    }
}

fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let mut part = Part::beside(path)?;
    part.file.write_all(bytes)?;
    if let Ok(there) = fs::metadata(path) {
        part.file.set_permissions(there.permissions())?;
    }
    fs::rename(&part.path, path)
}

/// A file beside the target that goes away unless it takes the target's place.
struct Part {
    path: PathBuf,
    file: File,
}

impl Part {
    fn beside(target: &Path) -> io::Result<Self> {
        // Who may not write to a file may not replace it, whatever the folder allows.
        if fs::metadata(target).is_ok() {
            OpenOptions::new().write(true).open(target)?;
        }
        // Its name does not grow with the target's, which may be as long as names can be.
        static COUNT: AtomicU32 = AtomicU32::new(0);
        loop {
            let number = COUNT.fetch_add(1, Ordering::Relaxed);
            let path = folder_of(target).join(format!(".lenspeel-{}-{number}.part", std::process::id()));
            match File::create_new(&path) {
                // Left behind by a process of the same number.
                Err(error) if error.kind() == io::ErrorKind::AlreadyExists => {}
                made => return made.map(|file| Self { path, file }),
            }
        }
    }
}

impl Drop for Part {
    fn drop(&mut self) {
        // Nothing is there when it has been renamed.
        let _ = fs::remove_file(&self.path);
    }
}

#[cfg(test)]
#[cfg(unix)]
mod tests {
    use std::os::unix::fs::{PermissionsExt, symlink};

    use super::*;

    /// An empty folder for one test.
    fn folder(test: &str) -> PathBuf {
        let path = std::env::temp_dir().join(format!("lenspeel-{}-{test}", std::process::id()));
        let _ = fs::remove_dir_all(&path);
        fs::create_dir(&path).expect("the system's folder takes one");
        path
    }

    fn names(folder: &Path) -> Vec<String> {
        let name =
            |entry: io::Result<fs::DirEntry>| entry.expect("an entry").file_name().to_string_lossy().into_owned();
        let mut names: Vec<String> = fs::read_dir(folder).expect("a folder").map(name).collect();
        names.sort();
        names
    }

    #[test]
    fn a_file_keeps_its_mode_and_a_new_one_has_that_of_new_files() {
        let folder = folder("modes");
        let (old, new, plain) = (folder.join("old"), folder.join("new"), folder.join("plain"));
        fs::write(&old, "old").expect("written");
        fs::set_permissions(&old, fs::Permissions::from_mode(0o640)).expect("set");
        fs::write(&plain, "").expect("written");
        [&old, &new].into_iter().for_each(|path| write_whole(path, b"bytes").expect("written"));
        let mode = |path| fs::metadata(path).expect("there").permissions().mode() & 0o777;
        assert_eq!((mode(&old), mode(&new)), (0o640, mode(&plain)));
        assert_eq!(fs::read(&old).expect("there"), b"bytes");
    }

    #[test]
    fn links_stay_and_what_they_lead_to_is_written() {
        let folder = folder("links");
        let at = |name| folder.join(name);
        fs::create_dir(at("inner")).expect("made");
        fs::write(at("inner/there"), "old").expect("written");
        symlink("inner/there", at("a")).expect("linked");
        symlink("a", at("b")).expect("linked");
        symlink("inner/not-yet", at("c")).expect("linked");
        [at("b"), at("c")].iter().for_each(|path| write_whole(path, b"new").expect("written"));
        assert_eq!(["inner/there", "inner/not-yet"].map(|name| fs::read(at(name)).expect("there")), [b"new", b"new"]);
        assert!(["a", "b", "c"].iter().all(|name| at(name).is_symlink()));
        symlink("e", at("d")).expect("linked");
        symlink("d", at("e")).expect("linked");
        assert!(write_whole(&at("d"), b"new").is_err());
    }

    #[test]
    fn devices_are_written_to_and_stay() {
        write_whole(Path::new("/dev/null"), b"bytes").expect("takes all");
        assert_eq!(Place::of(Path::new("/dev/null")).expect("there"), Place::Stream("/dev/null".into()));
        assert!(write_whole(Path::new("/dev/full"), b"bytes").is_err());
    }

    #[test]
    fn a_name_may_be_as_long_as_names_can_be() {
        let folder = folder("long");
        write_whole(&folder.join("x".repeat(255)), b"bytes").expect("written");
        assert!(Place::of(&folder.join("x".repeat(256))).is_err());
    }

    #[test]
    fn a_check_leaves_nothing() {
        let folder = folder("check");
        let place = Place::of(&folder.join("new")).expect("free");
        place.check().expect("may be written");
        assert!(names(&folder).is_empty());
        let missing = Place::of(&folder.join("none/new")).expect("free");
        assert!(missing.check().is_err());
    }
}
