//! Screen-space filters: the work of `shaders/gpu/screen.wgsl` on planes of samples.

use glam::Vec4;
use rayon::prelude::*;

use super::convert::{d3, g3, g4, v3, v4};
use super::shade::soft_amount;
use crate::appearance as wgsl;
use crate::lens::{LensSet, PixelRect};
use crate::pixel::{Visible, cap_maker};
use crate::plan::{Plan, Region, ScreenStep};
use crate::view::Projection;

/// What one sample of each pixel of a rectangle sees.
pub struct Plane {
    rect: PixelRect,
    /// Where the sample lies in its pixel.
    at: [f64; 2],
    /// Premultiplied linear colours, row by row.
    colors: Vec<Vec4>,
    seen: Vec<Point>,
}

/// What is visible at a sample.
#[derive(Clone, Copy)]
struct Point {
    seen: wgsl::Seen,
    /// Into [`Plan::instances`].
    instance: u32,
    is_cap: bool,
    /// The lenses around it, and those that act.
    set: LensSet,
    stack: LensSet,
}

impl Plane {
    /// The plane of a sample, of `side` times `side` a pixel, that sees nothing yet.
    pub fn new(rect: PixelRect, sample: u32, side: u32) -> Self {
        let along = |number: u32| (f64::from(number) + 0.5) / f64::from(side);
        let zero = v3(glam::Vec3::ZERO);
        let seen = wgsl::Seen { found: 0, depth: 0.0, position: zero, normal: zero, span: 0.0 };
        let nothing = Point { seen, instance: 0, is_cap: false, set: LensSet::EMPTY, stack: LensSet::EMPTY };
        let count = rect.area() as usize;
        let at = [along(sample % side), along(sample / side)];
        Self { rect, at, colors: vec![Vec4::ZERO; count], seen: vec![nothing; count] }
    }

    /// Says what a pixel's sample sees.
    pub fn put(&mut self, plan: &Plan, [x, y]: [u32; 2], color: Vec4, visible: &Option<Visible>) {
        let at = self.place(x, y);
        self.colors[at] = color;
        let Some(Visible { fragment, normal }) = visible else { return };
        let (view, depth) = (&plan.view, f64::from(fragment.depth));
        let ray = view.ray(f64::from(x) + self.at[0], f64::from(y) + self.at[1]);
        let span = match view.projection {
            Projection::Perspective { tan_half_y } => 2.0 * tan_half_y * depth,
            Projection::Orthographic { half_height } => 2.0 * half_height,
        };
        let position = d3(ray.at(depth) - view.eye);
        let seen = wgsl::Seen { found: 1, depth: fragment.depth, position, normal: v3(*normal), span: span as f32 };
        let Region { set, stack } = fragment.region;
        let is_cap = cap_maker(fragment.triangle).is_some();
        self.seen[at] = Point { seen, instance: fragment.instance, is_cap, set, stack };
    }

    fn width(&self) -> usize {
        (self.rect.max[0] - self.rect.min[0]) as usize
    }

    fn place(&self, x: u32, y: u32) -> usize {
        (y - self.rect.min[1]) as usize * self.width() + (x - self.rect.min[0]) as usize
    }

    /// Column and row of a place.
    fn pixel(&self, place: usize) -> [u32; 2] {
        let [column, row] = [place % self.width(), place / self.width()].map(|i| i as u32);
        [self.rect.min[0] + column, self.rect.min[1] + row]
    }

    fn acts(&self, place: usize, rank: usize) -> bool {
        self.seen[place].stack.contains(rank)
    }

    /// The places up to `reach` pixels from one along a row (axis 0) or a column (axis 1), each with its number on that axis.
    fn along(&self, place: usize, axis: usize, reach: u32) -> impl Iterator<Item = (u32, usize)> + use<> {
        let mut at = self.pixel(place);
        let (rect, width) = (self.rect, self.width());
        let from = at[axis].saturating_sub(reach).max(rect.min[axis]);
        let to = at[axis].saturating_add(reach).min(rect.max[axis] - 1);
        (from..=to).map(move |number| {
            at[axis] = number;
            (number, (at[1] - rect.min[1]) as usize * width + (at[0] - rect.min[0]) as usize)
        })
    }

    fn run(&mut self, plan: &Plan, step: ScreenStep) {
        let op = &plan.ops[step.op];
        if op.kind == wgsl::OP_EDGES.0 {
            self.draw_edges(plan, op.shader(), step.rank);
        } else {
            self.take_means(plan, op.shader(), op.screen_reach(), step.rank);
        }
    }

    /// Colours all pixels on which a filter acts, which fades in where its lens is soft.
    fn put_all(&mut self, plan: &Plan, rank: usize, filtered: impl Fn(&Self, usize) -> Vec4 + Sync) {
        let color = |place: usize| {
            if !self.acts(place, rank) {
                return self.colors[place];
            }
            let Point { seen, instance, .. } = &self.seen[place];
            let amount = soft_amount(plan, rank, &plan.instances[*instance as usize], g3(seen.position));
            self.colors[place].lerp(filtered(self, place), amount)
        };
        self.colors = (0..self.colors.len()).into_par_iter().map(color).collect();
    }

    /// Each pixel of the lens as the weighted mean of those around it: sums along rows, then of these along columns.
    fn take_means(&mut self, plan: &Plan, op: wgsl::Op, reach: u32, rank: usize) {
        let places = 0..self.colors.len();
        let weight = |at: u32, other: u32| wgsl::mean_weight(op, at as f32, other as f32);
        let row = |place: usize| {
            let own = self.pixel(place)[0];
            let others = self.along(place, 0, reach).filter(|(_, other)| self.acts(*other, rank));
            others.fold((Vec4::ZERO, 0.0), |(sum, all), (number, other)| {
                let weight = weight(own, number);
                (sum + self.colors[other] * weight, all + weight)
            })
        };
        let rows: Vec<(Vec4, f32)> = places.into_par_iter().map(row).collect();
        self.put_all(plan, rank, |plane, place| {
            let own = plane.pixel(place)[1];
            let (sum, all) = plane.along(place, 1, reach).fold((Vec4::ZERO, 0.0), |(sum, all), (number, other)| {
                let weight = weight(own, number);
                (sum + rows[other].0 * weight, all + rows[other].1 * weight)
            });
            sum / all
        });
    }

    fn draw_edges(&mut self, plan: &Plan, op: wgsl::Op, rank: usize) {
        let places = 0..self.colors.len();
        let marks: Vec<bool> = places.into_par_iter().map(|place| self.has_mark(plan, op, rank, place)).collect();
        let reach = wgsl::edges_reach(op) as u32;
        self.put_all(plan, rank, |plane, place| {
            let [x, y] = plane.pixel(place);
            let mut covered: f32 = 0.0;
            for (row, of_row) in plane.along(place, 1, reach) {
                for (column, _) in plane.along(of_row, 0, reach).filter(|(_, other)| marks[*other]) {
                    let [dx, dy] = [column as f32 - x as f32, row as f32 - y as f32];
                    covered = covered.max(wgsl::line_coverage((dx * dx + dy * dy).sqrt(), op.b.x));
                }
            }
            g4(wgsl::edges_drawn(op, v4(plane.colors[place]), covered))
        });
    }

    /// Whether a line lies on a pixel.
    fn has_mark(&self, plan: &Plan, op: wgsl::Op, rank: usize, place: usize) -> bool {
        let p = &self.seen[place];
        if !self.acts(place, rank) {
            return false;
        }
        let [x, y] = self.pixel(place);
        let mark = |comes_after: bool, other: usize| {
            let q = &self.seen[other];
            let border = match () {
                () if !self.acts(other, rank) => wgsl::BORDER_OF_FILTER,
                () if q.set != p.set || is_other_section(plan, p, q) => wgsl::BORDER_OF_REGION,
                () => wgsl::BORDER_NONE,
            };
            wgsl::edges_mark(op, p.seen, q.seen, border.0, comes_after)
        };
        let row = self.along(place, 0, 1).filter(|(number, _)| *number != x).map(|(number, other)| (number > x, other));
        let column =
            self.along(place, 1, 1).filter(|(number, _)| *number != y).map(|(number, other)| (number > y, other));
        row.chain(column).any(|(comes_after, other)| mark(comes_after, other))
    }
}

/// Whether caps of different nodes are seen: sections of parts that may lie in one plane.
fn is_other_section(plan: &Plan, p: &Point, q: &Point) -> bool {
    let item = |point: &Point| &plan.items[plan.instances[point.instance as usize].item];
    p.is_cap && q.is_cap && (item(p).node, item(p).is_alternate()) != (item(q).node, item(q).is_alternate())
}

/// The sums of all samples' filtered colours for the pixels of a part of the planes' rectangle, row by row.
pub fn filtered(plan: &Plan, mut planes: Vec<Plane>, part: &PixelRect) -> Vec<Vec4> {
    for step in &plan.screen {
        planes.iter_mut().for_each(|plane| plane.run(plan, *step));
    }
    let rows = part.min[1]..part.max[1];
    let pixels = rows.flat_map(|y| (part.min[0]..part.max[0]).map(move |x| (x, y)));
    pixels.map(|(x, y)| planes.iter().map(|plane| plane.colors[plane.place(x, y)]).sum()).collect()
}
