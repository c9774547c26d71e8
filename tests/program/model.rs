//! A small model.

use std::fs;

use crate::call::Folder;

/// A model of one triangle, from (0, 0, 0) to (`far`, 0, 0) and (0, `far`, 0); where it is.
pub fn triangle(folder: &Folder, name: &str, far: f32) -> String {
    triangles(folder, name, far, &[r#"{"mesh": 0}"#])
}

/// The same with these nodes, whose `"mesh": 0` is the triangle.
pub fn triangles(folder: &Folder, name: &str, far: f32, nodes: &[&str]) -> String {
    let numbers: Vec<u8> =
        [0.0, 0.0, 0.0, far, 0.0, 0.0, 0.0, far, 0.0].iter().flat_map(|x: &f32| x.to_le_bytes()).collect();
    fs::write(folder.file("t.bin"), &numbers).expect("written");
    let (shown, nodes) = ((0..nodes.len()).collect::<Vec<_>>(), nodes.join(", "));
    let json = format!(
        r#"{{"asset": {{"version": "2.0"}}, "scene": 0, "scenes": [{{"nodes": {shown:?}}}], "nodes": [{nodes}],
        "meshes": [{{"primitives": [{{"attributes": {{"POSITION": 0}}}}]}}],
        "buffers": [{{"uri": "t.bin", "byteLength": 36}}], "bufferViews": [{{"buffer": 0, "byteLength": 36}}],
        "accessors": [{{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3",
        "min": [0, 0, 0], "max": [{far}, {far}, 0]}}]}}"#
    );
    folder.write(name, &json)
}
