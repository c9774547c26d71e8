//! A model as JSON. Fields are added in later versions, never renamed or removed.

use serde_json::{Value, json};

use super::{InfoChoice, triangles};
use crate::scene::{Aabb, Model};

/// An object with `file`, totals, `bounds` (null without triangles), and a list of each kind of object; `nodes` and
/// `materials` are those that the patterns match. Indices are the file's.
pub fn info_json(model: &Model, choice: &InfoChoice) -> Value {
    let shown: usize =
        model.nodes.iter().filter(|n| n.is_shown()).filter_map(|n| n.mesh).map(|m| triangles(&model.meshes[m])).sum();
    let own = |index: usize| model.materials.len() - 1 != index;
    let materials = model.materials.iter().enumerate().filter(|(i, m)| own(*i) && choice.has_name(&m.name));
    json!({
        "file": model.name,
        "triangles_shown": shown,
        "triangles": model.meshes.iter().map(triangles).sum::<usize>(),
        "bounds": bounds(&model.bounds()),
        "scene": model.scene,
        "scenes": model.scenes,
        "nodes": nodes(model, choice),
        "meshes": (0..model.meshes.len()).map(|mesh| self::mesh(model, mesh)).collect::<Vec<_>>(),
        "materials": materials.map(|(index, m)| json!({"index": index, "name": m.name})).collect::<Vec<_>>(),
        "images": model.images.iter().map(|image| &image.name).collect::<Vec<_>>(),
        "lights": model.lights.iter().map(|light| &light.name).collect::<Vec<_>>(),
        "cameras": model.cameras.len(),
        "animations": model.animations.iter().map(|a| json!({"name": a.name, "seconds": a.end()})).collect::<Vec<_>>(),
        "extensions": model.extensions,
        "warnings": model.warnings,
    })
}

fn nodes(model: &Model, choice: &InfoChoice) -> Vec<Value> {
    let is_in = choice.nodes(model);
    let node = |index: usize| {
        let node = &model.nodes[index];
        json!({
            "index": index,
            "name": node.name,
            "parent": node.parent,
            "mesh": node.mesh,
            "camera": node.camera,
            "light": node.light,
            "in_scene": node.drawn,
            "hidden": node.hidden,
            "bounds": bounds(&model.node_bounds(index)),
        })
    };
    (0..model.nodes.len()).filter(|index| is_in[*index]).map(node).collect()
}

fn mesh(model: &Model, index: usize) -> Value {
    let mesh = &model.meshes[index];
    let closure = model.closure(index, 1.0);
    json!({
        "index": index,
        "name": mesh.name,
        "triangles": triangles(mesh),
        "closed": closure.is_closed(),
        "closed_pieces": closure.closed,
        "open_pieces": closure.open,
    })
}

fn bounds(bounds: &Aabb) -> Option<Value> {
    (!bounds.is_empty()).then(|| json!({"min": bounds.min.to_array(), "max": bounds.max.to_array()}))
}
