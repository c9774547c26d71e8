//! The committed specs and what each is opened with.

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::compare::Reference;
use lenspeel::cpu;
use lenspeel::frame::Frame;
use lenspeel::spec::Spec;

use crate::open::{Opened, open};
use crate::reference;

/// A walk that finds fewer has looked in the wrong place.
const LEAST_PROPERTIES: usize = 150;
/// Pixels of a showcase in the tests; one sample each.
const SHOWCASE_SIZE: [u32; 2] = [160, 90];
/// Likewise of a published lens; its golden has the pixels and samples that the spec says.
const PUBLISHED_SIZE: [u32; 2] = [160, 120];
/// The folder of published lenses.
const PUBLISHED: &str = "published";

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// A small spec of one property, with a golden beside it.
    Property,
    /// A spec to look at, rendered small.
    Showcase,
    /// A spec to look at, with a golden as it stands; rendered small for all else.
    Published,
}

/// One committed spec.
pub struct Entry {
    /// `folder/spec`, or `spec` for a showcase.
    pub name: String,
    pub kind: Kind,
    pub path: PathBuf,
    reference: OnceLock<Result<Reference, String>>,
}

impl Entry {
    fn new(name: String, kind: Kind, path: PathBuf) -> Self {
        Self { name, kind, path, reference: OnceLock::new() }
    }

    pub fn open(&self) -> Result<(Spec, Opened), String> {
        let small = match self.kind {
            Kind::Property => None,
            Kind::Showcase => Some(SHOWCASE_SIZE),
            Kind::Published => Some(PUBLISHED_SIZE),
        };
        self.open_changed(|spec| {
            if let Some(size) = small {
                spec.image.size = size;
                spec.image.samples = 1;
            }
        })
    }

    fn open_changed(&self, change: impl FnOnce(&mut Spec)) -> Result<(Spec, Opened), String> {
        let text = fs::read_to_string(&self.path).map_err(|error| format!("{}: {error}", self.path.display()))?;
        open(&self.path, &text, change)
    }

    /// The picture that lies beside the spec, as the CPU backend draws it.
    pub fn picture(&self) -> Result<Frame, String> {
        if self.kind == Kind::Property {
            return Ok(self.reference()?.frame.clone());
        }
        let opened = self.open_changed(|_| ())?.1;
        Ok(cpu::Renderer::new(&opened.scene, &opened.plan)
            .and_then(|cpu| cpu.render(false, &|_| ()))
            .expect("the CPU draws it"))
    }

    /// The CPU backend's picture, rendered once a process.
    pub fn reference(&self) -> Result<&Reference, String> {
        self.reference.get_or_init(|| Ok(reference::of(&self.open()?.1))).as_ref().map_err(Clone::clone)
    }
}

pub fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("lens-specs")
}

/// All committed specs but those that must be refused, sorted by name.
pub fn all() -> Vec<Entry> {
    let mut entries: Vec<Entry> =
        specs_in(&folder()).into_iter().map(|path| Entry::new(stem(&path), Kind::Showcase, path)).collect();
    for topic in topics() {
        let kind = if stem(&topic) == PUBLISHED { Kind::Published } else { Kind::Property };
        let entry = |path: PathBuf| Entry::new(format!("{}/{}", stem(&topic), stem(&path)), kind, path);
        entries.extend(specs_in(&topic).into_iter().map(entry));
    }
    let properties = entries.iter().filter(|entry| entry.kind == Kind::Property).count();
    assert!(properties >= LEAST_PROPERTIES, "only {properties} specs under {}", folder().display());
    entries
}

fn topics() -> Vec<PathBuf> {
    let is_topic = |path: &PathBuf| path.is_dir() && !["invalid", "models"].contains(&stem(path).as_str());
    listed(&folder()).into_iter().filter(is_topic).collect()
}

fn specs_in(folder: &Path) -> Vec<PathBuf> {
    listed(folder).into_iter().filter(|path| path.extension().is_some_and(|extension| extension == "toml")).collect()
}

fn listed(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("lens-specs is part of the project");
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    paths.sort();
    paths
}

fn stem(path: &Path) -> String {
    path.file_stem().expect("a file name").to_string_lossy().into_owned()
}
