//! A section through the view along one row: the layers of its rays and what is seen.

use std::collections::BTreeSet;

use super::canvas::{Canvas, LETTER, LINE, width};
use super::legend::{Entry, Legend, region_lines};
use super::palette::{DIM_TEXT, GROUND, RegionColors, TEXT, mix};
use super::sheet::{MARGIN, zoom};
use crate::drawing::{Rgb, round_step};
use crate::frame::{Aovs, Frame};
use crate::lens::LayerStart;
use crate::plan::{Plan, Region};

/// Inside the plot, where no lens is.
const EMPTY: Rgb = [36, 39, 45];
const SURFACE: Rgb = [255, 255, 255];
/// Pixels between the lines of the depth axis, about.
const TICKS: f64 = 56.0;
/// Pixels of the strip that shows the row of the picture.
const STRIP: i32 = 20;
const AXIS: i32 = 9 * LETTER[0];

/// A row of a picture with the layers of the rays through its pixel centres, from left to right.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    pub y: u32,
    pub layers: Vec<Vec<LayerStart>>,
}

/// Where the plot is, and which depths it shows.
struct Plot {
    min: [i32; 2],
    size: [i32; 2],
    zoom: i32,
    depths: [f64; 2],
}

impl Plot {
    /// The row of the sheet for a depth; the nearest is lowest.
    fn y(&self, depth: f64) -> i32 {
        let [low, high] = self.depths;
        let t = ((depth - low) / (high - low)).clamp(0.0, 1.0);
        self.min[1] + ((1.0 - t) * f64::from(self.size[1] - 1)).round() as i32
    }

    fn x(&self, column: usize) -> i32 {
        self.min[0] + column as i32 * self.zoom
    }
}

pub fn draw(plan: &Plan, picture: &Frame, aovs: &Aovs, row: &Row) -> Frame {
    let columns = picture.size[0] as usize;
    let region = |start: &LayerStart| Region { set: start.set, stack: plan.stack_of(start.set) };
    let met: BTreeSet<Region> = row.layers.iter().flatten().map(region).filter(|r| !r.set.is_empty()).collect();
    let colors = RegionColors::new(plan, aovs, met.iter().copied());
    let mut entries = vec![Entry { color: SURFACE, lines: vec!["the visible surface".into()] }];
    let mut listed: Vec<&Region> = met.iter().collect();
    listed.sort_by_key(|region| (colors.id(region).is_none(), colors.id(region)));
    entries.extend(
        listed.into_iter().map(|region| Entry {
            color: colors.color(region),
            lines: region_lines(plan, colors.id(region), region, ""),
        }),
    );
    let title = format!("Depth along row {}", row.y);
    let notes = [
        "The eye looks up from below. The strip is",
        "the row of the picture; the small picture",
        "shows where it lies.",
    ];
    let legend = Legend::new(&title, &notes, entries);

    let zoom = zoom([columns as u32, 1]);
    let plot_width = columns as i32 * zoom;
    let plot = Plot {
        min: [MARGIN + AXIS, MARGIN + LINE],
        size: [plot_width, (plot_width * 9 / 16).clamp(320, 900)],
        zoom,
        depths: depths(plan, columns, aovs, row),
    };
    let legend_at = [plot.min[0] + plot_width + 2 * MARGIN, MARGIN];
    let [legend_width, legend_height] = legend.size();
    let thumbnail = Thumbnail::new(picture, legend_width);
    let height =
        (plot.min[1] + plot.size[1] + STRIP + 2 * LINE).max(legend_at[1] + legend_height + MARGIN + thumbnail.size[1]);
    let mut canvas = Canvas::new([legend_at[0] + legend_width + MARGIN, height + MARGIN], GROUND);
    let from_eye = |depth: f64| plan.view.from_eye(depth);
    for (column, layers) in row.layers.iter().enumerate() {
        for (i, start) in layers.iter().enumerate() {
            let [start_depth, end] =
                [start.depth, layers.get(i + 1).map_or(plan.view.far, |next| next.depth)].map(from_eye);
            let color = if start.set.is_empty() { EMPTY } else { mix(EMPTY, colors.color(&region(start)), 0.85) };
            let (top, bottom) = (plot.y(end), plot.y(start_depth));
            canvas.fill([plot.x(column), top], [zoom, bottom - top + 1], color);
        }
    }
    draw_axis(&mut canvas, &plot);
    draw_surface(&mut canvas, &plot, aovs, columns, row.y);
    draw_strip(&mut canvas, &plot, picture, row.y);
    legend.draw(&mut canvas, legend_at);
    thumbnail.draw(&mut canvas, picture, [legend_at[0], legend_at[1] + legend_height + MARGIN], row.y);
    canvas.into_frame()
}

/// The depths from the eye between which something is to be seen, with a little more on both sides.
fn depths(plan: &Plan, columns: usize, aovs: &Aovs, row: &Row) -> [f64; 2] {
    let from_eye = |depth: f64| plan.view.from_eye(depth);
    let boundaries = row.layers.iter().flat_map(|layers| layers.iter().skip(1)).map(|start| from_eye(start.depth));
    let seen = &aovs.depth[row.y as usize * columns..][..columns];
    let seen = seen.iter().copied().filter(|depth| depth.is_finite());
    let (low, high) = boundaries
        .chain(seen)
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), depth| (low.min(depth), high.max(depth)));
    if low >= high {
        return [plan.view.near, plan.view.far].map(from_eye);
    }
    let more = 0.06 * (high - low);
    [(low - more).max(from_eye(plan.view.near)), (high + more).min(from_eye(plan.view.far))]
}

fn draw_axis(canvas: &mut Canvas, plot: &Plot) {
    let [low, high] = plot.depths;
    canvas.text("depth", [MARGIN, MARGIN - 4], DIM_TEXT);
    let step = round_step((high - low) * TICKS / f64::from(plot.size[1]));
    let decimals = (-step.log10().floor()).max(0.0) as usize;
    for number in (low / step).ceil() as i64..=(high / step).floor() as i64 {
        let depth = number as f64 * step;
        let y = plot.y(depth);
        for x in (plot.min[0] - 6..plot.min[0]).chain((plot.min[0]..plot.min[0] + plot.size[0]).step_by(6)) {
            canvas.set([x, y], DIM_TEXT);
        }
        let text = format!("{depth:.decimals$}");
        canvas.text(&text, [plot.min[0] - 10 - width(&text), y - LETTER[1] / 2], TEXT);
    }
}

/// A dash a column, joined to the one before where both are of one surface.
fn draw_surface(canvas: &mut Canvas, plot: &Plot, aovs: &Aovs, columns: usize, row: u32) {
    let first = row as usize * columns;
    let depth = |column: usize| aovs.depth[first + column];
    for column in (0..columns).filter(|column| depth(*column).is_finite()) {
        let y = plot.y(depth(column));
        canvas.fill([plot.x(column), y - 1], [plot.zoom, 3], SURFACE);
        let before = column.checked_sub(1).filter(|before| {
            let of = |column: usize| (aovs.instances[first + column], aovs.regions[first + column]);
            of(*before) == of(column)
        });
        if let Some(before) = before {
            let other = plot.y(depth(before));
            canvas.fill([plot.x(column), y.min(other)], [2, (y - other).abs()], SURFACE);
        }
    }
}

fn draw_strip(canvas: &mut Canvas, plot: &Plot, picture: &Frame, row: u32) {
    let columns = picture.size[0] as usize;
    let top = plot.min[1] + plot.size[1] + 8;
    for column in 0..columns {
        let [r, g, b, a] = picture.pixels[row as usize * columns + column];
        let color = mix(GROUND, [r, g, b], f32::from(a) / 255.0);
        canvas.fill([plot.x(column), top], [plot.zoom, STRIP], color);
    }
    let text = format!("columns 0 to {}", columns - 1);
    canvas.text(&text, [plot.min[0], top + STRIP + 6], DIM_TEXT);
}

/// The whole picture, small, with the row marked.
struct Thumbnail {
    size: [i32; 2],
}

impl Thumbnail {
    fn new(picture: &Frame, width: i32) -> Self {
        let [w, h] = picture.size.map(f64::from);
        let width = width.clamp(1, 320);
        let height = (f64::from(width) * h / w).round().clamp(1.0, 320.0) as i32;
        Self { size: [width, height] }
    }

    fn draw(&self, canvas: &mut Canvas, picture: &Frame, at: [i32; 2], row: u32) {
        let [width, height] = self.size;
        let source = |place: i32, side: i32, count: u32| (place as u32 * count / side as u32) as usize;
        for (x, y) in (0..height).flat_map(|y| (0..width).map(move |x| (x, y))) {
            let [column, line] = [source(x, width, picture.size[0]), source(y, height, picture.size[1])];
            let [r, g, b, a] = picture.pixels[line * picture.size[0] as usize + column];
            canvas.set([at[0] + x, at[1] + y], mix(GROUND, [r, g, b], f32::from(a) / 255.0));
        }
        let y = (f64::from(row) + 0.5) / f64::from(picture.size[1]) * f64::from(height);
        canvas.fill([at[0] - 4, at[1] + y as i32], [width + 8, 1], SURFACE);
    }
}
