//! Opens the meshes that lens shapes name.

use std::collections::BTreeMap;
use std::path::Path;

use super::{Budget, Model};
use crate::InputError;
use crate::lens::{LensMeshes, MeshForm, count_triangles};
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
            meshes.insert(mesh, solid(spec, shape, mesh, model, budget)?);
        }
    }
    Ok((meshes, warnings))
}

/// Bytes of a triangle of a solid, with its vertices and its share of the hierarchy; and while that is made.
const KEPT: u64 = 128;
const PASSING: u64 = 384;

fn solid(
    spec: &Spec,
    shape: &At<Shape>,
    mesh: &MeshShape,
    model: &Model,
    budget: &mut Budget,
) -> Result<MeshForm, InputError> {
    let node = mesh.node.as_ref().map(|name| {
        model
            .node_named(&name.value)
            .map_err(|what| InputError::at(&spec.source, name.span.clone(), what).help(model.node_help(&name.value)))
    });
    let node = node.transpose()?;
    // Each node has the triangles of its mesh for itself.
    let triangles = count_triangles(model, node);
    let what = || format!("a lens of {triangles} triangles of `{}`", model.name);
    let form = budget.take(triangles.saturating_mul(KEPT + PASSING), what).and_then(|()| {
        budget.give_back(triangles * PASSING);
        MeshForm::new(model, node, mesh.convex)
    });
    form.map_err(|e| e.or_at(&spec.source, shape.span.clone()))
}
