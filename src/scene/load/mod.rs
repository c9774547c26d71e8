//! glTF bytes to a checked [`Model`].
//!
//! One way for every file: container ([`glb`]) -> JSON ([`json`]) and its indices ([`check`]) -> buffers ([`open`]) -> the
//! parts of the model. Nothing is allocated from a number in the file before the [`Budget`] has allowed it.

mod accessor;
mod animation;
mod attributes;
mod camera;
mod check;
mod geometry;
mod glb;
mod image;
mod json;
mod light;
mod losses;
mod material;
mod nodes;
pub(super) mod open;
mod texture;
pub(super) mod uri;
mod warnings;

use std::borrow::Cow;
use std::path::Path;

use super::{BoundsCache, Budget, ClosureCache, Model, OpenOptions};
use crate::spec::SceneChoice;
use crate::words::count_of;
use crate::{InputError, printable};
use open::{Fault, Fetch};
use warnings::Warnings;

/// A parsed and validated glTF file with its buffers.
struct File<'a> {
    /// How messages name it.
    name: &'a str,
    document: gltf::Document,
    /// Where each node stands.
    placements: Vec<json::Placement>,
    /// Each at least as long as its declared `byteLength`; `None`: it has no bytes.
    buffers: Vec<Option<Cow<'a, [u8]>>>,
}

impl File<'_> {
    fn root(&self) -> &gltf::json::Root {
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
        Some(name) if !name.is_empty() => format!("{kind} {index} `{}`", printable::name(name)),
        _ => format!("{kind} {index}"),
    }
}

impl Model {
    /// Opens a `.glb` or `.gltf` file with its external buffers and images.
    pub fn load(path: &Path, choice: Option<&SceneChoice>) -> Result<Model, InputError> {
        Self::load_with(path, choice, &OpenOptions::default())
    }

    /// The same with other limits.
    pub fn load_with(path: &Path, choice: Option<&SceneChoice>, options: &OpenOptions) -> Result<Model, InputError> {
        Self::load_within(path, choice, options.allow_outside, &mut Budget::new(options.memory_limit))
    }

    /// The same with what is left of a budget.
    pub(super) fn load_within(
        path: &Path,
        choice: Option<&SceneChoice>,
        allow_outside: bool,
        budget: &mut Budget,
    ) -> Result<Model, InputError> {
        let name = path.display().to_string();
        let bytes = open::read_file(path, budget)?;
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut fetch = |uri: &str, most: u64| open::read_beside(folder, uri, allow_outside, most);
        let model = Self::read(&bytes, &name, choice, &mut fetch, budget);
        budget.give_back(bytes.len() as u64);
        model
    }

    /// Reads a glTF file from memory; `fetch` gets the paths it names, percent-decoded and relative to the file. What
    /// leads out of the file's folder is refused.
    pub fn from_bytes(
        bytes: &[u8],
        name: &str,
        choice: Option<&SceneChoice>,
        fetch: &mut dyn FnMut(&str) -> Result<Vec<u8>, InputError>,
    ) -> Result<Model, InputError> {
        let mut inside = |uri: &str, _most: u64| {
            if uri::leads_out(uri) { Err(open::outside(uri)) } else { fetch(uri).map_err(Fault::Missing) }
        };
        Self::read(bytes, name, choice, &mut inside, &mut Budget::default())
    }

    fn read(
        bytes: &[u8],
        name: &str,
        choice: Option<&SceneChoice>,
        fetch: &mut Fetch<'_>,
        budget: &mut Budget,
    ) -> Result<Model, InputError> {
        let container = glb::split(bytes, name)?;
        let mut warnings = Warnings::default();
        let json::Parsed { root, placements, cost } = json::parse(container.json, name, budget, &mut warnings)?;
        check::root(&root, name, &mut warnings)?;
        let buffers = open::buffers(&root, name, container.bin, fetch, budget)?;
        let file = File { name, document: gltf::Document::from_json_without_validation(root), placements, buffers };
        let (nodes, scene) = nodes::load(&file, choice, &mut warnings)?;
        let animations = animation::load(&file, &nodes, budget, &mut warnings)?;
        let materials = material::load(&file, &mut warnings)?;
        let textures = texture::load(&file, &mut warnings);
        let mut extensions = file.root().extensions_used.clone();
        extensions.sort();
        extensions.dedup();
        let mut model = Model {
            name: name.to_string(),
            meshes: geometry::load(&file, budget, &mut warnings)?,
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
        let (images, is_unread) = image::load(&file, &model.used_images(), fetch, budget, &mut warnings)?;
        model.images = images;
        for texture in &mut model.textures {
            texture.image = texture.image.filter(|image| !is_unread[*image]);
        }
        if let Some(nothing) = nothing_to_see(&model) {
            warnings.say(nothing);
        }
        model.warnings = warnings.into_lines();
        let own = file.buffers.iter().flatten().filter(|bytes| matches!(bytes, Cow::Owned(_)));
        budget.give_back(cost + own.map(|bytes| bytes.len() as u64).sum::<u64>());
        Ok(model)
    }
}

/// Why a picture of the model will be blank, if it will.
fn nothing_to_see(model: &Model) -> Option<String> {
    let has_triangles = |mesh: usize| model.meshes[mesh].primitives.iter().any(|p| !p.triangles.is_empty());
    let shows = |node: &super::Node| node.is_shown() && node.mesh.is_some_and(has_triangles);
    if model.nodes.iter().any(shows) {
        return None;
    }
    let drawn = model.nodes.iter().filter(|node| node.drawn).count();
    Some(match (model.nodes.len(), drawn) {
        (0, _) => "there is nothing to see: the file has no nodes".into(),
        (all, 0) => format!("there is nothing to see: the scene has none of the file's {}", count_of(all, "node")),
        (_, drawn) => format!(
            "there is nothing to see: {} in the scene, and no triangles that are shown",
            count_of(drawn, "node")
        ),
    })
}
