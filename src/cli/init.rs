//! `lenspeel init MODEL`: a starter spec that fits the model and teaches the format.

use std::path::{Component, Path, PathBuf};

use glam::DVec3;

use super::outputs;
use super::streams::Messages;
use crate::output::{Place, folder_of};
use crate::scene::{Aabb, Model, OpenOptions};
use crate::spec::Spec;
use crate::{InputError, printable};

/// What `lenspeel init` looks along: from the right, above and in front.
const VIEW: DVec3 = DVec3::new(1.0, 0.7, 1.3);
/// Degrees; the format's default.
const FOV_Y: f64 = 45.0;

/// Writes a starter spec, to standard output where no file is named.
pub fn run(path: &Path, output: Option<&Path>, options: &OpenOptions, messages: Messages) -> Result<(), InputError> {
    let output = output.unwrap_or(Path::new(outputs::STREAM));
    let into_file = !outputs::is_stream(output) && matches!(Place::of(output)?, Place::File(_));
    if into_file && output.exists() {
        let message = format!("{} is there already, and a starter spec would replace it", output.display());
        return Err(InputError::new(message).help("choose another name, or remove it first"));
    }
    outputs::check_whole(output, "the starter spec", "toml")?;
    let model = Model::load_with(path, None, options)?;
    model.check_bounds()?;
    let file = if into_file { relative(path, folder_of(output)) } else { std::path::absolute(path).ok() };
    let file = file.unwrap_or_else(|| path.to_path_buf());
    let name = file.to_str().ok_or_else(|| {
        InputError::new(format!("the path {} is not UTF-8, and so no spec can name it", file.display()))
            .help("give the file, or the folder that it is in, another name")
    })?;
    let text = init_text(&model, name);
    // What is drawn may be larger or smaller than the numbers of a spec reach.
    Spec::parse(&text, "the starter spec", Path::new("")).map_err(|error| {
        let size = model.bounds().size();
        let message = format!(
            "{}: no starter spec fits the model, whose bounds are {:.1e} x {:.1e} x {:.1e}: {}",
            path.display(),
            size.x,
            size.y,
            size.z,
            error.message
        );
        InputError::new(message).help("scale the model; `lenspeel info` tells its bounds")
    })?;
    outputs::write(output, text.as_bytes())?;
    if into_file {
        messages.note(format_args!("wrote {}", output.display()));
    }
    Ok(())
}

/// A path to `file` that holds in a spec in `folder`, wherever the two lie; `None` where no relative one does.
fn relative(file: &Path, folder: &Path) -> Option<PathBuf> {
    // Links lead elsewhere, and `..` goes up from there.
    let there = std::fs::canonicalize(folder_of(file)).ok()?;
    let here = std::fs::canonicalize(folder).ok()?;
    let shared = there.components().zip(here.components()).take_while(|(a, b)| a == b).count();
    let is_far = here.components().take(shared).all(|part| !matches!(part, Component::Normal(_)));
    let up = here.components().skip(shared).map(|_| Component::ParentDir);
    let path: PathBuf = up.chain(there.components().skip(shared)).collect();
    if is_far { Some(there.join(file.file_name()?)) } else { Some(path.join(file.file_name()?)) }
}

/// A commented lens spec for the model; `model_path` is written as the spec's `file`.
pub fn init_text(model: &Model, model_path: &str) -> String {
    let frame = Frame::of(&model.bounds());
    let [eye, target, ball, slab] = [frame.eye, frame.center, frame.ball, frame.slab].map(|v| frame.vector(v));
    let radius = frame.round(frame.ball_radius);
    let size = frame.vector(frame.slab_size);
    let file = quoted(model_path);
    let how = match Path::new(model_path).is_absolute() {
        true => "or relative to this spec: `-o` writes it so",
        false => "relative to this spec",
    };
    let scene = scene_line(model);
    let erase = erase_line(model);
    format!(
        r##"# A starting point: two lenses that overlap. Change a number, render again, see what happens.
#   lenspeel render THIS.toml -o picture.png
# Lengths are in the model's units, angles in degrees, colours "#rrggbb" or CSS names.
version = 1

[scene]
file = {file}    # {how}
{scene}
[camera]
eye = {eye}
target = {target}    # the middle of the model
fov_y = 45    # vertical; or orthographic_height = ...

[image]
size = [1280, 720]
samples = 4    # per pixel: 1 (fast), 4, 9 or 16
background = "#1e2227"

# A lens is a volume with filters. What lies inside the volume goes through them, the first one first.
[[lens]]
name = "wires"
shape.sphere = {{ center = {ball}, radius = {radius} }}
filters = [{{ wireframe = {{ width = 1.2, fill = 0.08 }} }}]    # fill: how much of the surface stays between the wires

[[lens]]
name = "cut"
shape.box = {{ center = {slab}, size = {size} }}
# Where lenses overlap, the filters of the one below act first. `over` says which is above; without it the two
# would be undecided, and `lenspeel check` would name them.
over = ["wires"]
filters = [
    {{ tint = {{ color = "#ff9d3f", amount = 0.5 }} }},
{erase}
]
# Limits what the lens acts on: names of nodes or materials, with * and ?. `except` says what it spares.
# only = {{ nodes = ["Housing*"] }}
"##
    )
}

/// Numbers that fit the bounds of a model.
struct Frame {
    center: DVec3,
    eye: DVec3,
    ball: DVec3,
    ball_radius: f64,
    slab: DVec3,
    slab_size: DVec3,
    /// Decimals that make a thousandth of the model visible.
    decimals: i32,
}

impl Frame {
    fn of(bounds: &Aabb) -> Self {
        // Nothing to show: as if there were a cube of side 1 at the origin.
        let unit = Aabb { min: DVec3::splat(-0.5), max: DVec3::splat(0.5) };
        let bounds = if bounds.is_empty() { unit } else { *bounds };
        let center = bounds.center();
        let half_diagonal = bounds.size().length() * 0.5;
        // A model that is a point still gets a camera and lenses that f64 can tell from it.
        let is_point = half_diagonal <= 1e-9 * center.length();
        let radius = if is_point { (1e-3 * center.length()).max(0.5) } else { half_diagonal };
        // Flat or thin models still get lenses with a body.
        let half = (bounds.size() * 0.5).max(DVec3::splat(radius * 0.1));
        let distance = 1.05 * radius / (FOV_Y.to_radians() * 0.5).sin();
        // The sphere to the left of the middle, the box to the right; they share the middle.
        Self {
            center,
            eye: center + VIEW.normalize() * distance,
            ball: center - DVec3::new(half.x * 0.25, 0.0, 0.0),
            ball_radius: (half.x * 0.6).max(radius * 0.3),
            slab: center + DVec3::new(half.x * 0.5, 0.0, 0.0),
            slab_size: DVec3::new(half.x * 1.2, half.y * 2.2, half.z * 2.2),
            decimals: 3 - radius.log10().floor() as i32,
        }
    }

    fn round(&self, value: f64) -> String {
        if self.decimals > 15 {
            return format!("{value:.3e}");
        }
        if self.decimals > 0 {
            let text = format!("{value:.*}", self.decimals as usize);
            let text = text.trim_end_matches('0').trim_end_matches('.');
            return if matches!(text, "-0" | "") { "0".to_string() } else { text.to_string() };
        }
        let step = 10f64.powi(-self.decimals);
        // A decimal point keeps numbers beyond TOML's integers floats.
        format!("{:.1}", (value / step).round() * step)
    }

    fn vector(&self, v: DVec3) -> String {
        format!("[{}, {}, {}]", self.round(v.x), self.round(v.y), self.round(v.z))
    }
}

/// Names the scene when the file has several.
fn scene_line(model: &Model) -> String {
    if model.scenes.len() < 2 {
        return String::new();
    }
    let choice = match model.scenes.get(model.scene) {
        Some(Some(name)) => quoted(name),
        _ => model.scene.to_string(),
    };
    format!("scene = {choice}    # one of {}, by name or index\n", model.scenes.len())
}

/// Erases one named part where there is a part to spare, else shows how it would be done.
fn erase_line(model: &Model) -> String {
    let parts: Vec<usize> = (0..model.nodes.len()).filter(|n| is_part(model, *n)).collect();
    let biggest = parts.iter().copied().max_by(|a, b| extent(model, *a).total_cmp(&extent(model, *b)));
    match biggest {
        Some(node) if parts.len() > 1 => {
            let name = quoted(&model.nodes[node].name);
            format!("    {{ erase = {{ nodes = [{name}] }} }},    # the largest part, so that what it hides is seen")
        }
        _ => "    # { erase = { nodes = [\"Housing*\"] } },    # takes nodes away, so that what they hide is seen"
            .to_string(),
    }
}

/// A node that is seen, with triangles, whose name is a pattern for itself.
fn is_part(model: &Model, node: usize) -> bool {
    let name = &model.nodes[node].name;
    model.nodes[node].is_shown()
        && !name.is_empty()
        && !name.contains(['*', '?'])
        && !model.node_bounds(node).is_empty()
}

fn extent(model: &Model, node: usize) -> f64 {
    model.node_bounds(node).size().length()
}

/// A TOML basic string.
fn quoted(text: &str) -> String {
    let mut out = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if printable::is_unsafe(c) => out.push_str(&format!("\\u{:04X}", c as u32)),
            c => out.push(c),
        }
    }
    out.push('"');
    out
}

#[cfg(test)]
mod tests {
    use super::*;

    fn frame(min: f64, max: f64) -> Frame {
        Frame::of(&Aabb { min: DVec3::splat(min), max: DVec3::splat(max) })
    }

    #[test]
    fn the_lenses_overlap_and_keep_the_model_in_view() {
        for (min, max) in [(-0.5, 0.5), (1000.0, 1000.5), (-4e6, 5e6), (0.0, 1e-6), (2.0, 2.0)] {
            let frame = frame(min, max);
            assert!(frame.ball.x + frame.ball_radius > frame.slab.x - frame.slab_size.x * 0.5, "{min} {max}");
            assert!(frame.eye.distance(frame.center) > (max - min) * 0.9, "{min} {max}");
        }
    }

    #[test]
    fn numbers_are_round() {
        assert_eq!(frame(-0.5, 0.5).round(0.123456789), "0.1235");
        assert_eq!(frame(-500.0, 500.0).round(123.456), "123.5");
        assert_eq!(frame(-5e6, 5e6).round(1_234_567.0), "1235000.0");
        assert_eq!(frame(-0.5, 0.5).round(-0.0), "0");
    }

    #[test]
    fn strings_are_quoted_for_toml() {
        assert_eq!(quoted("a\\b\"c\n\u{202e}"), "\"a\\\\b\\\"c\\u000A\\u202E\"");
        let text = init_text(&Model::default(), "C:\\models\\a \"b\".glb");
        let table: toml::Table = text.parse().expect("valid TOML");
        assert_eq!(table["scene"]["file"].as_str(), Some("C:\\models\\a \"b\".glb"));
        assert_eq!(table["lens"].as_array().map(Vec::len), Some(2));
    }
}
