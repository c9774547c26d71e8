//! Calls of the program and folders for what it writes.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// How a call ended.
pub struct Call {
    pub code: Option<i32>,
    pub out: String,
    pub err: String,
}

impl Call {
    /// Its output, when it has ended well.
    pub fn good(self) -> String {
        assert_eq!(self.code, Some(0), "{}", self.err);
        self.out
    }

    /// Its report, when the input was wrong.
    pub fn refused(self) -> String {
        assert_eq!(self.code, Some(1), "{}{}", self.out, self.err);
        self.err
    }
}

/// Runs the program.
pub fn call(arguments: &[&str]) -> Call {
    call_with(arguments, |_| ())
}

/// Runs the program with another environment or folder.
pub fn call_with(arguments: &[&str], change: impl FnOnce(&mut Command)) -> Call {
    let mut command = Command::new(env!("CARGO_BIN_EXE_lenspeel"));
    command.args(arguments).env("NO_COLOR", "1");
    change(&mut command);
    let output = command.output().expect("the program starts");
    let text = |bytes: &[u8]| String::from_utf8(bytes.to_vec()).expect("the program writes UTF-8");
    Call { code: output.status.code(), out: text(&output.stdout), err: text(&output.stderr) }
}

/// A file of the project.
pub fn project(path: &str) -> String {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path).display().to_string()
}

/// An empty folder for one test.
pub struct Folder(PathBuf);

impl Folder {
    pub fn new(test: &str) -> Self {
        let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join("program").join(test);
        if path.exists() {
            fs::remove_dir_all(&path).expect("a folder of the build can be emptied");
        }
        fs::create_dir_all(&path).expect("the build folder takes a folder");
        Self(path)
    }

    pub fn file(&self, name: &str) -> String {
        self.0.join(name).display().to_string()
    }

    pub fn write(&self, name: &str, text: &str) -> String {
        fs::write(self.0.join(name), text).expect("the build folder takes a file");
        self.file(name)
    }

    pub fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.0.join(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn json(&self, name: &str) -> serde_json::Value {
        serde_json::from_slice(&self.read(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    /// The names of all files in it, sorted.
    pub fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(&self.0).expect("the folder is there");
        let name = |entry: std::io::Result<fs::DirEntry>| entry.expect("an entry").file_name();
        let mut names: Vec<String> = entries.map(|entry| name(entry).to_string_lossy().into_owned()).collect();
        names.sort();
        names
    }
}
