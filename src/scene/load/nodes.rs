//! The node tree, its transforms in f64, and the chosen scene.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use gltf::json;

use super::{File, object};
use crate::InputError;
use crate::scene::Node;
use crate::spec::SceneChoice;

/// All nodes and the index of the scene shown.
pub fn load(
    file: &File<'_>,
    choice: Option<&SceneChoice>,
    warnings: &mut Vec<String>,
) -> Result<(Vec<Node>, usize), InputError> {
    let scene = choose(file, choice)?;
    let mut nodes = Vec::with_capacity(file.root().nodes.len());
    for (index, json) in file.root().nodes.iter().enumerate() {
        nodes.push(node(file, index, json, warnings)?);
    }
    link(file, &mut nodes)?;
    let order = top_down(file, &nodes)?;
    place(file, &mut nodes, &order)?;
    draw(file, &mut nodes, scene, &order);
    Ok((nodes, scene))
}

/// The scene asked for, else the file's default, else the first.
fn choose(file: &File<'_>, choice: Option<&SceneChoice>) -> Result<usize, InputError> {
    let root = file.root();
    let found = match choice {
        None => return Ok(root.scene.map_or(0, |s| s.value())),
        Some(SceneChoice::Index(index)) => Some(*index).filter(|i| *i < root.scenes.len()),
        Some(SceneChoice::Name(name)) => root.scenes.iter().position(|s| s.name.as_ref() == Some(name)),
    };
    found.ok_or_else(|| {
        let asked = match choice {
            Some(SceneChoice::Name(name)) => format!("no scene named `{name}`"),
            Some(SceneChoice::Index(index)) => format!("no scene {index}"),
            None => "no scene".to_string(),
        };
        let there = |(i, s): (usize, &json::Scene)| {
            s.name.as_ref().map_or(format!("{i} (no name)"), |name| format!("{i} `{name}`"))
        };
        let list: Vec<String> = root.scenes.iter().enumerate().map(there).collect();
        let list = if list.is_empty() { "none".to_string() } else { list.join(", ") };
        InputError::new(format!("{}: {asked}", file.name)).help(format!("its scenes: {list}"))
    })
}

/// One node on its own: `world_from_local` holds its local transform until [`place`] has run.
fn node(file: &File<'_>, index: usize, json: &json::Node, warnings: &mut Vec<String>) -> Result<Node, InputError> {
    let label = object("node", index, json.name.as_deref());
    let local = local_transform(json, &label, warnings);
    if !local.is_finite() {
        return Err(file.error(label, "its transform is not finite"));
    }
    Ok(Node {
        name: json.name.clone().unwrap_or_default(),
        parent: None,
        children: json.children.iter().flatten().map(|c| c.value()).collect(),
        world_from_local: local,
        mesh: json.mesh.map(|m| m.value()),
        camera: json.camera.map(|c| c.value()),
        light: json.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref()).map(|l| l.light.value()),
        drawn: false,
    })
}

fn local_transform(json: &json::Node, label: &str, warnings: &mut Vec<String>) -> DAffine3 {
    if let Some(m) = json.matrix {
        if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
            warnings.push(format!("{label}: the last row of its matrix is not 0 0 0 1 and is ignored"));
        }
        let column = |c: usize| DVec3::new(m[4 * c].into(), m[4 * c + 1].into(), m[4 * c + 2].into());
        let matrix = DMat3::from_cols(column(0), column(1), column(2));
        return DAffine3 { matrix3: matrix, translation: column(3) };
    }
    let vector = |v: Option<[f32; 3]>, default| v.map_or(default, |v| DVec3::from(v.map(f64::from)));
    DAffine3::from_scale_rotation_translation(
        vector(json.scale, DVec3::ONE),
        rotation(json, label, warnings),
        vector(json.translation, DVec3::ZERO),
    )
}

fn rotation(json: &json::Node, label: &str, warnings: &mut Vec<String>) -> DQuat {
    let Some(rotation) = &json.rotation else { return DQuat::IDENTITY };
    let quaternion = DQuat::from_array(rotation.0.map(f64::from));
    let length = quaternion.length();
    if length == 0.0 || !length.is_finite() {
        warnings.push(format!("{label}: its rotation is not a quaternion and is ignored"));
        return DQuat::IDENTITY;
    }
    quaternion / length
}

fn link(file: &File<'_>, nodes: &mut [Node]) -> Result<(), InputError> {
    for parent in 0..nodes.len() {
        for child in nodes[parent].children.clone() {
            if let Some(other) = nodes[child].parent.replace(parent) {
                let label = object("node", child, Some(&nodes[child].name));
                return Err(file
                    .error(label, format!("it is a child of node {other} and of node {parent}"))
                    .help("glTF nodes form a tree: one parent each"));
            }
        }
    }
    Ok(())
}

/// Every node after its parent. Nodes have one parent at most here, so what no root reaches lies on a cycle.
fn top_down(file: &File<'_>, nodes: &[Node]) -> Result<Vec<usize>, InputError> {
    let mut order: Vec<usize> = (0..nodes.len()).filter(|n| nodes[*n].parent.is_none()).collect();
    let mut next = 0;
    while let Some(node) = order.get(next) {
        order.extend(&nodes[*node].children);
        next += 1;
    }
    if order.len() == nodes.len() {
        return Ok(order);
    }
    let mut reached = vec![false; nodes.len()];
    order.iter().for_each(|n| reached[*n] = true);
    let lost = reached.iter().position(|r| !r).unwrap_or(0);
    let label = object("node", lost, Some(&nodes[lost].name));
    Err(file.error(label, "it is its own ancestor, or a descendant of one that is").help("glTF nodes form a tree"))
}

fn place(file: &File<'_>, nodes: &mut [Node], order: &[usize]) -> Result<(), InputError> {
    for &index in order {
        let Some(parent) = nodes[index].parent else { continue };
        let world = nodes[parent].world_from_local * nodes[index].world_from_local;
        if !world.is_finite() {
            let label = object("node", index, Some(&nodes[index].name));
            return Err(file.error(label, "its transform, with those of its ancestors, is not finite"));
        }
        nodes[index].world_from_local = world;
    }
    Ok(())
}

/// Marks what the scene shows; a file without scenes shows everything.
fn draw(file: &File<'_>, nodes: &mut [Node], scene: usize, order: &[usize]) {
    match file.root().scenes.get(scene) {
        Some(scene) => scene.nodes.iter().for_each(|root| nodes[root.value()].drawn = true),
        None => nodes.iter_mut().filter(|n| n.parent.is_none()).for_each(|n| n.drawn = true),
    }
    for &index in order {
        if let Some(parent) = nodes[index].parent {
            nodes[index].drawn |= nodes[parent].drawn;
        }
    }
}
