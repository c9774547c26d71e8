//! The nodes of a model: as a tree whose siblings with like names are one line, one by one, or those that patterns match.

use std::collections::HashMap;

use super::{InfoChoice, Row, bounds_text, triangles};
use crate::printable;
use crate::scene::{Aabb, Model};
use crate::words::count_of;

/// Siblings that have a name in common, less its number, are one line from so many on.
const FEWEST_OF_A_GROUP: usize = 4;
/// Longest run of lines of siblings.
const MOST_LINES: usize = 40;
/// Of a longer run, this many are listed before the rest is counted.
const SHOWN_LINES: usize = 30;

/// One line of the tree.
enum Line {
    Node(usize),
    /// Siblings, and the pattern that finds them.
    Group {
        pattern: String,
        nodes: Vec<usize>,
    },
    /// Siblings that are only counted.
    Rest(Vec<usize>),
}

/// The tree, roots first; an own stack, for a chain of nodes may be longer than the program's.
pub fn tree(model: &Model, choice: &InfoChoice) -> Vec<Row> {
    let roots: Vec<usize> = (0..model.nodes.len()).filter(|n| model.nodes[*n].parent.is_none()).collect();
    let mut rows = Vec::new();
    let mut stack: Vec<(Line, usize)> = Vec::new();
    let push = |siblings: &[usize], depth: usize, stack: &mut Vec<(Line, usize)>| {
        stack.extend(lines(model, choice, siblings).into_iter().rev().map(|line| (line, depth)));
    };
    push(&roots, 0, &mut stack);
    while let Some((line, depth)) = stack.pop() {
        match line {
            Line::Node(node) => {
                rows.push(row(model, choice, node, &indent(depth)));
                push(&model.nodes[node].children, depth + 1, &mut stack);
            }
            Line::Group { pattern, nodes } => rows.push(group(model, &pattern, &nodes, depth)),
            Line::Rest(nodes) => rows.push(rest(model, &nodes, depth)),
        }
    }
    rows
}

/// The nodes that a pattern matches, by their own name or an ancestor's; each with the way to it.
pub fn matching(model: &Model, choice: &InfoChoice) -> Vec<Row> {
    let is_in = choice.nodes(model);
    let listed = (0..model.nodes.len()).filter(|node| is_in[*node]);
    listed.map(|node| row(model, choice, node, &path(model, node))).collect()
}

/// How many ancestors a path shows.
const MOST_ANCESTORS: usize = 8;

/// The names of the ancestors, each with a slash behind it.
fn path(model: &Model, node: usize) -> String {
    let ancestors = std::iter::successors(model.nodes[node].parent, |n| model.nodes[*n].parent);
    let mut names: Vec<String> = ancestors.take(MOST_ANCESTORS + 1).map(|n| model.node_label(n)).collect();
    if names.len() > MOST_ANCESTORS {
        names[MOST_ANCESTORS] = "...".into();
    }
    names.iter().rev().map(|name| format!("{}/", printable::name(name))).collect()
}

fn lines(model: &Model, choice: &InfoChoice, siblings: &[usize]) -> Vec<Line> {
    if choice.all {
        return siblings.iter().map(|node| Line::Node(*node)).collect();
    }
    let mut groups: HashMap<&str, Vec<usize>> = HashMap::new();
    for &node in siblings {
        groups.entry(stem(&model.nodes[node].name)).or_default().push(node);
    }
    let mut lines = Vec::new();
    for &node in siblings {
        let stem = stem(&model.nodes[node].name);
        let Some(nodes) = groups.get(stem).filter(|nodes| nodes.len() >= FEWEST_OF_A_GROUP) else {
            lines.push(Line::Node(node));
            continue;
        };
        // The first of a group stands for all.
        if nodes[0] == node {
            let same = nodes.iter().all(|n| model.nodes[*n].name == model.nodes[node].name);
            let pattern = if same { model.nodes[node].name.clone() } else { format!("{stem}*") };
            lines.push(Line::Group { pattern, nodes: nodes.clone() });
        }
    }
    if lines.len() > MOST_LINES {
        let rest = lines.split_off(SHOWN_LINES).into_iter().flat_map(|line| match line {
            Line::Node(node) => vec![node],
            Line::Group { nodes, .. } | Line::Rest(nodes) => nodes,
        });
        let rest = rest.collect();
        lines.push(Line::Rest(rest));
    }
    lines
}

/// A name without the number at its end.
fn stem(name: &str) -> &str {
    let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
    // All of a name that is nothing but a number is kept.
    if stem.is_empty() { name } else { stem }
}

/// Two blanks a level, as deep as a line can take.
fn indent(depth: usize) -> String {
    "  ".repeat(depth.min(20))
}

fn row(model: &Model, choice: &InfoChoice, index: usize, before: &str) -> Row {
    let node = &model.nodes[index];
    let mut cells = vec![format!("{before}{index} {}", choice.shown(&node.name))];
    let mut what = Vec::new();
    if let Some(mesh) = node.mesh {
        let name = &model.meshes[mesh].name;
        what.push(format!("mesh {mesh} {}", printable::name(name)).trim_end().to_string());
    }
    what.extend(node.camera.map(|camera| format!("camera {camera}")));
    what.extend(node.light.map(|light| format!("light {light}")));
    if !node.drawn {
        what.push("not in this scene".to_string());
    } else if node.hidden {
        what.push("hidden by the file".to_string());
    }
    cells.push(what.join(", "));
    if let Some(mesh) = node.mesh {
        let closure = model.closure(mesh, 1.0);
        let closed = match (closure.closed, closure.open) {
            (0, _) => "open",
            (_, 0) => "closed",
            _ => "closed in parts",
        };
        let triangles = triangles(&model.meshes[mesh]);
        cells.push(count_of(triangles, "triangle"));
        cells.push(if triangles == 0 { String::new() } else { closed.into() });
        cells.push(bounds_text(&model.node_bounds(index)));
    }
    Row { cells }
}

fn group(model: &Model, pattern: &str, nodes: &[usize], depth: usize) -> Row {
    let Under { nodes: count, triangles, bounds, meshes, closed } = Under::of(model, nodes);
    let name = if pattern.is_empty() { "(no name)".into() } else { printable::name(pattern) };
    let below = match count - nodes.len() {
        0 => String::new(),
        below => format!(", {below} below them"),
    };
    let mut cells = vec![format!("{}{name}", indent(depth)), count_of(nodes.len(), "node") + &below];
    cells.push(count_of(triangles, "triangle"));
    cells.push(match (meshes, closed) {
        (0, _) => String::new(),
        (all, closed) if all == closed => "closed".into(),
        (_, 0) => "open".into(),
        (all, closed) => format!("{closed} of {all} closed"),
    });
    cells.push(bounds_text(&bounds));
    Row { cells }
}

fn rest(model: &Model, nodes: &[usize], depth: usize) -> Row {
    let Under { nodes: count, triangles, .. } = Under::of(model, nodes);
    let text = format!("{}... and {}", indent(depth), count_of(count, "more node"));
    Row { cells: vec![text, "(--all, or a pattern as 'Wheel*')".into(), count_of(triangles, "triangle")] }
}

/// What some subtrees have together.
struct Under {
    nodes: usize,
    triangles: usize,
    bounds: Aabb,
    /// Nodes with a mesh, and those of them whose mesh has closed pieces: those an eraser can cap.
    meshes: usize,
    closed: usize,
}

impl Under {
    fn of(model: &Model, roots: &[usize]) -> Self {
        let mut open = roots.to_vec();
        let mut sum = Self { nodes: 0, triangles: 0, bounds: Aabb::EMPTY, meshes: 0, closed: 0 };
        while let Some(node) = open.pop() {
            sum.nodes += 1;
            if let Some(mesh) = model.nodes[node].mesh {
                sum.triangles += triangles(&model.meshes[mesh]);
                sum.meshes += 1;
                sum.closed += usize::from(model.closure(mesh, 1.0).closed > 0);
                sum.bounds = sum.bounds.union(model.node_bounds(node));
            }
            open.extend(&model.nodes[node].children);
        }
        sum
    }
}
