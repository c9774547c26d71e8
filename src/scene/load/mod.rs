//! glTF bytes to a checked [`Model`].
//!
//! One way for every file: container ([`glb`]) -> JSON and its indices ([`check`]) -> buffers ([`open`]) -> the parts of
//! the model. Nothing is allocated from a number in the file before that number has been held against the bytes there.

mod accessor;
mod animation;
mod attributes;
mod camera;
mod check;
mod geometry;
mod glb;
mod image;
mod light;
mod material;
mod nodes;
mod open;
mod texture;
pub(super) mod uri;

use std::borrow::Cow;
use std::path::Path;

use gltf::json;

use super::{BoundsCache, ClosureCache, Model};
use crate::InputError;
use crate::spec::SceneChoice;
use crate::words::count_of;

/// Fetches an external URI: percent-decoded, relative to the file.
pub type Fetch<'f> = dyn FnMut(&str) -> Result<Vec<u8>, InputError> + 'f;

/// A parsed and validated glTF file with its buffers.
struct File<'a> {
    /// How messages name it.
    name: &'a str,
    document: gltf::Document,
    /// Each at least as long as its declared `byteLength`.
    buffers: Vec<Cow<'a, [u8]>>,
}

impl File<'_> {
    fn root(&self) -> &json::Root {
        self.document.as_json()
    }

    /// An error about one object of the file.
    fn error(&self, object: impl std::fmt::Display, what: impl std::fmt::Display) -> InputError {
        InputError::new(format!("{}: {object}: {what}", self.name))
    }
}

/// How messages name an object of a glTF file: ``mesh 3 `Gear` ``.
pub(super) fn object(kind: &str, index: usize, name: Option<&str>) -> String {
    match name {
        Some(name) if !name.is_empty() => format!("{kind} {index} `{name}`"),
        _ => format!("{kind} {index}"),
    }
}

impl Model {
    /// Opens a `.glb` or `.gltf` file with its external buffers and images.
    pub fn load(path: &Path, choice: Option<&SceneChoice>) -> Result<Model, InputError> {
        let name = path.display().to_string();
        let bytes = open::read_file(path)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        Self::from_bytes(&bytes, &name, choice, &mut |uri| open::read_beside(folder, uri))
    }

    /// Reads a glTF file from memory; `fetch` gets the external URIs it names, percent-decoded and relative to the file.
    pub fn from_bytes(
        bytes: &[u8],
        name: &str,
        choice: Option<&SceneChoice>,
        fetch: &mut Fetch<'_>,
    ) -> Result<Model, InputError> {
        let container = glb::split(bytes, name)?;
        let mut warnings = Vec::new();
        let root = check::parse(container.json, name, &mut warnings)?;
        warnings.extend(check::root(&root, name)?);
        let buffers = open::buffers(&root, name, container.bin, fetch)?;
        let file = File { name, document: gltf::Document::from_json_without_validation(root), buffers };
        let (nodes, scene) = nodes::load(&file, choice, &mut warnings)?;
        let animations = animation::load(&file, &nodes, &mut warnings)?;
        let materials = material::load(&file, &mut warnings)?;
        let textures = texture::load(&file);
        let mut extensions = file.root().extensions_used.clone();
        extensions.sort();
        extensions.dedup();
        let mut model = Model {
            name: name.to_string(),
            meshes: geometry::load(&file, &mut warnings)?,
            lights: light::load(&file)?,
            cameras: camera::load(&file)?,
            animations,
            scenes: file.root().scenes.iter().map(|s| s.name.clone()).collect(),
            nodes,
            materials,
            textures,
            images: Vec::new(),
            scene,
            extensions,
            warnings: Vec::new(),
            bounds_cache: BoundsCache::default(),
            closure_cache: ClosureCache::default(),
        };
        model.pose(None)?;
        model.images = image::load(&file, &model.used_images(), fetch)?;
        model.warnings = warnings;
        Ok(model)
    }
}
