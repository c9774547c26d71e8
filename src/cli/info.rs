//! `lenspeel info MODEL`: what is in a model, for people.

use std::fmt::Write;

use glam::DVec3;

use crate::scene::{Aabb, AlphaMode, Animation, Camera, LightKind, Material, Mesh, Model};

/// Longest run of siblings that is listed one by one.
const MAX_SIBLINGS: usize = 40;
/// Of a longer run, this many are listed before the rest is counted.
const SHOWN_SIBLINGS: usize = 10;

/// Everything worth knowing about a model, as aligned text.
pub fn info_text(model: &Model) -> String {
    let mut out = format!("{}\n", model.name);
    totals(model, &mut out);
    let parts: [fn(&Model) -> Vec<Row>; 8] = [scenes, nodes, materials, textures, images, lights, cameras, animations];
    let titles = ["scenes", "nodes", "materials", "textures", "images", "lights", "cameras", "animations"];
    for (title, rows) in titles.iter().zip(parts.map(|part| part(model))) {
        section(&mut out, title, &rows);
    }
    let line = |text: &String| Row { cells: vec![text.clone()] };
    section(&mut out, "extensions", &model.extensions.iter().map(line).collect::<Vec<_>>());
    section(&mut out, "warnings", &model.warnings.iter().map(line).collect::<Vec<_>>());
    out
}

/// One line of a table.
struct Row {
    cells: Vec<String>,
}

/// Writes rows in columns; a section without rows is left out.
fn section(out: &mut String, title: &str, rows: &[Row]) {
    if rows.is_empty() {
        return;
    }
    let columns = rows.iter().map(|r| r.cells.len()).max().unwrap_or(0);
    let width = |c: usize| rows.iter().filter_map(|r| r.cells.get(c)).map(|t| t.chars().count()).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let _ = writeln!(out, "\n{title}");
    for row in rows {
        let cells: Vec<String> = row.cells.iter().zip(&widths).map(|(text, width)| format!("{text:<width$}")).collect();
        let _ = writeln!(out, "  {}", cells.join("  ").trim_end());
    }
}

fn totals(model: &Model, out: &mut String) {
    let drawn: Vec<_> = model.nodes.iter().filter(|n| n.drawn).collect();
    let shown: usize = drawn.iter().filter_map(|n| n.mesh).map(|m| triangles(&model.meshes[m])).sum();
    let stored: usize = model.meshes.iter().map(triangles).sum();
    let vertices: usize = model.meshes.iter().flat_map(|m| &m.primitives).map(|p| p.positions.len()).sum();
    let _ = writeln!(out, "  {shown} triangles shown, {stored} stored in {} meshes", model.meshes.len());
    let _ = writeln!(out, "  {vertices} vertices, {} nodes ({} shown)", model.nodes.len(), drawn.len());
    let bounds = model.bounds();
    let _ = writeln!(out, "  bounds {}", bounds_text(&bounds));
    if !bounds.is_empty() {
        let _ = writeln!(out, "  size   {}, centre {}", vector(bounds.size()), vector(bounds.center()));
    }
}

fn triangles(mesh: &Mesh) -> usize {
    mesh.primitives.iter().map(|p| p.triangles.len()).sum()
}

/// The text of a name, or of its absence.
fn named(name: &str) -> String {
    if name.is_empty() { "(no name)".to_string() } else { name.to_string() }
}

fn scenes(model: &Model) -> Vec<Row> {
    let row = |(index, name): (usize, &Option<String>)| {
        let shown = if index == model.scene { "shown" } else { "" };
        Row { cells: vec![index.to_string(), named(name.as_deref().unwrap_or_default()), shown.to_string()] }
    };
    model.scenes.iter().enumerate().map(row).collect()
}

/// The tree, roots first; an own stack, for a chain of nodes may be longer than the program's.
fn nodes(model: &Model) -> Vec<Row> {
    enum Entry {
        Node(usize),
        Rest { nodes: usize, triangles: usize },
    }
    let roots: Vec<usize> = (0..model.nodes.len()).filter(|n| model.nodes[*n].parent.is_none()).collect();
    let mut rows = Vec::new();
    let mut stack: Vec<(Entry, usize)> = Vec::new();
    let push = |siblings: &[usize], depth: usize, stack: &mut Vec<(Entry, usize)>| {
        let cut = if siblings.len() > MAX_SIBLINGS { SHOWN_SIBLINGS } else { siblings.len() };
        let (shown, rest) = siblings.split_at(cut);
        if !rest.is_empty() {
            let (nodes, triangles) = under(model, rest);
            stack.push((Entry::Rest { nodes, triangles }, depth));
        }
        stack.extend(shown.iter().rev().map(|n| (Entry::Node(*n), depth)));
    };
    push(&roots, 0, &mut stack);
    while let Some((entry, depth)) = stack.pop() {
        match entry {
            Entry::Node(node) => {
                rows.push(node_row(model, node, depth));
                push(&model.nodes[node].children, depth + 1, &mut stack);
            }
            Entry::Rest { nodes, triangles } => {
                let text = format!("{}... and {nodes} more nodes", indent(depth));
                rows.push(Row { cells: vec![text, String::new(), format!("{triangles} triangles")] });
            }
        }
    }
    rows
}

/// Nodes and triangles in some subtrees.
fn under(model: &Model, roots: &[usize]) -> (usize, usize) {
    let mut open = roots.to_vec();
    let (mut nodes, mut count) = (0, 0);
    while let Some(node) = open.pop() {
        nodes += 1;
        count += model.nodes[node].mesh.map_or(0, |m| triangles(&model.meshes[m]));
        open.extend(&model.nodes[node].children);
    }
    (nodes, count)
}

/// Two blanks a level, as deep as a line can take.
fn indent(depth: usize) -> String {
    "  ".repeat(depth.min(20))
}

fn node_row(model: &Model, index: usize, depth: usize) -> Row {
    let node = &model.nodes[index];
    let mut cells = vec![format!("{}{index} {}", indent(depth), named(&node.name))];
    let mut what = Vec::new();
    if let Some(mesh) = node.mesh {
        what.push(format!("mesh {mesh} {}", model.meshes[mesh].name).trim_end().to_string());
    }
    what.extend(node.camera.map(|camera| format!("camera {camera}")));
    what.extend(node.light.map(|light| format!("light {light}")));
    if !node.drawn {
        what.push("not in this scene".to_string());
    }
    cells.push(what.join(", "));
    if let Some(mesh) = node.mesh {
        cells.push(format!("{} triangles", triangles(&model.meshes[mesh])));
        cells.push(bounds_text(&model.node_bounds(index)));
    }
    Row { cells }
}

fn materials(model: &Model) -> Vec<Row> {
    let last = model.materials.len().saturating_sub(1);
    let default_used = model.meshes.iter().flat_map(|m| &m.primitives).any(|p| p.material == last);
    let row = |(index, material): (usize, &Material)| {
        let name = if index == last { "(glTF's default)".to_string() } else { named(&material.name) };
        let [r, g, b, a] = material.base_color.map(number);
        let base = format!("base {r} {g} {b} {a}");
        let surface = format!("metallic {} roughness {}", number(material.metallic), number(material.roughness));
        Row { cells: vec![index.to_string(), name, base, surface, material_notes(model, material)] }
    };
    model.materials.iter().enumerate().filter(|(i, _)| *i != last || default_used).map(row).collect()
}

fn material_notes(model: &Model, material: &Material) -> String {
    let mut notes = Vec::new();
    match material.alpha_mode {
        AlphaMode::Opaque => {}
        AlphaMode::Mask(cutoff) => notes.push(format!("mask at {}", number(cutoff))),
        AlphaMode::Blend => notes.push("blend".to_string()),
    }
    if material.double_sided {
        notes.push("double-sided".to_string());
    }
    if material.unlit {
        notes.push("unlit".to_string());
    }
    let texture = |(role, r): (&str, &crate::scene::TextureRef)| {
        format!("{role}: texture {} (image {})", r.texture, model.textures[r.texture].image)
    };
    notes.extend(material.textures().map(texture));
    notes.join(", ")
}

fn textures(model: &Model) -> Vec<Row> {
    let row = |(index, texture): (usize, &crate::scene::Texture)| {
        let sampler = &texture.sampler;
        let filter = |linear: bool| if linear { "linear" } else { "nearest" };
        let filters = format!("{}/{}, mips {:?}", filter(sampler.mag_linear), filter(sampler.min_linear), sampler.mips);
        let wrap = format!("wrap {:?} {:?}", sampler.wrap[0], sampler.wrap[1]);
        Row { cells: vec![index.to_string(), format!("image {}", texture.image), filters, wrap] }
    };
    model.textures.iter().enumerate().map(row).collect()
}

fn images(model: &Model) -> Vec<Row> {
    let used = model.used_images();
    let row = |(index, image): (usize, &crate::scene::Image)| {
        let size = if used.binary_search(&index).is_ok() {
            format!("{} x {}", image.width, image.height)
        } else {
            "no material uses it".to_string()
        };
        Row { cells: vec![index.to_string(), named(&image.name), size] }
    };
    model.images.iter().enumerate().map(row).collect()
}

fn lights(model: &Model) -> Vec<Row> {
    let row = |(index, light): (usize, &crate::scene::Light)| {
        let degrees = |angle: f32| number(angle.to_degrees());
        let (kind, unit) = match light.kind {
            LightKind::Directional => ("directional".to_string(), "lx"),
            LightKind::Point => ("point".to_string(), "cd"),
            LightKind::Spot { inner, outer } => {
                (format!("spot {} to {} degrees", degrees(inner), degrees(outer)), "cd")
            }
        };
        let range = light.range.map_or(String::new(), |r| format!("range {}", number(r)));
        Row {
            cells: vec![
                index.to_string(),
                named(&light.name),
                kind,
                format!("{} {unit}", number(light.intensity)),
                range,
            ],
        }
    };
    model.lights.iter().enumerate().map(row).collect()
}

fn cameras(model: &Model) -> Vec<Row> {
    let row = |(index, camera): (usize, &Camera)| {
        let node = model.nodes.iter().position(|n| n.camera == Some(index));
        let place = node.map_or("at no node".to_string(), |n| format!("at node {n} {}", model.nodes[n].name));
        let lens = match camera {
            Camera::Perspective { fov_y, near, far } => {
                let far = far.map_or("infinity".to_string(), number);
                format!("perspective, fov_y {}, near {}, far {far}", number(fov_y.to_degrees()), number(*near))
            }
            Camera::Orthographic { half_height, near, far } => {
                let height = number(2.0 * half_height);
                format!("orthographic, height {height}, near {}, far {}", number(*near), number(*far))
            }
        };
        Row { cells: vec![index.to_string(), place.trim_end().to_string(), lens] }
    };
    model.cameras.iter().enumerate().map(row).collect()
}

fn animations(model: &Model) -> Vec<Row> {
    let row = |(index, animation): (usize, &Animation)| {
        let mut nodes: Vec<usize> = animation.channels.iter().map(|c| c.node).collect();
        nodes.sort_unstable();
        nodes.dedup();
        let moves = format!("moves {} nodes", nodes.len());
        let cells = vec![index.to_string(), named(&animation.name), moves, format!("to {} s", number(animation.end()))];
        Row { cells }
    };
    model.animations.iter().enumerate().map(row).collect()
}

fn bounds_text(bounds: &Aabb) -> String {
    if bounds.is_empty() {
        return "empty".to_string();
    }
    format!("{} to {}", vector(bounds.min), vector(bounds.max))
}

fn vector(v: DVec3) -> String {
    format!("({} {} {})", number(v.x), number(v.y), number(v.z))
}

/// Four significant digits, without trailing zeros.
fn number(value: impl Into<f64>) -> String {
    let value: f64 = value.into();
    if value == 0.0 || !value.is_finite() {
        return if value == 0.0 { "0".to_string() } else { value.to_string() };
    }
    let magnitude = value.abs().log10().floor() as i32;
    if !(-4..7).contains(&magnitude) {
        return format!("{value:.3e}");
    }
    let decimals = (3 - magnitude).max(0) as usize;
    let text = format!("{value:.decimals$}");
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}

#[cfg(test)]
mod tests {
    use super::number;

    #[test]
    fn numbers_keep_four_digits() {
        for (value, text) in [
            (0.0, "0"),
            (1.0, "1"),
            (-0.5, "-0.5"),
            (std::f64::consts::PI, "3.142"),
            (123456.7, "123457"),
            (0.00012346, "0.0001235"),
            (1e-9, "1.000e-9"),
            (100.0, "100"),
        ] {
            assert_eq!(number(value), text);
        }
    }
}
