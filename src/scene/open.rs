//! Opens everything a spec names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use super::{MaterialRecord, Model, TextureSet, lens_meshes};
use crate::InputError;
use crate::lens::LensMeshes;
use crate::spec::{Filter, Spec};

/// The models of a spec with what they share: materials and textures in one table each.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// The scene file, then the alternates in the order of the spec.
    pub models: Vec<Model>,
    /// Names of the alternates; number i is `models[i + 1]`.
    pub alternates: Vec<String>,
    /// The materials of all models, one after the other.
    pub materials: Vec<MaterialRecord>,
    /// Where each model's materials start in `materials`.
    pub material_base: Vec<usize>,
    pub textures: TextureSet,
    /// The texture of each file that a `texture` filter names.
    pub filter_textures: BTreeMap<PathBuf, u32>,
    /// The solids of `mesh` shapes.
    pub lens_meshes: LensMeshes,
}

impl Scene {
    /// Reads the models and images that a spec names. The first that fails is the error, with the line that names it.
    pub fn open(spec: &Spec) -> Result<Self, InputError> {
        let choice = spec.scene.scene.as_ref();
        let load = |path: &Path, choice, span: &std::ops::Range<usize>| {
            Model::load(path, choice).map_err(|e| e.or_at(&spec.source, span.clone()))
        };
        let file = &spec.scene.file;
        let first = load(&file.value, choice.map(|c| &c.value), &file.span);
        let mut models = vec![first.map_err(|error| match choice {
            // Where the file opens without the choice, the choice is what is wrong.
            Some(choice) if Model::load(&file.value, None).is_ok() => {
                InputError { labels: vec![(choice.span.clone(), "here".into())], ..error }
            }
            _ => error,
        })?];
        for (_, path) in &spec.scene.alternates {
            models.push(load(&path.value, None, &path.span)?);
        }
        let mut scene = Self::new(models, spec.scene.alternates.iter().map(|(name, _)| name.clone()).collect());
        let filters = spec.lenses.iter().flat_map(|l| &l.filters).chain(spec.overlaps.iter().flat_map(|o| &o.filters));
        for filter in filters {
            if let Filter::Texture { file, .. } = &filter.value {
                scene.add_filter_texture(&file.value).map_err(|e| e.or_at(&spec.source, file.span.clone()))?;
            }
        }
        let alternates = spec.scene.alternates.iter().map(|(_, path)| path.value.as_path());
        let mut known: BTreeMap<&Path, &Model> = alternates.zip(&scene.models[1..]).collect();
        if choice.is_none() {
            known.insert(&file.value, &scene.models[0]);
        }
        scene.lens_meshes = lens_meshes::open(spec, &known)?;
        Ok(scene)
    }

    /// A scene of models that are in memory already; the first is the scene, the others its alternates.
    pub fn new(models: Vec<Model>, alternates: Vec<String>) -> Self {
        let mut textures = TextureSet::default();
        let mut materials = Vec::new();
        let mut material_base = Vec::new();
        for model in &models {
            material_base.push(materials.len());
            materials.extend(model.materials.iter().map(|m| MaterialRecord::new(m, model, &mut textures)));
        }
        Self { models, alternates, materials, material_base, textures, ..Self::default() }
    }

    fn add_filter_texture(&mut self, path: &Path) -> Result<(), InputError> {
        if !self.filter_textures.contains_key(path) {
            let image = super::Image::load(path)?;
            let texture = self.textures.add(&image, true, super::Sampler::default());
            self.filter_textures.insert(path.to_path_buf(), texture);
        }
        Ok(())
    }
}
