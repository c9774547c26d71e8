//! `lenspeel info MODEL`: what is in a model, for people.

mod json;
mod nodes;

use std::borrow::Cow;
use std::fmt::Write;

use glam::DVec3;

use super::args::InfoArgs;
use crate::scene::{Aabb, AlphaMode, Animation, Camera, LightKind, Material, Mesh, Model};
use crate::spec::Pattern;
use crate::words::count_of;
use crate::{InputError, printable};

pub use json::info_json;

/// Cells that are longer do not widen their column.
const WIDEST: usize = 48;

/// How much of a model is listed.
#[derive(Debug, Clone, Default)]
pub struct InfoChoice {
    /// Each node and each name whole, instead of groups of siblings with like names.
    pub all: bool,
    /// Only nodes and materials that one of these matches; empty: no limit.
    pub patterns: Vec<Pattern>,
}

impl InfoChoice {
    fn is_limited(&self) -> bool {
        !self.patterns.is_empty()
    }

    fn has_name(&self, name: &str) -> bool {
        !self.is_limited() || self.patterns.iter().any(|pattern| pattern.matches(name))
    }

    /// For each node whether it is listed: its own name or an ancestor's counts, as in a spec.
    fn nodes(&self, model: &Model) -> Vec<bool> {
        if self.is_limited() { model.nodes_matching(&self.patterns) } else { vec![true; model.nodes.len()] }
    }

    /// A name as it is listed, or that there is none.
    fn shown<'a>(&self, name: &'a str) -> Cow<'a, str> {
        match name {
            "" => "(no name)".into(),
            name if self.all || self.is_limited() => printable::whole_name(name),
            name => printable::name(name),
        }
    }
}

/// `lenspeel info`.
pub fn run(args: &InfoArgs) -> Result<(), InputError> {
    let model = Model::load_with(&args.model, None, &args.open.options())?;
    let patterns = args.patterns.iter().map(Pattern::new).collect();
    let choice = InfoChoice { all: args.all, patterns };
    if args.json { super::print_json(&info_json(&model, &choice)) } else { super::print(&info_text(&model, &choice)) }
}

/// Everything worth knowing about a model, as aligned text; with patterns, what they match.
pub fn info_text(model: &Model, choice: &InfoChoice) -> String {
    let mut out = format!("{}\n", printable::message(&model.name));
    if choice.is_limited() {
        section(&mut out, "nodes", &nodes::matching(model, choice));
        section(&mut out, "materials", &materials(model, choice));
        if !out.contains("\n\n") {
            out += "  no node and no material has a name that matches; upper and lower case differ, `*` stands for any \
                    characters, `?` for one\n";
        }
        return out;
    }
    totals(model, &mut out);
    section(&mut out, "scenes", &scenes(model));
    section(&mut out, "nodes", &nodes::tree(model, choice));
    section(&mut out, "materials", &materials(model, choice));
    let parts: [fn(&Model) -> Vec<Row>; 5] = [textures, images, lights, cameras, animations];
    let titles = ["textures", "images", "lights", "cameras", "animations"];
    for (title, rows) in titles.iter().zip(parts.map(|part| part(model))) {
        section(&mut out, title, &rows);
    }
    let line = |text: &String| Row { cells: vec![printable::message(text).into_owned()] };
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
    let cells = |c: usize| rows.iter().filter_map(move |r| r.cells.get(c)).map(|text| text.chars().count());
    let width = |c: usize| cells(c).filter(|width| *width <= WIDEST).max().unwrap_or(0);
    let widths: Vec<usize> = (0..columns).map(width).collect();
    let _ = writeln!(out, "\n{title}");
    for row in rows {
        let mut line = String::new();
        for (text, width) in row.cells.iter().zip(&widths) {
            let _ = write!(line, "  {text}{:1$}", "", width.saturating_sub(text.chars().count()));
        }
        let _ = writeln!(out, "{}", line.trim_end());
    }
}

fn totals(model: &Model, out: &mut String) {
    let drawn: Vec<_> = model.nodes.iter().filter(|n| n.is_shown()).collect();
    let shown: usize = drawn.iter().filter_map(|n| n.mesh).map(|m| triangles(&model.meshes[m])).sum();
    let stored: usize = model.meshes.iter().map(triangles).sum();
    let vertices: usize = model.meshes.iter().flat_map(|m| &m.primitives).map(|p| p.positions.len()).sum();
    let [shown, meshes] = [(shown, "triangle"), (model.meshes.len(), "mesh")].map(|(n, noun)| count_of(n, noun));
    let _ = writeln!(out, "  {shown} shown, {stored} stored in {meshes}");
    let [vertices, nodes] = [(vertices, "vertex"), (model.nodes.len(), "node")].map(|(n, noun)| count_of(n, noun));
    let _ = writeln!(out, "  {vertices}, {nodes} ({} shown)", drawn.len());
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
    InfoChoice::default().shown(name).into_owned()
}

fn scenes(model: &Model) -> Vec<Row> {
    let row = |(index, name): (usize, &Option<String>)| {
        let shown = if index == model.scene { "shown" } else { "" };
        Row { cells: vec![index.to_string(), named(name.as_deref().unwrap_or_default()), shown.to_string()] }
    };
    model.scenes.iter().enumerate().map(row).collect()
}

fn materials(model: &Model, choice: &InfoChoice) -> Vec<Row> {
    let last = model.materials.len().saturating_sub(1);
    let default_used = model.meshes.iter().flat_map(|m| &m.primitives).any(|p| p.material == last);
    let row = |(index, material): (usize, &Material)| {
        let name =
            if index == last { "(glTF's default)".to_string() } else { choice.shown(&material.name).into_owned() };
        let [r, g, b, a] = material.base_color.map(number);
        let base = format!("base {r} {g} {b} {a}");
        let surface = format!("metallic {} roughness {}", number(material.metallic), number(material.roughness));
        Row { cells: vec![index.to_string(), name, base, surface, material_notes(model, material)] }
    };
    let is_listed = |(index, material): &(usize, &Material)| {
        choice.has_name(&material.name) && (*index != last || (default_used && !choice.is_limited()))
    };
    model.materials.iter().enumerate().filter(is_listed).map(row).collect()
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
        let image = model.textures[r.texture].image.map_or("no image".to_string(), |image| format!("image {image}"));
        format!("{role}: texture {} ({image})", r.texture)
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
        Row {
            cells: vec![
                index.to_string(),
                texture.image.map_or("no image".to_string(), |image| format!("image {image}")),
                filters,
                wrap,
            ],
        }
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
        let place =
            node.map_or("at no node".to_string(), |n| format!("at node {n} {}", printable::name(&model.nodes[n].name)));
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
        let moves = format!("moves {}", count_of(nodes.len(), "node"));
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
