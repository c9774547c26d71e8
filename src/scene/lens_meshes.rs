//! Opens the meshes that lens shapes name.

use std::collections::BTreeMap;
use std::path::Path;

use super::{Budget, Model};
use crate::InputError;
use crate::lens::{LensMeshes, MeshForm};
use crate::spec::{At, MeshShape, Shape, Spec};

/// Reads each file once and makes its solids; and what the files left out or repaired. `known` are models that are open
/// already, as their files show them.
pub fn open(
    spec: &Spec,
    known: &BTreeMap<&Path, &Model>,
    allow_outside: bool,
    budget: &mut Budget,
) -> Result<(LensMeshes, Vec<String>), InputError> {
    let mut warnings = Vec::new();
    let mut opened: BTreeMap<&Path, Model> = BTreeMap::new();
    let mut meshes = LensMeshes::default();
    for shape in spec.lenses.iter().flat_map(|lens| lens.shape.parts()) {
        let Shape::Mesh(mesh) = &shape.value else { continue };
        let path = mesh.file.value.as_path();
        if !known.contains_key(path) && !opened.contains_key(path) {
            let model = Model::load_within(path, None, allow_outside, budget)
                .map_err(|e| e.or_at(&spec.source, mesh.file.span.clone()))?;
            warnings.extend(model.named_warnings());
            opened.insert(path, model);
        }
        let model = known.get(path).copied().or(opened.get(path));
        if let Some(model) = model.filter(|_| meshes.get(mesh).is_none()) {
            meshes.insert(mesh, solid(spec, shape, mesh, model)?);
        }
    }
    Ok((meshes, warnings))
}

fn solid(spec: &Spec, shape: &At<Shape>, mesh: &MeshShape, model: &Model) -> Result<MeshForm, InputError> {
    let node = mesh.node.as_ref().map(|name| {
        model
            .node_named(&name.value)
            .map_err(|(message, help)| InputError::at(&spec.source, name.span.clone(), message).help(help))
    });
    MeshForm::new(model, node.transpose()?, mesh.convex).map_err(|e| e.or_at(&spec.source, shape.span.clone()))
}
