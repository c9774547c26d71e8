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
    /// Of a cap that has a line around it the filter that draws it: into [`Plan::ops`].
    outline: Option<usize>,
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
        let nothing =
            Point { seen, instance: 0, is_cap: false, outline: None, set: LensSet::EMPTY, stack: LensSet::EMPTY };
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
            Projection::Perspective { tan_half_y } => 2.0 * tan_half_y * view.from_eye(depth),
            Projection::Orthographic { half_height } => 2.0 * half_height,
        };
        let position = d3(ray.at(depth) - view.origin());
        let seen = wgsl::Seen { found: 1, depth: fragment.depth, position, normal: v3(*normal), span: span as f32 };
        let Region { set, stack } = fragment.region;
        let maker = cap_maker(fragment.triangle);
        let item = &plan.items[plan.instances[fragment.instance as usize].item];
        let outline = maker.and_then(|maker| plan.outline(item.cap(maker)?));
        self.seen[at] = Point { seen, instance: fragment.instance, is_cap: maker.is_some(), outline, set, stack };
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

    fn acts(&self, plan: &Plan, place: usize, step: ScreenStep) -> bool {
        let point = &self.seen[place];
        if plan.ops[step.op].kind == wgsl::OP_ERASE.0 {
            return point.outline == Some(step.op);
        }
        point.stack.contains(step.rank)
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
        if op.draws_lines() {
            self.draw_lines(plan, op.shader(), step);
        } else {
            self.take_means(plan, op.shader(), op.screen_reach(), step);
        }
    }

    /// Colours all pixels on which a filter acts, which fades in where its lens is soft; caps are there or not.
    fn put_all(&mut self, plan: &Plan, step: ScreenStep, filtered: impl Fn(&Self, usize) -> Vec4 + Sync) {
        let fades = plan.ops[step.op].kind != wgsl::OP_ERASE.0;
        let color = |place: usize| {
            if !self.acts(plan, place, step) {
                return self.colors[place];
            }
            if !fades {
                return filtered(self, place);
            }
            let Point { seen, instance, .. } = &self.seen[place];
            let amount = soft_amount(plan, step.rank, &plan.instances[*instance as usize], g3(seen.position));
            self.colors[place].lerp(filtered(self, place), amount)
        };
        self.colors = (0..self.colors.len()).into_par_iter().map(color).collect();
    }

    /// Each pixel of the lens as the weighted mean of those around it: sums along rows, then of these along columns.
    fn take_means(&mut self, plan: &Plan, op: wgsl::Op, reach: u32, step: ScreenStep) {
        let width = self.width();
        // What takes no part weighs nothing.
        let weighed = |place: usize| {
            let takes_part = self.acts(plan, place, step);
            if takes_part { (self.colors[place], 1.0) } else { (Vec4::ZERO, 0.0) }
        };
        let all: Vec<Weighed> = (0..self.colors.len()).into_par_iter().map(weighed).collect();
        let sums = if op.kind == wgsl::OP_PIXELATE.0 {
            let side = wgsl::mean_side(op) as usize;
            let [left, top] = self.rect.min.map(|first| first as usize % side);
            cell_sums(&all, width, side, left, top)
        } else {
            bell_sums(&all, width, reach as usize, f64::from(wgsl::blur_turn(op)))
        };
        self.put_all(plan, step, |_, place| sums[place].0 / sums[place].1);
    }

    fn draw_lines(&mut self, plan: &Plan, op: wgsl::Op, step: ScreenStep) {
        let places = 0..self.colors.len();
        let marks: Vec<u32> = places.into_par_iter().map(|place| self.mark(plan, op, step, place)).collect();
        let reach = wgsl::line_reach(op) as u32;
        let [shared, alone] = [wgsl::MARK_SHARED.0, wgsl::MARK_ALONE.0].map(|kind| {
            let is_there: Vec<bool> = marks.iter().map(|mark| *mark == kind).collect();
            squared_distances(&is_there, self.width(), reach)
        });
        self.put_all(plan, step, |plane, place| {
            let away = |squared: u32| if squared == FAR { NO_LINE } else { (squared as f32).sqrt() };
            g4(wgsl::under_lines(op, v4(plane.colors[place]), away(shared[place]), away(alone[place])))
        });
    }

    /// How a line lies on a pixel: a `MARK_...` constant.
    fn mark(&self, plan: &Plan, op: wgsl::Op, step: ScreenStep, place: usize) -> u32 {
        let p = &self.seen[place];
        if !self.acts(plan, place, step) {
            return wgsl::MARK_NONE.0;
        }
        let regions_count = op.kind == wgsl::OP_EDGES.0;
        let [x, y] = self.pixel(place);
        let mark = |comes_after: bool, other: usize| {
            let q = &self.seen[other];
            let border = match () {
                () if !self.acts(plan, other, step) => wgsl::BORDER_OF_FILTER,
                () if (regions_count && q.set != p.set) || is_other_section(plan, p, q) => wgsl::BORDER_OF_REGION,
                () => wgsl::BORDER_NONE,
            };
            wgsl::line_mark(op, p.seen, q.seen, border.0, comes_after)
        };
        let row = self.along(place, 0, 1).filter(|(number, _)| *number != x).map(|(number, other)| (number > x, other));
        let column =
            self.along(place, 1, 1).filter(|(number, _)| *number != y).map(|(number, other)| (number > y, other));
        let marks = row.chain(column).map(|(comes_after, other)| mark(comes_after, other));
        marks.max().unwrap_or(wgsl::MARK_NONE.0)
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

/// A colour, or a sum of colours, and the sum of their weights.
type Weighed = (Vec4, f32);

/// Adds a share of the second to the first.
fn add(to: &mut Weighed, from: &Weighed, weight: f32) {
    to.0 += from.0 * weight;
    to.1 += from.1 * weight;
}

/// For each place the sum of all up to `reach` rows and columns away, weighted as `blur_weight` has it: half a constant and
/// half a cosine that turns by `turn` from place to place, whose sums move on with the place: it takes as long for any reach.
fn bell_sums(all: &[Weighed], width: usize, reach: usize, turn: f64) -> Vec<Weighed> {
    let height = all.len() / width;
    let mut rows = vec![(Vec4::ZERO, 0.0); all.len()];
    rows.par_chunks_mut(width).zip(all.par_chunks(width)).for_each(|(sums, row)| {
        let mut window = Bell::new(reach, turn);
        (0..reach).for_each(|at| window.move_on(None, row.get(at)));
        for (at, sum) in sums.iter_mut().enumerate() {
            window.move_on(at.checked_sub(reach + 1).map(|left| &row[left]), row.get(at + reach));
            *sum = window.sum();
        }
    });
    // Stripes of columns side by side: what is read at once lies in a line of memory.
    const STRIPE: usize = 16;
    let stripes: Vec<Vec<Weighed>> = (0..width)
        .step_by(STRIPE)
        .collect::<Vec<_>>()
        .into_par_iter()
        .map(|first| {
            let columns = first..(first + STRIPE).min(width);
            let place = |y: usize, x: usize| &rows[y * width + x];
            let mut windows = vec![Bell::new(reach, turn); columns.len()];
            for y in 0..reach {
                let enters = |x: usize| (y < height).then(|| place(y, x));
                windows.iter_mut().zip(columns.clone()).for_each(|(window, x)| window.move_on(None, enters(x)));
            }
            let mut sums = Vec::with_capacity(columns.len() * height);
            for y in 0..height {
                for (window, x) in windows.iter_mut().zip(columns.clone()) {
                    let left = y.checked_sub(reach + 1).map(|left| place(left, x));
                    window.move_on(left, (y + reach < height).then(|| place(y + reach, x)));
                    sums.push(window.sum());
                }
            }
            sums
        })
        .collect();
    let mut sums = rows;
    for (number, stripe) in stripes.iter().enumerate() {
        let columns = STRIPE.min(width - number * STRIPE);
        for (y, row) in stripe.chunks(columns).enumerate() {
            sums[y * width + number * STRIPE..][..columns].copy_from_slice(row);
        }
    }
    sums
}

/// Sums over a window that moves along a line: of a constant, and of a cosine and a sine around its middle.
#[derive(Clone)]
struct Bell {
    plain: Sum,
    cosine: Sum,
    sine: Sum,
    /// The cosine and sine of one step, and of as many as the window reaches.
    one: [f64; 2],
    last: [f64; 2],
}

/// A colour and its weight.
type Sum = [f64; 5];

impl Bell {
    fn new(reach: usize, turn: f64) -> Self {
        let at = |steps: usize| [(turn * steps as f64).cos(), (turn * steps as f64).sin()];
        Self { plain: [0.0; 5], cosine: [0.0; 5], sine: [0.0; 5], one: at(1), last: at(reach) }
    }

    /// By one place: what leaves it, and what enters it.
    fn move_on(&mut self, left: Option<&Weighed>, entered: Option<&Weighed>) {
        let numbers = |place: Option<&Weighed>| {
            let (color, weight) = place.copied().unwrap_or((Vec4::ZERO, 0.0));
            [color.x, color.y, color.z, color.w, weight].map(f64::from)
        };
        let (left, entered) = (numbers(left), numbers(entered));
        let ([one_cos, one_sin], [last_cos, last_sin]) = (self.one, self.last);
        for i in 0..5 {
            self.plain[i] += entered[i] - left[i];
            let (cosine, sine) = (self.cosine[i] - left[i] * last_cos, self.sine[i] + left[i] * last_sin);
            self.cosine[i] = cosine * one_cos + sine * one_sin + entered[i] * last_cos;
            self.sine[i] = sine * one_cos - cosine * one_sin + entered[i] * last_sin;
        }
    }

    fn sum(&self) -> Weighed {
        let [x, y, z, w, weight] = std::array::from_fn(|i| 0.5 * (self.plain[i] + self.cosine[i]) as f32);
        (Vec4::new(x, y, z, w), weight)
    }
}

/// For each place the sum of its square of `side` rows and columns; the first square begins `left` columns and `top` rows
/// before the first place.
fn cell_sums(all: &[Weighed], width: usize, side: usize, left: usize, top: usize) -> Vec<Weighed> {
    let mut rows = vec![(Vec4::ZERO, 0.0); all.len()];
    rows.par_chunks_mut(width).zip(all.par_chunks(width)).for_each(|(sums, row)| {
        for first in (0..width + left).step_by(side) {
            let cell = first.saturating_sub(left)..(first + side - left.min(first + side)).min(width);
            let mut sum = (Vec4::ZERO, 0.0);
            row[cell.clone()].iter().for_each(|own| add(&mut sum, own, 1.0));
            sums[cell].fill(sum);
        }
    });
    // Squares side by side have the same rows.
    let height = all.len() / width;
    let mut sums = vec![(Vec4::ZERO, 0.0); all.len()];
    for first in (0..height + top).step_by(side) {
        let cells = first.saturating_sub(top)..(first + side - top.min(first + side)).min(height);
        let mut of_cells = vec![(Vec4::ZERO, 0.0); width];
        for y in cells.clone() {
            of_cells.iter_mut().zip(&rows[y * width..]).for_each(|(sum, row)| add(sum, row, 1.0));
        }
        cells.for_each(|y| sums[y * width..][..width].copy_from_slice(&of_cells));
    }
    sums
}

/// No mark is within reach.
const FAR: u32 = u32::MAX;
/// The same in pixels.
const NO_LINE: f32 = 1e6;

/// For each place the square of the distance to the nearest mark no more than `reach` rows and columns away, or [`FAR`]:
/// along rows first, then along columns.
fn squared_distances(marks: &[bool], width: usize, reach: u32) -> Vec<u32> {
    let mut rows = vec![FAR; marks.len()];
    rows.par_chunks_mut(width).zip(marks.par_chunks(width)).for_each(|(squares, marks)| {
        let mut scan = |places: &mut dyn Iterator<Item = usize>| {
            let mut away = FAR;
            for place in places {
                away = if marks[place] { 0 } else { away.saturating_add(1) };
                if away <= reach {
                    squares[place] = squares[place].min(away * away);
                }
            }
        };
        scan(&mut (0..width));
        scan(&mut (0..width).rev());
    });
    let (height, reach) = (marks.len() / width, reach as usize);
    let mut squares = vec![FAR; marks.len()];
    squares.par_chunks_mut(width).enumerate().for_each(|(y, squares)| {
        for other in y.saturating_sub(reach)..(y + reach + 1).min(height) {
            let down = (other.abs_diff(y) * other.abs_diff(y)) as u32;
            for (square, row) in squares.iter_mut().zip(&rows[other * width..]) {
                *square = (*square).min(row.saturating_add(down));
            }
        }
    });
    squares
}

#[cfg(test)]
mod tests {
    use super::*;

    struct Random(u32);

    impl Random {
        fn next(&mut self) -> u32 {
            self.0 = self.0.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
            self.0 >> 16
        }
    }

    fn colors(random: &mut Random, count: usize) -> Vec<Weighed> {
        let color = |_| {
            if random.next().is_multiple_of(3) { (Vec4::ZERO, 0.0) } else { (Vec4::splat(random.next() as f32), 1.0) }
        };
        (0..count).map(color).collect()
    }

    /// Sums of sums along rows, one after the other from place to place.
    fn plain(all: &[Weighed], width: usize, weight: impl Fn(usize, usize, usize) -> f32) -> Vec<Weighed> {
        let height = all.len() / width;
        let row = |y: usize, x: usize| {
            (0..width).fold((Vec4::ZERO, 0.0), |mut sum, other| {
                add(&mut sum, &all[y * width + other], weight(0, x, other));
                sum
            })
        };
        let at = |place: usize| {
            (0..height).fold((Vec4::ZERO, 0.0), |mut sum, other| {
                add(&mut sum, &row(other, place % width), weight(1, place / width, other));
                sum
            })
        };
        (0..all.len()).map(at).collect()
    }

    #[test]
    fn means_are_those_of_single_places() {
        let random = &mut Random(1);
        let (width, height) = (23, 17);
        let all = colors(random, width * height);
        for reach in [0, 1, 3, 16, 30] {
            let turn = std::f32::consts::PI / (reach + 1) as f32;
            let bell = |away: usize| if away <= reach { 0.5 + 0.5 * (turn * away as f32).cos() } else { 0.0 };
            let expected = plain(&all, width, |_, at, other| bell(at.abs_diff(other)));
            for (sum, other) in bell_sums(&all, width, reach, turn.into()).into_iter().zip(expected) {
                let near = |a: f32, b: f32| (a - b).abs() <= 1e-4 * (1.0 + b.abs());
                assert!(near(sum.1, other.1) && near(sum.0.x, other.0.x), "{reach}: {sum:?}, {other:?}");
            }
        }
        for (side, first) in [(1, [0, 0]), (3, [2, 1]), (5, [0, 4]), (201, [150, 190]), (201, [0, 0])] {
            let weight = |axis: usize, at: usize, other: usize| {
                let cell = |at: usize| (at + first[axis]) / side;
                f32::from(u8::from(cell(at) == cell(other)))
            };
            assert_eq!(
                cell_sums(&all, width, side, first[0], first[1]),
                plain(&all, width, weight),
                "{side} {first:?}"
            );
        }
    }

    #[test]
    fn distances_are_those_to_the_nearest_mark() {
        let random = &mut Random(2);
        let (width, height) = (31, 19);
        for reach in [0, 1, 3, 50] {
            let marks: Vec<bool> = (0..width * height).map(|_| random.next().is_multiple_of(37)).collect();
            let nearest = |place: usize| {
                let away = |other: usize| {
                    [place % width, place / width]
                        .map(|at| at as i64)
                        .into_iter()
                        .zip([other % width, other / width])
                        .map(|(at, other)| (at - other as i64).abs())
                };
                let near = (0..marks.len()).filter(|other| marks[*other] && away(*other).all(|away| away <= reach));
                near.map(|other| away(other).map(|away| away * away).sum::<i64>() as u32).min().unwrap_or(FAR)
            };
            let expected: Vec<u32> = (0..marks.len()).map(nearest).collect();
            assert_eq!(squared_distances(&marks, width, reach as u32), expected, "{reach}");
        }
    }
}
