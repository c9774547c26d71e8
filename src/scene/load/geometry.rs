//! Meshes: all triangle modes to triangle lists.

use gltf::json;
use gltf::json::mesh::{Mode, Semantic};
use gltf::json::validation::Checked;
use rayon::prelude::*;

use super::accessor::{Accessor, most_elements};
use super::attributes::Attributes;
use super::warnings::Warnings;
use super::{File, losses, object};
use crate::InputError;
use crate::scene::{Budget, Mesh, Primitive};

pub fn load(file: &File<'_>, budget: &mut Budget, warnings: &mut Warnings) -> Result<Vec<Mesh>, InputError> {
    take_all(file, budget)?;
    let meshes = &file.root().meshes;
    let loaded: Vec<_> = meshes.par_iter().enumerate().map(|(index, json)| mesh(file, index, json)).collect();
    // Collected before the first error is taken, so that the same file gives the same error with any number of threads.
    let mut out = Vec::with_capacity(loaded.len());
    for result in loaded {
        let (mesh, said) = result?;
        out.push(mesh);
        warnings.append(said);
    }
    Ok(out)
}

/// Takes what all meshes need before the first is read: primitives may share accessors, so that a small file could ask
/// for any amount.
fn take_all(file: &File<'_>, budget: &mut Budget) -> Result<(), InputError> {
    let mut transient = 0u64;
    for (index, mesh) in file.root().meshes.iter().enumerate() {
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let Cost { vertices, triangles, stored, passing } = Cost::of(file.root(), primitive);
            let label = || {
                let label = object("mesh", index, mesh.name.as_deref());
                format!(
                    "{}: {label}, primitive {number}, with {vertices} vertices and {triangles} triangles",
                    file.name
                )
            };
            budget.take(stored.saturating_add(passing), label)?;
            transient += passing;
        }
    }
    budget.give_back(transient);
    Ok(())
}

/// What a primitive takes, by what it claims to have.
struct Cost {
    vertices: u64,
    triangles: u64,
    /// Bytes of [`Primitive`].
    stored: u64,
    /// Bytes while it is read.
    passing: u64,
}

impl Cost {
    fn of(root: &json::Root, primitive: &json::mesh::Primitive) -> Self {
        let count = |index: &json::Index<json::Accessor>| most_elements(root, index.value());
        let vertices = primitive.attributes.get(&Checked::Valid(Semantic::Positions)).map_or(0, count);
        let corners = primitive.indices.as_ref().map_or(vertices, count);
        let triangles = match primitive.mode {
            Checked::Valid(Mode::Triangles) => corners / 3,
            Checked::Valid(Mode::TriangleStrip | Mode::TriangleFan) => corners.saturating_sub(2),
            _ => 0,
        };
        // Four floats, the most that an attribute is kept as.
        let attributes = primitive.attributes.len() as u64 * 16;
        let stored = vertices.saturating_mul(attributes).saturating_add(triangles.saturating_mul(12));
        Self { vertices, triangles, stored, passing: corners.saturating_mul(4) }
    }
}

fn mesh(file: &File<'_>, index: usize, json: &json::Mesh) -> Result<(Mesh, Warnings), InputError> {
    let mut warnings = Warnings::default();
    let label = object("mesh", index, json.name.as_deref());
    let mut primitives = Vec::with_capacity(json.primitives.len());
    for (number, primitive_json) in json.primitives.iter().enumerate() {
        let place = format!("{label}, primitive {number}");
        primitives.extend(primitive(file, primitive_json, &place, &mut warnings)?);
    }
    if let Some(loss) = losses::of_morphs(json) {
        warnings.add(&label, loss);
    }
    Ok((Mesh { name: json.name.clone().unwrap_or_default(), primitives }, warnings))
}

/// `None` for points and lines, which lenses do not treat, and for what has no geometry that is read.
fn primitive(
    file: &File<'_>,
    json: &json::mesh::Primitive,
    place: &str,
    warnings: &mut Warnings,
) -> Result<Option<Primitive>, InputError> {
    let Checked::Valid(mode) = json.mode else {
        return Err(file.error(place, "its mode is not one that glTF 2.0 knows"));
    };
    if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        let what = if mode == Mode::Points { "points" } else { "lines" };
        warnings.add(place, format!("{what} left out, only triangles are drawn"));
        return Ok(None);
    }
    if !json.attributes.contains_key(&Checked::Valid(Semantic::Positions)) {
        warnings.add(place, "it has no POSITION attribute and is left out");
        return Ok(None);
    }
    let has_bytes: Vec<bool> = file.buffers.iter().map(Option::is_some).collect();
    if let Some(extension) = losses::compression(file.root(), &has_bytes, json) {
        warnings.add(place, format!("left out: its geometry is compressed with {extension}, which is not read"));
        return Ok(None);
    }
    let attributes = Attributes::new(file, json, place);
    let positions = attributes.positions()?;
    let count = positions.len();
    let corners = corners(file, json, place, count)?;
    let triangles = triangles(mode, &corners, place, warnings);
    let normals = attributes.normals(&positions, &triangles, warnings)?;
    Ok(Some(Primitive {
        tangents: attributes.tangents(normals.as_deref(), warnings)?,
        uv: [attributes.uv(0, count, warnings)?, attributes.uv(1, count, warnings)?],
        colors: attributes.colors(count, warnings)?,
        values: attributes.values(count, warnings)?,
        // Without a material: glTF's default one, which stands last.
        material: json.material.map_or(file.root().materials.len(), |m| m.value()),
        positions,
        normals,
        triangles,
        simplified: Vec::new(),
        across: Vec::new(),
        first_vertex: 0,
    }))
}

/// Vertex numbers in drawing order, all below `vertices`.
fn corners(
    file: &File<'_>,
    json: &json::mesh::Primitive,
    place: &str,
    vertices: usize,
) -> Result<Vec<u32>, InputError> {
    let Some(index) = json.indices else {
        let last = u32::try_from(vertices)
            .map_err(|_| file.error(place, format!("{vertices} vertices, at most {} are read", u32::MAX)))?;
        return Ok((0..last).collect());
    };
    let accessor = Accessor::new(file, index.value(), &format!("{place}, indices"))?;
    let indices = accessor.indices()?;
    match indices.iter().position(|i| *i as usize >= vertices) {
        Some(at) => Err(accessor.error(format!("index {} at place {at}, there are {vertices} vertices", indices[at]))),
        None => Ok(indices),
    }
}

/// The triangles of a list, strip or fan, less those that name a vertex twice.
fn triangles(mode: Mode, corners: &[u32], place: &str, warnings: &mut Warnings) -> Vec<[u32; 3]> {
    let mut triangles: Vec<[u32; 3]> = match mode {
        Mode::TriangleStrip => corners.windows(3).enumerate().map(|(i, w)| strip_triangle(i, w)).collect(),
        Mode::TriangleFan => corners.windows(2).skip(1).map(|w| [w[0], w[1], corners[0]]).collect(),
        _ => corners.chunks_exact(3).map(|c| [c[0], c[1], c[2]]).collect(),
    };
    let all = triangles.len();
    triangles.retain(|[a, b, c]| a != b && b != c && c != a);
    if mode == Mode::Triangles {
        // In strips repeated corners are how pieces are joined.
        let dropped = all - triangles.len();
        if dropped > 0 {
            warnings.add_count(place, dropped, "triangle", "with a repeated corner left out");
        }
        if !corners.len().is_multiple_of(3) {
            let rest = corners.len() % 3;
            warnings.add_count(place, rest, "corner", "after the last whole triangle left out");
        }
    }
    triangles
}

/// Every second triangle of a strip is turned so that all face the same way (glTF 2.0, section 3.7.2.1).
fn strip_triangle(number: usize, window: &[u32]) -> [u32; 3] {
    if number.is_multiple_of(2) { [window[0], window[1], window[2]] } else { [window[0], window[2], window[1]] }
}
