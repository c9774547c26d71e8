//! The node tree, its transforms in f64, and the chosen scene.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use gltf::json;

use super::json::Placement;
use super::warnings::Warnings;
use super::{File, object};
use crate::InputError;
use crate::scene::{Node, Transform, pose::top_down};
use crate::spec::SceneChoice;

/// All nodes and the index of the scene shown.
pub fn load(
    file: &File<'_>,
    choice: Option<&SceneChoice>,
    warnings: &mut Warnings,
) -> Result<(Vec<Node>, usize), InputError> {
    let scene = choose(file, choice)?;
    let mut hidden = Vec::with_capacity(file.root().nodes.len());
    let mut nodes = Vec::with_capacity(file.root().nodes.len());
    for (index, json) in file.root().nodes.iter().enumerate() {
        nodes.push(node(file, index, json, warnings)?);
        hidden.push(is_hidden(json));
    }
    link(file, &mut nodes)?;
    let order = top_down(&nodes);
    no_cycles(file, &nodes, &order)?;
    draw(file, &mut nodes, scene, &order);
    for &index in &order {
        nodes[index].hidden = hidden[index] || nodes[index].parent.is_some_and(|parent| nodes[parent].hidden);
    }
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

/// One node on its own: links and the place in the world come later.
fn node(file: &File<'_>, index: usize, json: &json::Node, warnings: &mut Warnings) -> Result<Node, InputError> {
    let label = object("node", index, json.name.as_deref());
    let rest = transform(&file.placements[index], &label, warnings);
    if !rest.parent_from_local().is_finite() {
        return Err(file.error(label, "its transform is not finite"));
    }
    Ok(Node {
        name: json.name.clone().unwrap_or_default(),
        parent: None,
        children: json.children.iter().flatten().map(|c| c.value()).collect(),
        rest,
        world_from_local: DAffine3::IDENTITY,
        mesh: json.mesh.map(|m| m.value()),
        camera: json.camera.map(|c| c.value()),
        light: json.extensions.as_ref().and_then(|e| e.khr_lights_punctual.as_ref()).map(|l| l.light.value()),
        drawn: false,
        hidden: false,
    })
}

/// By `KHR_node_visibility`, of itself.
fn is_hidden(json: &json::Node) -> bool {
    let visibility = json.extensions.as_ref().and_then(|e| e.others.get("KHR_node_visibility"));
    visibility.and_then(|v| v.get("visible")?.as_bool()) == Some(false)
}

fn transform(placement: &Placement, label: &str, warnings: &mut Warnings) -> Transform {
    if let Some(m) = placement.matrix {
        if [m[3], m[7], m[11], m[15]] != [0.0, 0.0, 0.0, 1.0] {
            warnings.add(label, "the last row of its matrix is not 0 0 0 1 and is ignored");
        }
        let column = |c: usize| DVec3::new(m[4 * c], m[4 * c + 1], m[4 * c + 2]);
        let matrix = DMat3::from_cols(column(0), column(1), column(2));
        return Transform::Matrix(DAffine3 { matrix3: matrix, translation: column(3) });
    }
    let vector = |v: Option<[f64; 3]>, default| v.map_or(default, DVec3::from);
    Transform::Parts {
        translation: vector(placement.translation, DVec3::ZERO),
        rotation: rotation(placement, label, warnings),
        scale: vector(placement.scale, DVec3::ONE),
    }
}

fn rotation(placement: &Placement, label: &str, warnings: &mut Warnings) -> DQuat {
    let Some(rotation) = placement.rotation else { return DQuat::IDENTITY };
    let quaternion = DQuat::from_array(rotation);
    let length = quaternion.length();
    if length == 0.0 || !length.is_finite() {
        warnings.add(label, "its rotation is not a quaternion and is ignored");
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

/// Nodes have one parent at most here, so what no root reaches lies on a cycle.
fn no_cycles(file: &File<'_>, nodes: &[Node], order: &[usize]) -> Result<(), InputError> {
    if order.len() == nodes.len() {
        return Ok(());
    }
    let mut reached = vec![false; nodes.len()];
    order.iter().for_each(|n| reached[*n] = true);
    let lost = reached.iter().position(|r| !r).unwrap_or(0);
    let label = object("node", lost, Some(&nodes[lost].name));
    Err(file.error(label, "it is its own ancestor, or a descendant of one that is").help("glTF nodes form a tree"))
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
