//! Triangles that belong together, turned to face one way.

use glam::DVec3;
use rayon::prelude::*;

use super::EdgeCounts;

/// A triangle's way along an edge: the edge's ends in one number, the lower vertex first; and twice the triangle, plus one
/// where it starts at the lower.
type Run = (u64, u32);

/// Some triangles of one patch meet an edge of other than two, an odd number of them.
#[derive(Debug, Clone, Copy)]
struct Seam {
    edge: u32,
    patch: u32,
    /// How much more often they run along it from the lower vertex than from the higher, when they face one way.
    net: i32,
}

/// An edge at which a piece ends.
#[derive(Debug, Clone, Copy)]
pub struct Border {
    pub piece: u32,
    pub ends: [u32; 2],
    /// How much more often its triangles run along it from the first end than from the second.
    pub net: i32,
}

#[derive(Debug, Clone, Copy, Default)]
pub struct Piece {
    pub is_open: bool,
    /// It cannot be turned to face one way.
    pub is_by_parity: bool,
    /// It has no triangle with three corners where no earlier one lies.
    pub is_empty: bool,
    pub area: f64,
}

/// Triangles by patches: those that meet two at an edge.
pub struct Patches {
    pub edges: EdgeCounts,
    /// Of each triangle, its patch; its piece, once they are joined.
    pub numbers: Vec<u32>,
    /// Of each triangle, whether it is turned round, so that its patch faces as most of it does.
    pub turned: Vec<bool>,
    /// One a patch; one a piece, once they are joined.
    pub pieces: Vec<Piece>,
    /// By edge.
    seams: Vec<Seam>,
    /// Of each edge of the seams.
    ends: Vec<[u32; 2]>,
}

fn is_degenerate([a, b, c]: &[u32; 3]) -> bool {
    a == b || b == c || c == a
}

/// Of each triangle, whether an earlier one lies there already, whichever way it faces.
fn repeats(triangles: &[[u32; 3]]) -> Vec<bool> {
    let sorted = |(number, corners): (usize, &[u32; 3])| {
        let mut corners = *corners;
        corners.sort_unstable();
        (corners, number as u32)
    };
    let mut places: Vec<([u32; 3], u32)> = triangles.par_iter().enumerate().map(sorted).collect();
    places.par_sort_unstable();
    let mut repeats = vec![false; triangles.len()];
    for pair in places.windows(2).filter(|pair| pair[0].0 == pair[1].0) {
        repeats[pair[1].1 as usize] = true;
    }
    repeats
}

fn runs(triangles: &[[u32; 3]], repeats: &[bool]) -> Vec<Run> {
    let of_triangle = |(number, corners): (usize, &[u32; 3])| {
        let ([a, b, c], is_left_out) = (*corners, repeats[number] || is_degenerate(corners));
        let run = move |(from, to): (u32, u32)| {
            let edge = u64::from(from.min(to)) << 32 | u64::from(from.max(to));
            (edge, 2 * number as u32 + u32::from(from < to))
        };
        [(a, b), (b, c), (c, a)].into_iter().filter(move |_| !is_left_out).map(run)
    };
    let mut runs: Vec<Run> = triangles.par_iter().enumerate().flat_map_iter(of_triangle).collect();
    runs.par_sort_unstable();
    runs
}

/// 1 for a run from the lower vertex, -1 for one from the higher.
fn direction(run: &Run, turned: bool) -> i32 {
    if (run.1 & 1 == 1) == turned { -1 } else { 1 }
}

impl Patches {
    pub fn new(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let repeats = repeats(triangles);
        let runs = runs(triangles, &repeats);
        let by_edge = || runs.chunk_by(|a, b| a.0 == b.0);
        let mut edges = EdgeCounts::default();
        let mut sets = Sets::new(triangles.len());
        let mut one_sided = vec![false; triangles.len()];
        for met in by_edge() {
            edges.all += 1;
            match met {
                [_] => edges.open += 1,
                [a, b] => {
                    let opposed = a.1 & 1 == b.1 & 1;
                    edges.turned += usize::from(opposed);
                    if !sets.join(a.1 / 2, b.1 / 2, opposed) {
                        one_sided[a.1 as usize / 2] = true;
                    }
                }
                _ => edges.touching += 1,
            }
        }
        join_degenerate(vertices.len(), triangles, &repeats, &mut sets);
        let mut patches = Self {
            edges,
            numbers: vec![0; triangles.len()],
            turned: vec![false; triangles.len()],
            pieces: Vec::new(),
            seams: Vec::new(),
            ends: Vec::new(),
        };
        // How much more of a patch faces as its first triangle does than the other way.
        let mut facing: Vec<f64> = Vec::new();
        let mut number_of_root = vec![u32::MAX; triangles.len()];
        for (i, corners) in triangles.iter().enumerate() {
            let (root, turned) = sets.find(i as u32);
            let number = &mut number_of_root[root as usize];
            if *number == u32::MAX {
                *number = patches.pieces.len() as u32;
                patches.pieces.push(Piece { is_empty: true, ..Piece::default() });
                facing.push(0.0);
            }
            let area = area(vertices, corners);
            let patch = &mut patches.pieces[*number as usize];
            patch.is_empty &= repeats[i] || is_degenerate(corners);
            patch.area += area;
            patch.is_by_parity |= one_sided[i];
            facing[*number as usize] += if turned { -area } else { area };
            (patches.numbers[i], patches.turned[i]) = (*number, turned);
        }
        for (number, turned) in patches.numbers.iter().zip(&mut patches.turned) {
            *turned ^= facing[*number as usize] < 0.0;
        }
        by_edge().filter(|met| met.len() != 2).for_each(|met| patches.add_seams(met));
        patches
    }

    /// Takes the seams of one edge.
    fn add_seams(&mut self, met: &[Run]) {
        let edge = self.ends.len() as u32;
        let mut own: Vec<(u32, i32)> = met
            .iter()
            .map(|run| (self.numbers[run.1 as usize / 2], direction(run, self.turned[run.1 as usize / 2])))
            .collect();
        own.sort_unstable();
        let known = self.seams.len();
        for own in own.chunk_by(|a, b| a.0 == b.0) {
            let (patch, net) = (own[0].0, own.iter().map(|(_, direction)| direction).sum::<i32>());
            if own.len() % 2 == 1 {
                self.seams.push(Seam { edge, patch, net });
            } else if net != 0 {
                // It is closed there by itself, but does not face one way.
                self.pieces[patch as usize].is_by_parity = true;
            }
        }
        if self.seams.len() > known {
            self.ends.push([(met[0].0 >> 32) as u32, met[0].0 as u32]);
        }
    }

    /// Joins the patches that end in the same edges, and tells where the pieces still end.
    pub fn join(&mut self) -> Vec<Border> {
        let dropped = self.dropped();
        let kept = |seam: &&Seam| !dropped[seam.patch as usize];
        let mut sets = Sets::new(self.pieces.len());
        for met in self.seams.chunk_by(|a, b| a.edge == b.edge) {
            let mut own = met.iter().filter(kept);
            if let Some(first) = own.next() {
                own.for_each(|other| {
                    sets.join(first.patch, other.patch, false);
                });
            }
        }
        let mut borders = Vec::new();
        for met in self.seams.chunk_by(|a, b| a.edge == b.edge) {
            let ends = self.ends[met[0].edge as usize];
            for alone in met.iter().filter(|seam| dropped[seam.patch as usize]) {
                borders.push(Border { piece: alone.patch, ends, net: alone.net });
            }
            let Some(first) = met.iter().find(kept) else { continue };
            let net = met.iter().filter(kept).map(|seam| seam.net).sum::<i32>();
            if met.iter().filter(kept).count() % 2 == 1 {
                borders.push(Border { piece: first.patch, ends, net });
            } else if net != 0 {
                self.pieces[first.patch as usize].is_by_parity = true;
            }
        }
        for border in &borders {
            self.pieces[border.piece as usize].is_open = true;
        }
        // Patches to pieces.
        let mut pieces: Vec<Piece> = Vec::new();
        let mut number_of_root = vec![u32::MAX; self.pieces.len()];
        let numbers: Vec<u32> = (0..self.pieces.len())
            .map(|patch| {
                let number = &mut number_of_root[sets.find(patch as u32).0 as usize];
                if *number == u32::MAX {
                    *number = pieces.len() as u32;
                    pieces.push(Piece { is_empty: true, ..Piece::default() });
                }
                let (piece, own) = (&mut pieces[*number as usize], &self.pieces[patch]);
                piece.area += own.area;
                piece.is_open |= own.is_open;
                piece.is_by_parity |= own.is_by_parity;
                piece.is_empty &= own.is_empty;
                *number
            })
            .collect();
        self.pieces = pieces;
        self.numbers.iter_mut().for_each(|number| *number = numbers[*number as usize]);
        borders.iter_mut().for_each(|border| border.piece = numbers[border.piece as usize]);
        borders
    }

    /// Patches without which more edges close than open: sheets that end in a solid's edge, walls within one. The smallest
    /// are looked at first.
    fn dropped(&self) -> Vec<bool> {
        let mut dropped = vec![false; self.pieces.len()];
        let mut present = vec![0u32; self.ends.len()];
        self.seams.iter().for_each(|seam| present[seam.edge as usize] += 1);
        let mut by_patch: Vec<&Seam> = self.seams.iter().collect();
        by_patch.sort_unstable_by_key(|seam| (seam.patch, seam.edge));
        let mut patches: Vec<&[&Seam]> = by_patch.chunk_by(|a, b| a.patch == b.patch).collect();
        let area = |own: &&[&Seam]| self.pieces[own[0].patch as usize].area;
        patches.sort_by(|a, b| area(a).total_cmp(&area(b)));
        for own in patches {
            let odd = own.iter().filter(|seam| present[seam.edge as usize] % 2 == 1).count();
            if 2 * odd > own.len() {
                own.iter().for_each(|seam| present[seam.edge as usize] -= 1);
                dropped[own[0].patch as usize] = true;
            }
        }
        dropped
    }
}

pub fn area(vertices: &[DVec3], triangle: &[u32; 3]) -> f64 {
    let [a, b, c] = triangle.map(|i| vertices[i as usize]);
    (b - a).cross(c - a).length() * 0.5
}

/// Joins triangles of which corners coincide to others at their corners.
fn join_degenerate(vertices: usize, triangles: &[[u32; 3]], repeats: &[bool], sets: &mut Sets) {
    if !triangles.iter().any(is_degenerate) {
        return;
    }
    let mut at_vertex = vec![u32::MAX; vertices];
    let counts = |i: u32, corners: &[u32; 3]| !repeats[i as usize] && !is_degenerate(corners);
    for (i, corners) in (0u32..).zip(triangles).filter(|(i, corners)| counts(*i, corners)) {
        corners.iter().for_each(|corner| at_vertex[*corner as usize] = i);
    }
    for (i, corners) in (0u32..).zip(triangles).filter(|(_, corners)| is_degenerate(corners)) {
        if let Some(other) = corners.iter().map(|corner| at_vertex[*corner as usize]).find(|other| *other != u32::MAX) {
            sets.join(i, other, false);
        }
    }
}

/// Disjoint sets, in which members also face as their set's first does or the other way.
struct Sets {
    parents: Vec<u32>,
    turned: Vec<bool>,
}

impl Sets {
    fn new(count: usize) -> Self {
        Self { parents: (0..count as u32).collect(), turned: vec![false; count] }
    }

    /// The set's first member, and whether this one faces another way than it.
    fn find(&mut self, mut member: u32) -> (u32, bool) {
        let mut turned = false;
        loop {
            let parent = self.parents[member as usize];
            if parent == member {
                return (member, turned);
            }
            // Every other one on the way gets nearer to the first.
            self.turned[member as usize] ^= self.turned[parent as usize];
            self.parents[member as usize] = self.parents[parent as usize];
            turned ^= self.turned[member as usize];
            member = self.parents[member as usize];
        }
    }

    /// Makes one set of two; false where they were one, in which the members face each other as `opposed` does not say.
    fn join(&mut self, a: u32, b: u32, opposed: bool) -> bool {
        let ((a, a_turned), (b, b_turned)) = (self.find(a), self.find(b));
        let turned = a_turned ^ b_turned ^ opposed;
        if a == b {
            return !turned;
        }
        let (first, other) = (a.min(b), a.max(b));
        self.parents[other as usize] = first;
        self.turned[other as usize] = turned;
        true
    }
}
