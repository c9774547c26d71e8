//! What a picture of a file will lack: said in numbers of what is there, not only by an extension's name.

use gltf::json;
use serde_json::Value;

use super::count_of;

const INSTANCING: &str = "EXT_mesh_gpu_instancing";
const DRACO: &str = "KHR_draco_mesh_compression";
const MESHOPT: [&str; 2] = ["EXT_meshopt_compression", "KHR_meshopt_compression"];

/// Losses that concern the file as a whole, each with the extension it comes of, if any.
pub fn of_file(root: &json::Root) -> Vec<(Option<&'static str>, String)> {
    let mut losses = Vec::new();
    let copies: Vec<u64> = root.nodes.iter().filter_map(|node| copies(root, node)).collect();
    // Files may claim any number.
    let (all, nodes) = (copies.iter().fold(0, |all: u64, own| all.saturating_add(*own)), copies.len() as u64);
    if nodes > 0 {
        let lost = all.saturating_sub(nodes);
        losses.push((
            Some(INSTANCING),
            format!(
                "{lost} of {all} copies of {} are missing: {INSTANCING} is not read",
                count_of(copies.len(), "node")
            ),
        ));
    }
    let skinned = root.nodes.iter().filter(|node| node.skin.is_some() && node.mesh.is_some()).count();
    if skinned > 0 {
        let meshes = root.nodes.iter().filter(|node| node.mesh.is_some()).count();
        losses.push((
            None,
            format!("skins of {skinned} of {} with a mesh not applied: shown as stored", count_of(meshes, "node")),
        ));
    }
    losses
}

/// How many copies of its mesh a node asks for.
fn copies(root: &json::Root, node: &json::Node) -> Option<u64> {
    node.mesh?;
    let instancing = node.extensions.as_ref()?.others.get(INSTANCING)?;
    let attributes = instancing.get("attributes").and_then(Value::as_object);
    let count = |accessor: &Value| {
        let index = usize::try_from(accessor.as_u64()?).ok()?;
        Some(root.accessors.get(index)?.count.0)
    };
    Some(attributes.into_iter().flat_map(|a| a.values()).find_map(count).unwrap_or(0))
}

/// What a mesh's morph targets would do.
pub fn of_morphs(mesh: &json::Mesh) -> Option<String> {
    let targets = mesh.primitives.iter().filter_map(|p| Some(p.targets.as_ref()?.len())).max().filter(|n| *n > 0)?;
    let at_rest = mesh.weights.iter().flatten().filter(|weight| **weight != 0.0).count();
    let at_rest = if at_rest == 0 { String::new() } else { format!(", {at_rest} of them in use at rest") };
    Some(format!("{} not applied{at_rest}", count_of(targets, "morph target")))
}

/// The extension without which a primitive has no geometry: that of an accessor of its own without other bytes.
pub fn compression(root: &json::Root, has_bytes: &[bool], primitive: &json::mesh::Primitive) -> Option<&'static str> {
    let others = primitive.extensions.as_ref().map(|e| &e.others);
    let is_draco = others.is_some_and(|others| others.contains_key(DRACO));
    let accessors = primitive.attributes.values().chain(&primitive.indices);
    accessors.filter_map(|index| root.accessors.get(index.value())).find_map(|accessor| match accessor.buffer_view {
        None => (is_draco && accessor.sparse.is_none()).then_some(DRACO),
        Some(view) => {
            let view = root.buffer_views.get(view.value())?;
            let others = &view.extensions.as_ref()?.others;
            let name = MESHOPT.into_iter().find(|name| others.contains_key(*name))?;
            (!has_bytes.get(view.buffer.value())?).then_some(name)
        }
    })
}

/// The extension that names another image of a texture.
pub fn texture_source(texture: &json::Texture) -> Option<&str> {
    let others = &texture.extensions.as_ref()?.others;
    others.iter().find(|(_, value)| value.get("source").is_some()).map(|(name, _)| name.as_str())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn counts_that_no_number_holds_are_no_panic() {
        let node = serde_json::json!({"mesh": 0, "extensions": {INSTANCING: {"attributes": {"TRANSLATION": 0}}}});
        let root: json::Root = serde_json::from_value(serde_json::json!({
            "asset": {"version": "2.0"},
            "accessors": [{"componentType": 5126, "type": "VEC3", "count": u64::MAX}],
            "nodes": [node, node],
        }))
        .expect("it parses");
        let lost = format!("{} of {} copies of 2 nodes", u64::MAX - 2, u64::MAX);
        assert!(of_file(&root)[0].1.starts_with(&lost), "{:?}", of_file(&root));
    }
}
