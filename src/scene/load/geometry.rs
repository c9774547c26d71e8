//! Meshes: all triangle modes to triangle lists.

use gltf::json;
use gltf::json::mesh::Mode;
use gltf::json::validation::Checked;
use rayon::prelude::*;

use super::accessor::Accessor;
use super::attributes::Attributes;
use super::{File, count_of, object};
use crate::InputError;
use crate::scene::{Mesh, Primitive};

/// Elements of all attributes and indices together. Primitives may share accessors, so a small file could ask for any
/// amount; at 16 bytes each this is 2 GiB.
const MAX_ELEMENTS: u64 = 1 << 27;

pub fn load(file: &File<'_>, warnings: &mut Vec<String>) -> Result<Vec<Mesh>, InputError> {
    check_total(file)?;
    let meshes = &file.root().meshes;
    let loaded: Vec<_> = meshes.par_iter().enumerate().map(|(index, json)| mesh(file, index, json)).collect();
    // Collected before the first error is taken, so that the same file gives the same error with any number of threads.
    let mut out = Vec::with_capacity(loaded.len());
    for result in loaded {
        let (mesh, mut said) = result?;
        out.push(mesh);
        warnings.append(&mut said);
    }
    Ok(out)
}

fn check_total(file: &File<'_>) -> Result<(), InputError> {
    let root = file.root();
    let primitives = root.meshes.iter().flat_map(|m| &m.primitives);
    let accessors = primitives.flat_map(|p| p.attributes.values().chain(&p.indices));
    let mut total = 0u64;
    for index in accessors {
        let Some(accessor) = root.accessors.get(index.value()) else { continue };
        total = total.saturating_add(accessor.count.0);
        if total > MAX_ELEMENTS {
            let label = object("accessor", index.value(), accessor.name.as_deref());
            let what = format!(
                "with its {} elements the meshes have {total} vertex attributes and indices, at most {MAX_ELEMENTS} can be",
                accessor.count.0
            );
            return Err(file.error(label, what).help("the file is damaged, or too large: split or simplify it"));
        }
    }
    Ok(())
}

fn mesh(file: &File<'_>, index: usize, json: &json::Mesh) -> Result<(Mesh, Vec<String>), InputError> {
    let mut warnings = Vec::new();
    let label = object("mesh", index, json.name.as_deref());
    let mut primitives = Vec::with_capacity(json.primitives.len());
    for (number, primitive_json) in json.primitives.iter().enumerate() {
        let place = format!("{label}, primitive {number}");
        primitives.extend(primitive(file, primitive_json, &place, &mut warnings)?);
    }
    if json.primitives.iter().any(|p| p.targets.as_ref().is_some_and(|t| !t.is_empty())) {
        warnings.push(format!("{label}: morph targets not applied"));
    }
    Ok((Mesh { name: json.name.clone().unwrap_or_default(), primitives }, warnings))
}

/// `None` for points and lines, which lenses do not treat.
fn primitive(
    file: &File<'_>,
    json: &json::mesh::Primitive,
    place: &str,
    warnings: &mut Vec<String>,
) -> Result<Option<Primitive>, InputError> {
    let Checked::Valid(mode) = json.mode else {
        return Err(file.error(place, "its mode is not one that glTF 2.0 knows"));
    };
    if !matches!(mode, Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan) {
        let what = if mode == Mode::Points { "points" } else { "lines" };
        warnings.push(format!("{place}: {what} left out, only triangles are drawn"));
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
        // The limit on elements keeps the count below 2^32.
        return Ok((0..vertices as u32).collect());
    };
    let accessor = Accessor::new(file, index.value(), &format!("{place}, indices"))?;
    let indices = accessor.indices()?;
    match indices.iter().position(|i| *i as usize >= vertices) {
        Some(at) => Err(accessor.error(format!("index {} at place {at}, there are {vertices} vertices", indices[at]))),
        None => Ok(indices),
    }
}

/// The triangles of a list, strip or fan, less those that name a vertex twice.
fn triangles(mode: Mode, corners: &[u32], place: &str, warnings: &mut Vec<String>) -> Vec<[u32; 3]> {
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
            warnings.push(format!("{place}: {} with a repeated corner left out", count_of(dropped, "triangle")));
        }
        if !corners.len().is_multiple_of(3) {
            let rest = corners.len() % 3;
            warnings.push(format!("{place}: {} after the last whole triangle left out", count_of(rest, "corner")));
        }
    }
    triangles
}

/// Every second triangle of a strip is turned so that all face the same way (glTF 2.0, section 3.7.2.1).
fn strip_triangle(number: usize, window: &[u32]) -> [u32; 3] {
    if number.is_multiple_of(2) { [window[0], window[1], window[2]] } else { [window[0], window[2], window[1]] }
}
