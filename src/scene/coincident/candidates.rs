//! Pairs of triangles that coincide: found by their planes, then by where they are.

use std::time::Duration;

use glam::{DVec3, Vec3A};
use obvhs::bvh2::builder::build_bvh2;
use obvhs::{BvhBuildParams, aabb::Aabb};
use rayon::prelude::*;

use super::Part;
use super::face::Face;

/// Planes are sorted into cells: by two slopes against the axis that they face most, and by where they cross it.
const SLOPES: f64 = 1.0 / 64.0;
/// As a share of the extent of what is drawn.
const OFFSETS: f64 = 1.0 / 256.0;
/// Up to so many triangles in a cell each is held against all others.
const FEW: usize = 24;
/// So many triangles are held against each, and so many found, at the most: who puts more over each other is served in part.
const MOST_ASKED: usize = 4096;
const MOST_FOUND: usize = 64;

/// A triangle in a cell of planes: the cell, the triangle's number among all, its part.
type Entry = (u64, u32, u32);

/// The numbers of triangles that coincide, the lower first, sorted.
pub fn pairs(parts: &[Part]) -> Vec<(u32, u32)> {
    let place = Place::of(parts);
    let mut entries: Vec<Entry> = parts
        .par_iter()
        .enumerate()
        .flat_map(|(number, part)| {
            let triangles = (0..part.triangles.len() as u32).into_par_iter();
            triangles.flat_map_iter(move |triangle| {
                let cells = place.cells(&part.face(triangle, place.origin));
                cells.into_iter().map(move |cell| (cell, part.first_triangle + triangle, number as u32))
            })
        })
        .collect();
    entries.par_sort_unstable();
    let cells: Vec<&[Entry]> = entries.chunk_by(|a, b| a.0 == b.0).filter(|cell| cell.len() > 1).collect();
    let mut pairs: Vec<(u32, u32)> =
        cells.into_par_iter().flat_map_iter(|cell| within(parts, cell, place.origin)).collect();
    pairs.par_sort_unstable();
    pairs.dedup();
    pairs
}

/// Where all that is drawn lies, more or less: one stray vertex does not move it.
#[derive(Debug, Clone, Copy)]
struct Place {
    origin: DVec3,
    extent: f64,
}

impl Place {
    fn of(parts: &[Part]) -> Self {
        let bounds = |part: &Part| {
            let ends = |low: DVec3, high: DVec3, p: DVec3| (low.min(p), high.max(p));
            let (low, high) = part
                .positions
                .iter()
                .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| ends(low, high, p.as_dvec3()));
            (low.cmple(high).all()).then(|| {
                let world = &part.world_from_local;
                let size = world.transform_vector3(high - low).length();
                (world.transform_point3(0.5 * (low + high)), 0.5 * size)
            })
        };
        let balls: Vec<(DVec3, f64)> = parts.par_iter().filter_map(bounds).collect();
        let median = |mut values: Vec<f64>| {
            values.sort_unstable_by(f64::total_cmp);
            values.get(values.len() / 2).copied().unwrap_or_default()
        };
        let origin = DVec3::from_array([0, 1, 2].map(|axis| median(balls.iter().map(|ball| ball.0[axis]).collect())));
        let extent = median(balls.iter().map(|(center, radius)| center.distance(origin) + radius).collect());
        Self { origin, extent: extent.max(f64::MIN_POSITIVE) }
    }

    /// The cells that a triangle's plane may belong to, whatever rounding did to it.
    fn cells(&self, face: &Face) -> Vec<u64> {
        let mut cells = Vec::new();
        if !face.is_sound() {
            return cells;
        }
        let room = 4.0 * face.tolerance / face.height;
        let largest = face.normal.abs().max_element();
        for axis in 0..3 {
            let facing = face.normal[axis];
            // Of axes that it faces alike another one's plane may choose either.
            if facing.abs() < largest * (1.0 - room) - 1e-6 {
                continue;
            }
            let others = [(axis + 1) % 3, (axis + 2) % 3];
            let slopes = others.map(|other| face.normal[other] / facing);
            let center = face.center();
            let offset = center[axis] + slopes[0] * center[others[0]] + slopes[1] * center[others[1]];
            let away = center[others[0]].abs() + center[others[1]].abs();
            let [a, b] = slopes.map(|slope| steps(slope / SLOPES, 2.0 * room / SLOPES));
            let size = OFFSETS * self.extent;
            let c = steps(offset / size, (4.0 * face.tolerance + 2.0 * room * away) / size);
            for a in a.0..=a.1 {
                for b in b.0..=b.1 {
                    cells.extend((c.0..=c.1).map(|c| key(axis, a, b, c)));
                }
            }
        }
        cells
    }
}

/// The whole numbers below a value and within some room of it: three at the most.
fn steps(value: f64, room: f64) -> (i64, i64) {
    let room = room.min(1.0);
    ((value - room).floor() as i64, (value + room).floor() as i64)
}

fn key(axis: usize, a: i64, b: i64, c: i64) -> u64 {
    let slope = |step: i64| (step + 512) as u64 & 1023;
    (axis as u64) << 60 | slope(a) << 50 | slope(b) << 40 | (c as u64 & 0xff_ffff_ffff)
}

/// The pairs that coincide among the triangles of a cell.
fn within(parts: &[Part], cell: &[Entry], origin: DVec3) -> Vec<(u32, u32)> {
    let face = |(_, number, part): &Entry| {
        let part = &parts[*part as usize];
        part.face(number - part.first_triangle, origin)
    };
    let faces: Vec<Face> = cell.iter().map(face).collect();
    let mut pairs = Vec::new();
    let place = |entry: &Entry| parts[entry.2 as usize].place;
    // Versions of one primitive, and one thing that is drawn twice, stay as they are.
    let may_hide = |i: usize, j: usize| cell[i].2 == cell[j].2 || place(&cell[i]) != place(&cell[j]);
    let is_pair = |i: usize, j: usize| may_hide(i, j) && faces[i].coincides(&faces[j]);
    if cell.len() <= FEW {
        let all = (0..cell.len()).flat_map(|i| (0..i).map(move |j| (j, i)));
        pairs.extend(all.filter(|(j, i)| is_pair(*j, *i)).map(|(j, i)| (cell[j].1, cell[i].1)));
        return pairs;
    }
    let boxes: Vec<Boxed> = faces.iter().map(Boxed::new).collect();
    let bvh = build_bvh2(&boxes, BvhBuildParams::fastest_build(), &mut Duration::default());
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
    }
    pairs
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
