//! A glTF root whose indices all hold.

use gltf::json;
use gltf::json::mesh::Semantic;
use gltf::json::validation::{Checked, Error, Validate};

use super::warnings::Warnings;
use super::{count_of, losses, object};
use crate::InputError;

/// Extensions this program reads in full.
const SUPPORTED: [&str; 6] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_node_visibility",
    "KHR_texture_transform",
];

/// Required extensions and every index.
pub fn root(root: &json::Root, name: &str, warnings: &mut Warnings) -> Result<(), InputError> {
    required_extensions(root, name)?;
    positions(root, name)?;
    references(root, name)?;
    let ignored = unsupported(&root.extensions_used);
    if !ignored.is_empty() {
        warnings.say(format!("extensions left out: {}", ignored.join(", ")));
    }
    losses::of_file(root).into_iter().for_each(|(_, loss)| warnings.say(loss));
    Ok(())
}

/// Sorted, each once.
fn unsupported(extensions: &[String]) -> Vec<&str> {
    let mut unknown: Vec<&str> = extensions.iter().map(String::as_str).filter(|e| !SUPPORTED.contains(e)).collect();
    unknown.sort_unstable();
    unknown.dedup();
    unknown
}

fn required_extensions(root: &json::Root, name: &str) -> Result<(), InputError> {
    let unknown = unsupported(&root.extensions_required);
    if unknown.is_empty() {
        return Ok(());
    }
    let plural = if unknown.len() == 1 { "an extension that is" } else { "extensions that are" };
    let losses: Vec<String> = losses::of_file(root)
        .into_iter()
        .filter(|(extension, _)| extension.is_some_and(|e| unknown.contains(&e)))
        .map(|(_, loss)| format!("; without it {loss}"))
        .collect();
    let message = format!("{name}: it requires {plural} not supported: {}{}", unknown.join(", "), losses.concat());
    Err(InputError::new(message).help(format!("export it without; supported are {}", SUPPORTED.join(", "))))
}

/// The crate's validation indexes `accessors` by POSITION before it has checked that index, so this comes first.
fn positions(root: &json::Root, name: &str) -> Result<(), InputError> {
    for (index, mesh) in root.meshes.iter().enumerate() {
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let Some(accessor) = primitive.attributes.get(&Checked::Valid(Semantic::Positions)) else { continue };
            if accessor.value() >= root.accessors.len() {
                let place = format!("{name}: {}, primitive {number}", object("mesh", index, mesh.name.as_deref()));
                let there = count_of(root.accessors.len(), "accessor");
                return Err(InputError::new(format!("{place}: POSITION is accessor {accessor}, the file has {there}")));
            }
        }
    }
    Ok(())
}

fn references(root: &json::Root, name: &str) -> Result<(), InputError> {
    let mut found: Vec<(String, Error)> = Vec::new();
    root.validate(root, json::Path::new, &mut |path, error| {
        let path = path().as_str().to_string();
        if !tolerated(&path, error) {
            found.push((path, error));
        }
    });
    let Some((path, error)) = found.first() else { return Ok(()) };
    let what = match error {
        Error::IndexOutOfBounds => "it names an object that the file does not have",
        Error::Missing => "it is missing",
        Error::Oversize => "it is too large for this machine",
        Error::Invalid | Error::Unsupported => "its value is not one that glTF 2.0 knows",
    };
    let more = found.len() - 1;
    let more = if more == 0 { String::new() } else { format!(", and {} like it", count_of(more, "more fault")) };
    Err(InputError::new(format!("{name}: {path}: {what}{more}")))
}

/// Faults we can live with: required extensions and accessors are checked by our own code, bounds are not used,
/// attributes of unknown names are not read, textures without a source and primitives without positions are left out.
fn tolerated(path: &str, error: Error) -> bool {
    let bounds = path.ends_with(".min") || path.ends_with(".max");
    let unknown_attribute = path.contains("<invalid semantic name>") && error == Error::Invalid;
    let missing = error == Error::Missing;
    let no_view = path.starts_with("accessors[") && path.ends_with(".bufferView") && missing;
    let no_source = path.starts_with("textures[") && path.ends_with(".source") && missing;
    let no_position = path.contains(".primitives[") && path.ends_with("[\"POSITION\"]") && missing;
    error == Error::Unsupported || bounds || unknown_attribute || no_view || no_source || no_position
}
