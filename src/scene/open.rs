//! Opens everything a spec names.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};

use super::vertex_values::{CURVATURE, add_curvature, fitted_range};
use super::{Budget, CoincidentCache, MaterialRecord, Model, OpenOptions, TextureSet, lens_meshes};
use crate::custom::Custom;
use crate::lens::LensMeshes;
use crate::spec::{At, Filter, Quantity, Spec, suggest};
use crate::{InputError, color_map};

/// Which scene something belongs to; every [`Scene`] that is made gets another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct SceneId(u64);

impl Default for SceneId {
    fn default() -> Self {
        static NEXT: AtomicU64 = AtomicU64::new(0);
        Self(NEXT.fetch_add(1, Ordering::Relaxed))
    }
}

/// The models of a spec with what they share: materials and textures in one table each.
#[derive(Debug, Clone, Default)]
pub struct Scene {
    /// Tells it from other scenes, so that no plan is drawn over a scene that it was not made for. A clone is the same scene.
    pub id: SceneId,
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
    /// The texture, one pixel high, of each colour map that a filter names.
    pub color_maps: BTreeMap<String, u32>,
    /// The user's own filters, by their files.
    pub custom_filters: BTreeMap<PathBuf, Arc<Custom>>,
    /// The fitted range of each vertex value that a filter shows.
    pub value_ranges: BTreeMap<String, [f32; 2]>,
    /// To be replaced with an empty one where a mesh is changed in place.
    pub coincident_cache: CoincidentCache,
    /// What lies across the edges of triangles has been found.
    pub has_edges: bool,
    /// The solids of `mesh` shapes.
    pub lens_meshes: LensMeshes,
    /// Of memory: what is taken, and what there may be.
    pub budget: Budget,
    /// What the models of `mesh` shapes left out or repaired; of [`Scene::models`] each has its own.
    pub lens_warnings: Vec<String>,
}

impl Scene {
    /// Reads the models and images that a spec names. The first that fails is the error, with the line that names it.
    pub fn open(spec: &Spec) -> Result<Self, InputError> {
        Self::open_with(spec, &OpenOptions::default())
    }

    /// The same with other limits.
    pub fn open_with(spec: &Spec, options: &OpenOptions) -> Result<Self, InputError> {
        let mut budget = Budget::new(options.memory_limit);
        let choice = spec.scene.scene.as_ref();
        let mut load = |path: &Path, choice, span: &std::ops::Range<usize>| {
            Model::load_within(path, choice, options.allow_outside, &mut budget)
                .map_err(|e| e.or_at(&spec.source, span.clone()))
        };
        let file = &spec.scene.file;
        let first = load(&file.value, choice.map(|c| &c.value), &file.span);
        let mut models = vec![first.map_err(|error| match choice {
            // Where the file opens without the choice, the choice is what is wrong.
            Some(choice) if Model::load_with(&file.value, None, options).is_ok() => {
                InputError { labels: vec![(choice.span.clone(), "here".into())], ..error }
            }
            _ => error,
        })?];
        for (_, path) in &spec.scene.alternates {
            models.push(load(&path.value, None, &path.span)?);
        }
        let mut scene = Self::new(models, spec.scene.alternates.iter().map(|(name, _)| name.clone()).collect());
        scene.budget = budget;
        scene.prepare_filters(spec)?;
        let alternates = spec.scene.alternates.iter().map(|(_, path)| path.value.as_path());
        let mut known: BTreeMap<&Path, &Model> = alternates.zip(&scene.models[1..]).collect();
        if choice.is_none() {
            known.insert(&file.value, &scene.models[0]);
        }
        let mut budget = scene.budget;
        let lens_meshes = lens_meshes::open(spec, &known, options.allow_outside, &mut budget)?;
        (scene.lens_meshes, scene.lens_warnings) = lens_meshes;
        scene.budget = budget;
        // After the lenses: the time is the scene's, and a mesh lens has the shape its file gives at rest.
        if let Some(time) = &spec.scene.time {
            scene.pose(Some(time.value)).map_err(|e| e.or_at(&spec.source, time.span.clone()))?;
        }
        for (number, model) in scene.models.iter().enumerate() {
            let named = number.checked_sub(1).map_or(&file.span, |alternate| &spec.scene.alternates[alternate].1.span);
            model.check_bounds().map_err(|e| e.or_at(&spec.source, named.clone()))?;
        }
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

    /// Reads and computes what the filters of a spec look up: images, colour maps, numbers at vertices. [`Scene::open`]
    /// does; a scene made of models in memory needs it before a plan whose filters ask for such, which is refused otherwise.
    pub fn prepare_filters(&mut self, spec: &Spec) -> Result<(), InputError> {
        self.bound_comparisons(spec)?;
        let filters = spec.lenses.iter().flat_map(|l| &l.filters).chain(spec.overlaps.iter().flat_map(|o| &o.filters));
        for filter in filters {
            match &filter.value {
                Filter::Texture { file, .. } => {
                    self.add_filter_texture(&file.value).map_err(|e| e.or_at(&spec.source, file.span.clone()))?;
                }
                Filter::FalseColor { quantity, colormap, .. } => {
                    self.add_color_map(colormap);
                    self.add_values(quantity, spec)?;
                }
                Filter::Contours { quantity, .. } => self.add_values(quantity, spec)?,
                Filter::Wireframe { .. } => self.has_edges = true,
                Filter::Wgsl { file, .. } => {
                    self.add_custom(&file.value).map_err(|e| e.or_at(&spec.source, file.span.clone()))?;
                }
                _ => {}
            }
        }
        self.simplify(spec)?;
        if self.has_edges {
            self.models.iter_mut().try_for_each(|model| model.add_across(&mut self.budget))?;
        }
        Ok(())
    }

    /// Fails where a spec's patterns are too many for the names of the models.
    pub(crate) fn bound_comparisons(&self, spec: &Spec) -> Result<(), InputError> {
        super::names::bound_comparisons(spec, &self.models)
    }

    fn add_color_map(&mut self, name: &str) {
        let Some(pixels) = color_map::colors(name) else { return };
        let image = super::Image { name: name.into(), width: color_map::STEPS, height: 1, pixels };
        let sampler =
            super::Sampler { wrap: [super::Wrap::ClampToEdge; 2], mips: super::Mips::None, ..Default::default() };
        let texture = self.textures.add(&image, true, sampler);
        self.color_maps.insert(name.into(), texture);
    }

    fn add_values(&mut self, quantity: &Quantity, spec: &Spec) -> Result<(), InputError> {
        let Some(name) = quantity.value_name() else { return Ok(()) };
        if self.value_ranges.contains_key(name) {
            return Ok(());
        }
        if name == CURVATURE {
            self.models.iter_mut().try_for_each(|model| add_curvature(model, &mut self.budget))?;
        }
        match (fitted_range(&self.models, name), quantity) {
            (Some(range), _) => _ = self.value_ranges.insert(name.into(), range),
            (None, Quantity::Attribute(name)) => return Err(self.no_attribute(name, spec)),
            // Nothing is drawn, then.
            (None, _) => _ = self.value_ranges.insert(name.into(), [0.0; 2]),
        }
        Ok(())
    }

    fn no_attribute(&self, name: &At<String>, spec: &Spec) -> InputError {
        let meshes = self.models.iter().flat_map(|model| &model.meshes);
        let mut known: Vec<&str> = meshes
            .flat_map(|mesh| &mesh.primitives)
            .flat_map(|primitive| primitive.values.keys())
            .map(String::as_str)
            .filter(|key| *key != CURVATURE)
            .collect();
        known.sort_unstable();
        known.dedup();
        let message = format!("no mesh of the scene has a vertex attribute `{}`", name.value);
        let error = InputError::at(&spec.source, name.span.clone(), message);
        match known[..] {
            [] => error.help("its meshes have no attributes of their own, whose names begin with `_`"),
            _ => error.help(suggest::help(&name.value, known)),
        }
    }

    fn add_custom(&mut self, path: &Path) -> Result<(), InputError> {
        if !self.custom_filters.contains_key(path) {
            self.custom_filters.insert(path.to_path_buf(), Arc::new(Custom::open(path)?));
        }
        Ok(())
    }

    fn add_filter_texture(&mut self, path: &Path) -> Result<(), InputError> {
        if !self.filter_textures.contains_key(path) {
            let image = super::Image::load(path, &mut self.budget)?;
            let texture = self.textures.add(&image, true, super::Sampler::default());
            self.filter_textures.insert(path.to_path_buf(), texture);
        }
        Ok(())
    }
}
