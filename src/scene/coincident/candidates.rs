//! Pairs of triangles that coincide: found by their planes, then by where they are.
//!
//! Cells are looked at in slices, so that what is kept at once is bounded; what is found does not depend on how many there
//! are.

use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::bvh2::builder::build_bvh2;
use obvhs::{BvhBuildParams, aabb::Aabb};
use rayon::prelude::*;

use super::Part;
use super::cells::Place;
use super::face::Face;

/// The most triangles that are looked at: about as many as the default limit of memory lets a scene draw.
const MOST_TRIANGLES: usize = 1 << 25;
/// The most entries of cells that are kept at once, 16 bytes each.
const MOST_ENTRIES: usize = 1 << 24;
/// Cells are looked at in so many slices at the most.
const MOST_SLICES: u64 = 1 << 10;
/// So many triangles are held against each other at once, some 300 bytes each: of larger cells, parts of their planes.
const MOST_TOGETHER: usize = 1 << 19;
/// A cell is cut where each side has so large a share of it at the most.
const LARGEST_SIDE: f64 = 0.625;
/// Up to so many triangles in a cell each is held against all others.
const FEW: usize = 24;
/// So many triangles are held against each, and so many found, at the most: who puts more over each other is served in part.
const MOST_ASKED: usize = 4096;
const MOST_FOUND: usize = 64;
/// All together.
const MOST_ASKED_IN_ALL: u64 = 1 << 32;
const MOST_PAIRS: usize = 1 << 25;

/// A triangle in a cell of planes: the cell, the triangle's number among all, its part.
type Entry = (u64, u32, u32);

/// The numbers of triangles that coincide, the lower first.
pub type Pair = (u32, u32);

/// The pairs of triangles that coincide, sorted; and whether all of the parts has been looked at.
pub fn pairs(parts: &[Part]) -> (Vec<Pair>, bool) {
    pairs_in_slices(parts, MOST_ENTRIES)
}

/// `most`: entries that are kept at once.
fn pairs_in_slices(parts: &[Part], most: usize) -> (Vec<Pair>, bool) {
    let end = |part: &Part| part.first_triangle as usize + part.triangles.len();
    let known = parts.partition_point(|part| end(part) <= MOST_TRIANGLES);
    let (parts, left_out) = parts.split_at(known);
    let place = Place::of(parts);
    let mut search =
        Search { parts, place, pairs: Vec::new(), asked: 0, is_full: false, is_whole: left_out.is_empty() };
    search.look_at(Slice { number: 0, of: 1 }, most);
    search.tidy();
    (search.pairs, search.is_whole)
}

/// Some of the cells: of a power of two of shares the one of a number.
#[derive(Debug, Clone, Copy)]
struct Slice {
    number: u64,
    of: u64,
}

impl Slice {
    fn holds(self, cell: u64) -> bool {
        // Neighbouring cells are in different slices.
        let mixed = cell.wrapping_mul(0x9e37_79b9_7f4a_7c15) >> 32;
        mixed & (self.of - 1) == self.number
    }

    fn halves(self) -> [Self; 2] {
        [self.number, self.number + self.of].map(|number| Self { number, of: 2 * self.of })
    }
}

struct Search<'a> {
    parts: &'a [Part<'a>],
    place: Place,
    pairs: Vec<Pair>,
    /// How often a triangle has been held against another.
    asked: u64,
    /// No more pairs are taken.
    is_full: bool,
    /// Nothing had to be left out.
    is_whole: bool,
}

impl Search<'_> {
    fn look_at(&mut self, slice: Slice, most: usize) {
        if let Some(entries) = self.entries(slice, most) {
            self.look_at_entries(entries);
        } else if slice.of < MOST_SLICES {
            slice.halves().into_iter().for_each(|half| self.look_at(half, most));
        } else {
            // One cell alone has that many.
            self.is_whole = false;
            let (place, parts) = (self.place, self.parts);
            let entries = (0u32..).zip(parts).flat_map(|(number, part)| {
                (0..part.triangles.len() as u32)
                    .flat_map(move |triangle| entries(&place, slice, number, part, triangle))
            });
            let entries = entries.take(most).collect();
            self.look_at_entries(entries);
        }
    }

    /// The entries of a slice; `None` where there are more than `most`.
    fn entries(&self, slice: Slice, most: usize) -> Option<Vec<Entry>> {
        /// Triangles that are looked at together.
        const STEP: usize = 4096;
        let count = AtomicUsize::new(0);
        let of_step = &|number: usize, part: &Part, first: usize| {
            let own = first as u32..part.triangles.len().min(first + STEP) as u32;
            let own: Vec<Entry> =
                own.flat_map(|triangle| entries(&self.place, slice, number as u32, part, triangle)).collect();
            (count.fetch_add(own.len(), Ordering::Relaxed) + own.len() <= most).then_some(own)
        };
        let steps = self.parts.par_iter().enumerate().flat_map(|(number, part)| {
            let firsts = (0..part.triangles.len()).into_par_iter().step_by(STEP);
            firsts.map(move |first| of_step(number, part, first))
        });
        let steps: Option<Vec<Vec<Entry>>> = steps.collect();
        Some(steps?.concat())
    }

    fn face(&self, (_, number, part): &Entry) -> Face {
        let part = &self.parts[*part as usize];
        part.face(number - part.first_triangle, self.place.origin)
    }

    /// Of whole cells.
    fn look_at_entries(&mut self, mut entries: Vec<Entry>) {
        entries.par_sort_unstable();
        let (mut batch, mut size) = (Vec::new(), 0);
        for cell in entries.chunk_by(|a, b| a.0 == b.0).filter(|cell| cell.len() > 1) {
            if cell.len() > MOST_TOGETHER {
                self.cut(cell);
                continue;
            }
            if size + cell.len() > MOST_TOGETHER {
                self.compare(&std::mem::take(&mut batch));
                size = 0;
            }
            size += cell.len();
            batch.push(cell);
        }
        self.compare(&batch);
    }

    /// Looks at the two sides of a cell that has too many triangles, each with those that reach across.
    fn cut(&mut self, cell: &[Entry]) {
        if cell.len() <= MOST_TOGETHER {
            return self.compare(&[cell]);
        }
        let boxed = |entry: &Entry| Boxed::new(&self.face(entry)).0;
        let middles = cell.iter().map(boxed).fold(Aabb::empty(), |all, own| {
            let middle = 0.5 * (own.min + own.max);
            Aabb { min: all.min.min(middle), max: all.max.max(middle) }
        });
        let axis = (middles.max - middles.min).max_position();
        let mut along: Vec<f32> = cell.iter().map(boxed).map(|own| 0.5 * (own.min[axis] + own.max[axis])).collect();
        let half = along.len() / 2;
        let middle = *along.select_nth_unstable_by(half, f32::total_cmp).1;
        let below = cell.iter().filter(|entry| boxed(entry).min[axis] <= middle).copied().collect::<Vec<_>>();
        let above = cell.iter().filter(|entry| boxed(entry).max[axis] >= middle).copied().collect();
        let sides = [below, above];
        if sides.iter().any(|side| side.len() as f64 > LARGEST_SIDE * cell.len() as f64) {
            // They lie over each other, all of them.
            self.is_whole = false;
            return self.compare(&[&cell[..MOST_TOGETHER]]);
        }
        sides.iter().for_each(|side| self.cut(side));
    }

    /// Adds the pairs that coincide in each of some cells.
    fn compare(&mut self, cells: &[&[Entry]]) {
        if cells.is_empty() {
            return;
        }
        if self.pairs.len() > 2 * MOST_PAIRS {
            self.tidy();
            self.is_full |= self.pairs.len() > MOST_PAIRS;
        }
        if self.is_full || self.asked > MOST_ASKED_IN_ALL {
            self.is_whole = false;
            return;
        }
        let found: Vec<(Vec<Pair>, usize)> = cells.par_iter().map(|cell| self.within(cell)).collect();
        for (pairs, asked) in found {
            self.pairs.extend(pairs);
            self.asked += asked as u64;
        }
    }

    fn tidy(&mut self) {
        self.pairs.par_sort_unstable();
        self.pairs.dedup();
    }

    /// The pairs that coincide among the triangles of a cell, and how often two were held against each other.
    fn within(&self, cell: &[Entry]) -> (Vec<Pair>, usize) {
        let faces: Vec<Face> = cell.iter().map(|entry| self.face(entry)).collect();
        let mut pairs = Vec::new();
        let place = |entry: &Entry| self.parts[entry.2 as usize].place;
        // Versions of one primitive, and one thing that is drawn twice, stay as they are.
        let may_hide = |i: usize, j: usize| cell[i].2 == cell[j].2 || place(&cell[i]) != place(&cell[j]);
        let is_pair = |i: usize, j: usize| may_hide(i, j) && faces[i].coincides(&faces[j]);
        if cell.len() <= FEW {
            let all = (0..cell.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
            pairs.extend(all.filter(|(j, i)| is_pair(*j, *i)).map(|(j, i)| (cell[j].1, cell[i].1)));
            return (pairs, cell.len() * cell.len() / 2);
        }
        let boxes: Vec<Boxed> = faces.iter().map(Boxed::new).collect();
        let bvh = build_bvh2(&boxes, BvhBuildParams::fastest_build(), &mut Duration::default());
        let mut asked_in_all = 0;
        for i in 0..cell.len() {
            let (mut asked, mut found) = (0, 0);
            bvh.aabb_traverse(boxes[i].0, |bvh, node| {
                let node = &bvh.nodes[node as usize];
                let first = node.first_index as usize;
                for other in &bvh.primitive_indices[first..first + node.prim_count as usize] {
                    let j = *other as usize;
                    if j != i && is_pair(i, j) {
                        pairs.push((cell[i].1.min(cell[j].1), cell[i].1.max(cell[j].1)));
                        found += 1;
                    }
                    asked += 1;
                }
                asked < MOST_ASKED && found < MOST_FOUND
            });
            asked_in_all += asked;
        }
        (pairs, asked_in_all)
    }
}

/// Of one triangle in the cells of a slice.
fn entries(
    place: &Place,
    slice: Slice,
    number: u32,
    part: &Part,
    triangle: u32,
) -> impl Iterator<Item = Entry> + use<> {
    let cells = place.cells(&part.face(triangle, place.origin)).into_iter();
    let triangle = part.first_triangle + triangle;
    cells.filter(move |cell| slice.holds(*cell)).map(move |cell| (cell, triangle, number))
}

struct Boxed(Aabb);

impl Boxed {
    fn new(face: &Face) -> Self {
        let [a, b, c] = face.corners;
        let (min, max) = (a.min(b).min(c), a.max(b).max(c));
        let pad = face.tolerance + 1e-6 * min.abs().max(max.abs()).max_element();
        let single = |p: DVec3| Vec3A::from(p.as_vec3());
        Self(Aabb { min: single(min - pad), max: single(max + pad) })
    }
}

impl obvhs::Boundable for Boxed {
    fn aabb(&self) -> Aabb {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use glam::{DAffine3, Vec3};

    use super::*;

    #[test]
    fn what_is_found_does_not_depend_on_slices() {
        // Fans of triangles in planes of all slopes, each twice.
        let positions: Vec<Vec3> = (0..64)
            .flat_map(|i| {
                let turn = |x: f32| (x * i as f32).sin();
                let [a, b, c] = [0.31, 0.47, 0.83].map(turn);
                [Vec3::new(a, b, c), Vec3::new(b + 0.5, c, a), Vec3::new(c, a + 0.5, b)]
            })
            .collect();
        let triangles: Vec<[u32; 3]> = (0..64).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect();
        let part = |place: usize| Part {
            place: [0, place, 0],
            world_from_local: DAffine3::IDENTITY,
            positions: &positions,
            triangles: &triangles,
            first_triangle: 64 * place as u32,
        };
        let parts = [part(0), part(1)];
        let at_once = pairs_in_slices(&parts, usize::MAX);
        assert!(at_once.1 && at_once.0.len() >= 64, "{}", at_once.0.len());
        for most in [1000, 100, 10] {
            assert_eq!(pairs_in_slices(&parts, most), at_once, "{most} entries at once");
        }
    }

    #[test]
    fn a_cell_of_more_than_is_kept_is_served_in_part() {
        let positions = [Vec3::ZERO, Vec3::X, Vec3::Y];
        let part = |place: usize| Part {
            place: [0, place, 0],
            world_from_local: DAffine3::IDENTITY,
            positions: &positions,
            triangles: &[[0, 1, 2]],
            first_triangle: place as u32,
        };
        let parts: Vec<Part> = (0..20).map(part).collect();
        let (all, is_whole) = pairs_in_slices(&parts, usize::MAX);
        assert_eq!((all.len(), is_whole), (190, true));
        let (some, is_whole) = pairs_in_slices(&parts, 8);
        assert!(!is_whole && !some.is_empty() && some.iter().all(|pair| all.contains(pair)), "{some:?}");
    }
}
