//! One quantity of the legend: its name, its colours or lines, its values.

use super::axis::{self, Unit, ticks};
use super::overlay::{Overlay, Type};
use crate::color_map;
use crate::drawing::Rgb;
use crate::plan::{LegendEntry, LegendLook, Plan};
use crate::spec::Quantity;

const GROUND: Rgb = [18, 20, 24];
/// How much of the picture the ground covers.
const COVER: f32 = 0.78;
const TEXT: Rgb = [236, 238, 241];
const DIM_TEXT: Rgb = [172, 178, 187];
/// Letters that a colour bar is long.
const BAR: i32 = 26;
/// Longer titles are cut.
const MOST_LETTERS: usize = 40;

pub struct Block {
    title: String,
    look: Look,
}

enum Look {
    /// Colours from left to right, and the values at the ends.
    Bar { colors: Vec<Rgb>, ends: [f64; 2], unit: Unit },
    /// A colour and words beside it.
    Lines { color: Rgb, text: String },
    /// Colours with a letter each.
    Swatches([(Rgb, &'static str); 3]),
}

/// Those of a plan, each once, however many lenses show it.
pub fn blocks(plan: &Plan) -> Vec<Block> {
    let mut merged: Vec<(&LegendEntry, Vec<&str>)> = Vec::new();
    for entry in &plan.legend {
        let name = plan.actor_of_op(entry.op);
        match merged.iter_mut().find(|(known, _)| known.quantity == entry.quantity && known.look == entry.look) {
            Some((_, names)) if names.contains(&name) => {}
            Some((_, names)) => names.push(name),
            None => merged.push((entry, vec![name])),
        }
    }
    let is_alone = |entry: &LegendEntry| {
        let same = |(other, _): &&(&LegendEntry, Vec<&str>)| title(other) == title(entry);
        merged.iter().filter(same).count() == 1
    };
    merged.iter().map(|(entry, names)| Block::new(entry, names, is_alone(entry))).collect()
}

fn title(entry: &LegendEntry) -> String {
    let quantity = match &entry.quantity {
        Quantity::Slope => "slope",
        Quantity::Depth => "depth",
        Quantity::Height => "height",
        Quantity::Curvature => "curvature",
        Quantity::Attribute(name) => &name.value,
    };
    match entry.look {
        LegendLook::Colors { .. } => quantity.to_owned(),
        LegendLook::Lines { .. } => format!("contours of {quantity}"),
        LegendLook::Axes => "normals".to_owned(),
    }
}

fn unit(quantity: &Quantity) -> &'static str {
    match quantity {
        Quantity::Depth | Quantity::Height => "scene units",
        Quantity::Curvature => "1/scene unit",
        Quantity::Slope | Quantity::Attribute(_) => "",
    }
}

impl Block {
    fn new(entry: &LegendEntry, names: &[&str], is_alone: bool) -> Self {
        let unit = unit(&entry.quantity);
        let mut title = title(entry);
        let look = match &entry.look {
            LegendLook::Colors { colormap, range } => {
                if !unit.is_empty() {
                    title += &format!(" ({unit})");
                }
                bar(colormap, *range, entry.quantity == Quantity::Slope)
            }
            LegendLook::Lines { spacing, color } => {
                let [r, g, b, _] = color.0;
                let text = format!("every {} {unit}", axis::exact(*spacing));
                Look::Lines { color: [r, g, b], text: text.trim_end().to_owned() }
            }
            LegendLook::Axes => {
                Look::Swatches([([255, 128, 128], "x"), ([128, 255, 128], "y"), ([128, 128, 255], "z")])
            }
        };
        if !is_alone {
            title += &format!(", {}", names.join(", "));
        }
        if let Some((at, _)) = title.char_indices().nth(MOST_LETTERS) {
            title.truncate(at);
            title += "..";
        }
        Self { title, look }
    }

    pub fn size(&self, letters: Type) -> [i32; 2] {
        let [w, h] = letters.letter;
        let pad = pad(letters);
        let (width, height) = match &self.look {
            Look::Bar { .. } => (BAR * w, 2 * h + 5),
            Look::Lines { text, .. } => (4 * w + letters.width(text), h),
            Look::Swatches(_) => (3 * 5 * w, h),
        };
        [width.max(letters.width(&self.title)) + 2 * pad, h + pad / 2 + height + 2 * pad]
    }

    pub fn draw(&self, overlay: &mut Overlay, [x, y]: [i32; 2]) {
        let letters = overlay.letters;
        let [w, h] = letters.letter;
        let pad = pad(letters);
        overlay.fill([x, y], self.size(letters), GROUND, COVER);
        let (x, y) = (x + pad, y + pad);
        overlay.text(&self.title, [x, y], TEXT);
        let y = y + h + pad / 2;
        match &self.look {
            Look::Bar { colors, ends, unit } => draw_bar(overlay, [x, y], colors, *ends, *unit),
            Look::Lines { color, text } => {
                // Lines lie on what they measure, which is seldom as dark as the ground.
                overlay.fill([x, y], [3 * w, h], DIM_TEXT, 1.0);
                overlay.fill([x, y + h / 2 - 1], [3 * w, 2], *color, 1.0);
                overlay.text(text, [x + 4 * w, y], DIM_TEXT);
            }
            Look::Swatches(swatches) => {
                for (i, (color, text)) in (0..).zip(swatches) {
                    let x = x + i * 5 * w;
                    overlay.fill([x, y], [2 * w, h], *color, 1.0);
                    overlay.text(text, [x + 2 * w + w / 2, y], DIM_TEXT);
                }
            }
        }
    }
}

fn pad(letters: Type) -> i32 {
    letters.letter[1] * 2 / 3
}

/// Values rise from left to right, whichever way the range runs. Slopes are told as angles from level ground, along
/// which the colours are not even.
fn bar(colormap: &str, [first, last]: [f64; 2], is_slope: bool) -> Look {
    let map = color_map::colors(colormap).unwrap_or_default();
    let angle = |value: f64| value.clamp(-1.0, 1.0).acos().to_degrees();
    let value = |along: f64| if is_slope { along.to_radians().cos() } else { along };
    let (a, b) = if is_slope { (angle(first), angle(last)) } else { (first, last) };
    let (ends, unit) = ([a.min(b), a.max(b)], if is_slope { Unit::Degrees } else { Unit::Plain });
    let color = |i: u32| {
        let along = ends[0] + (ends[1] - ends[0]) * f64::from(i) / f64::from(color_map::STEPS - 1);
        let t = if last == first { 0.0 } else { (value(along) - first) / (last - first) };
        let step = (t.clamp(0.0, 1.0) * f64::from(color_map::STEPS - 1)).round() as usize;
        map.get(step).map_or([0; 3], |[r, g, b, _]| [*r, *g, *b])
    };
    Look::Bar { colors: (0..color_map::STEPS).map(color).collect(), ends, unit }
}

fn draw_bar(overlay: &mut Overlay, [x, y]: [i32; 2], colors: &[Rgb], ends: [f64; 2], unit: Unit) {
    let letters = overlay.letters;
    let [w, h] = letters.letter;
    let width = BAR * w;
    for column in 0..width {
        let along = f64::from(column) / f64::from(width - 1);
        let color = colors[(along * (colors.len() - 1) as f64).round() as usize];
        overlay.fill([x + column, y], [1, h], color, 1.0);
    }
    for tick in ticks(ends, unit, BAR as usize) {
        let at = x + (tick.at * f64::from(width - 1)).round() as i32;
        overlay.fill([at, y + h], [1, 3], DIM_TEXT, 1.0);
        let wide = letters.width(&tick.text);
        let left = (at - wide / 2).clamp(x, x + width - wide);
        overlay.text(&tick.text, [left, y + h + 5], DIM_TEXT);
    }
}
