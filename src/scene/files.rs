//! The files that opening a spec reads, found without opening much.

use std::collections::{BTreeSet, HashSet};
use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use serde::Deserialize;

use super::OpenOptions;
use super::load::{open, uri};
use crate::output::folder_of;
use crate::spec::{Filter, Shape, Spec};

/// Each once, with a few words on what it is. Files that cannot be read name no others: whoever opens them will tell.
pub fn files(spec: &Spec) -> Vec<(PathBuf, &'static str)> {
    let mut models = vec![(&spec.scene.file.value, "the model")];
    models.extend(spec.scene.alternates.iter().map(|(_, path)| (&path.value, "the model of an alternate")));
    let shapes = spec.lenses.iter().flat_map(|lens| lens.shape.parts());
    models.extend(shapes.filter_map(|shape| match &shape.value {
        Shape::Mesh(mesh) => Some((&mesh.file.value, "the mesh of a lens")),
        _ => None,
    }));
    // Many may name one file.
    let opened: BTreeSet<&PathBuf> = models.iter().map(|(path, _)| *path).collect();
    let beside = opened.into_iter().flat_map(|path| beside(path)).collect::<Vec<_>>();
    let filters = spec.lenses.iter().flat_map(|l| &l.filters).chain(spec.overlaps.iter().flat_map(|o| &o.filters));
    let of_filters = filters.filter_map(|filter| match &filter.value {
        Filter::Texture { file, .. } => Some((file.value.clone(), "the image of a filter")),
        Filter::Wgsl { file, .. } => Some((file.value.clone(), "the file of a filter")),
        _ => None,
    });
    let models = models.iter().map(|(path, what)| ((*path).clone(), *what));
    let all = models.chain(beside.into_iter().map(|path| (path, "a file of the model"))).chain(of_filters);
    let mut known = HashSet::new();
    all.filter(|(path, _)| known.insert(path.clone())).collect()
}

/// The part of a glTF file that names others.
#[derive(Default, Deserialize)]
struct Names {
    #[serde(default)]
    buffers: Vec<Named>,
    #[serde(default)]
    images: Vec<Named>,
}

#[derive(Deserialize)]
struct Named {
    uri: Option<String>,
}

/// The buffers and images beside a model.
fn beside(model: &Path) -> Vec<PathBuf> {
    let json = json_text(model).unwrap_or_default();
    let names: Names = serde_json::from_slice(&json).unwrap_or_default();
    let uris = names.buffers.iter().chain(&names.images).filter_map(|named| named.uri.as_deref());
    let relative = uris.filter(|uri| !uri.starts_with("data:")).filter_map(|uri| match uri::parse(uri) {
        Ok(uri::Target::Relative(path)) => Some(path),
        _ => None,
    });
    relative.map(|path| folder_of(model).join(path)).collect()
}

/// The JSON of a model: the first chunk of a binary file, else all of it.
fn json_text(model: &Path) -> Option<Vec<u8>> {
    // A pipe can be read only once.
    std::fs::metadata(model).ok().filter(std::fs::Metadata::is_file)?;
    let mut file = File::open(model).ok()?;
    let mut head = [0; 20];
    if file.read_exact(&mut head).is_err() || !head.starts_with(b"glTF") {
        return open::read(model, OpenOptions::MEMORY_LIMIT).ok();
    }
    let length = u32::from_le_bytes([head[12], head[13], head[14], head[15]]);
    let mut json = Vec::new();
    file.take(length.into()).read_to_end(&mut json).ok()?;
    Some(json)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_that_a_spec_names_and_what_that_names() {
        let folder = std::env::temp_dir().join(format!("lenspeel-{}-files", std::process::id()));
        std::fs::create_dir_all(&folder).expect("the system's folder takes one");
        let json = r#"{"buffers": [{"uri": "a%20b.bin", "byteLength": 1}, {"byteLength": 2}, {"uri": "data:,x"}],
            "images": [{"uri": "c.png", "name": 7}], "nodes": "not a list"}"#;
        let at = |name: &str| folder.join(name);
        std::fs::write(at("m.gltf"), json).expect("written");
        let length = json.len() as u32;
        let lengths = [length + 20, length].map(u32::to_le_bytes);
        let glb = [b"glTF\x02\0\0\0", &lengths[0][..], &lengths[1], b"JSON", json.as_bytes(), b"more"].concat();
        std::fs::write(at("l.glb"), glb).expect("written");
        let text = "[scene]\nfile = 'm.gltf'\n[scene.alternates]\nb = 'none.glb'\n[[lens]]\nname = 'a'\n\
            shape.union = [{ mesh = { file = 'l.glb' } }, { sphere = { center = [0, 0, 0], radius = 1 } }]\n\
            filters = [{ texture = { file = 't.png' } }, { wgsl = { file = 'f.wgsl' } }]\n";
        let spec = Spec::parse(text, "a test", &folder).expect("a spec");
        let mut found: Vec<String> = files(&spec)
            .iter()
            .map(|(path, _)| path.strip_prefix(&folder).expect("in the folder").display().to_string())
            .collect();
        found.sort();
        assert_eq!(found, ["a b.bin", "c.png", "f.wgsl", "l.glb", "m.gltf", "none.glb", "t.png"], "each once");
    }
}
