//! JSON to a glTF root whose indices all hold.

use gltf::json;
use gltf::json::mesh::Semantic;
use gltf::json::validation::{Checked, Error, Validate};

use super::{count_of, object};
use crate::InputError;

/// Extensions this program reads in full.
const SUPPORTED: [&str; 5] = [
    "KHR_lights_punctual",
    "KHR_materials_emissive_strength",
    "KHR_materials_unlit",
    "KHR_mesh_quantization",
    "KHR_texture_transform",
];

pub fn parse(json: &[u8], name: &str, warnings: &mut Vec<String>) -> Result<json::Root, InputError> {
    json::Root::from_slice(json).or_else(|error| {
        let (root, left_out) = without_targetless_channels(json).ok_or_else(|| {
            InputError::new(format!("{name}: not a glTF file: {error}"))
                .help("expected glTF 2.0, as .gltf (JSON) or .glb")
        })?;
        warnings.push(format!("{} without a target node left out", count_of(left_out, "animation channel")));
        Ok(root)
    })
}

/// glTF lets extensions animate other things than nodes, by channels without a target node; the crate's types do not.
fn without_targetless_channels(json: &[u8]) -> Option<(json::Root, usize)> {
    let mut root: serde_json::Value = serde_json::from_slice(json).ok()?;
    let mut left_out = 0;
    for animation in root.get_mut("animations")?.as_array_mut()? {
        let channels = animation.get_mut("channels")?.as_array_mut()?;
        let before = channels.len();
        channels.retain(|channel| channel.pointer("/target/node").is_some());
        left_out += before - channels.len();
    }
    Some((serde_json::from_value(root).ok()?, left_out)).filter(|_| left_out > 0)
}

/// Version, required extensions and every index; returns warnings.
pub fn root(root: &json::Root, name: &str) -> Result<Vec<String>, InputError> {
    version(root, name)?;
    required_extensions(root, name)?;
    positions(root, name)?;
    references(root, name)?;
    Ok(warnings(root))
}

fn version(root: &json::Root, name: &str) -> Result<(), InputError> {
    let version = root.asset.min_version.as_ref().unwrap_or(&root.asset.version);
    let known = if root.asset.min_version.is_some() { version == "2.0" } else { version.starts_with("2.") };
    if known {
        return Ok(());
    }
    Err(InputError::new(format!("{name}: glTF version `{version}`")).help("expected 2.0"))
}

fn required_extensions(root: &json::Root, name: &str) -> Result<(), InputError> {
    let mut unknown: Vec<&str> =
        root.extensions_required.iter().map(String::as_str).filter(|e| !SUPPORTED.contains(e)).collect();
    unknown.sort_unstable();
    unknown.dedup();
    if unknown.is_empty() {
        return Ok(());
    }
    let plural = if unknown.len() == 1 { "an extension that is" } else { "extensions that are" };
    Err(InputError::new(format!("{name}: it requires {plural} not supported: {}", unknown.join(", ")))
        .help(format!("export it without; supported are {}", SUPPORTED.join(", "))))
}

/// The crate's validation indexes `accessors` by POSITION before it has checked that index, so this comes first.
fn positions(root: &json::Root, name: &str) -> Result<(), InputError> {
    for (index, mesh) in root.meshes.iter().enumerate() {
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("{name}: {}, primitive {number}", object("mesh", index, mesh.name.as_deref()));
            let Some(accessor) = primitive.attributes.get(&Checked::Valid(Semantic::Positions)) else {
                return Err(InputError::new(format!("{place}: it has no POSITION attribute")));
            };
            if accessor.value() >= root.accessors.len() {
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

/// Faults we can live with: required extensions and accessors are checked by our own code, bounds are not used, and
/// attributes of unknown names are not read.
fn tolerated(path: &str, error: Error) -> bool {
    let bounds = path.ends_with(".min") || path.ends_with(".max");
    let unknown_attribute = path.contains("<invalid semantic name>") && error == Error::Invalid;
    let no_view = path.starts_with("accessors[") && path.ends_with(".bufferView") && error == Error::Missing;
    error == Error::Unsupported || bounds || unknown_attribute || no_view
}

fn warnings(root: &json::Root) -> Vec<String> {
    let mut warnings = Vec::new();
    let mut ignored: Vec<&str> =
        root.extensions_used.iter().map(String::as_str).filter(|e| !SUPPORTED.contains(e)).collect();
    ignored.sort_unstable();
    ignored.dedup();
    if !ignored.is_empty() {
        warnings.push(format!("extensions left out: {}", ignored.join(", ")));
    }
    if !root.skins.is_empty() {
        let skins = count_of(root.skins.len(), "skin");
        warnings.push(format!("{skins} not applied: their meshes are shown in the pose they are stored in"));
    }
    warnings
}
