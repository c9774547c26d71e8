//! What lies across the edges of triangles, for wires: those of a border have no second half, and those within a flat
//! polygon are its triangulation's, not the shape's.

use std::collections::HashMap;

use glam::Vec3;
use rayon::prelude::*;

use super::vertex_values::places;
use super::{Aabb, Budget, Mesh, Model, Primitive};
use crate::InputError;
use crate::pieces::Welder;

/// What lies across an edge of a triangle: another triangle of its mesh, or nothing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Across(u32);

const FEATURE: u32 = 1 << 31;
const NOTHING: u32 = FEATURE - 1;
const NO_SIDE: u32 = u32::MAX;

impl Across {
    /// Nothing: the mesh ends there.
    pub const BORDER: Self = Self(FEATURE | NOTHING);

    fn new(opposite: u32, is_feature: bool) -> Self {
        Self(opposite.min(NOTHING) | if is_feature { FEATURE } else { 0 })
    }

    /// The corner of the other triangle that is not on the edge: a vertex of the mesh, counted through its primitives.
    pub fn opposite(self) -> Option<u32> {
        Some(self.0 & NOTHING).filter(|vertex| *vertex != NOTHING)
    }

    /// The surface turns there, or ends, or another primitive begins.
    pub fn is_feature(self) -> bool {
        self.0 & FEATURE != 0
    }

    pub fn kind(self) -> EdgeKind {
        match self.opposite() {
            None => EdgeKind::Border,
            Some(_) if self.is_feature() => EdgeKind::Turned,
            Some(_) => EdgeKind::Flat,
        }
    }
}

/// The edges of a triangle: the i-th leads from its i-th corner to the next.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edges {
    pub across: [Across; 3],
    /// Two bits for each of the six edges that the triangles across have besides: see [`Edges::beyond`].
    beyond: u32,
}

/// What an edge is to the surface.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum EdgeKind {
    /// It ends there.
    Border,
    /// It turns there.
    Turned,
    /// It is flat there.
    Flat,
}

impl Edges {
    const ALONE: Self = Self { across: [Across::BORDER; 3], beyond: 0 };

    /// What the edges are that lead from the ends of the i-th edge, in its direction, to the corner opposite.
    pub fn beyond(&self, i: usize) -> [EdgeKind; 2] {
        [0, 2].map(|shift| match self.beyond >> (4 * i + shift) & 3 {
            0 => EdgeKind::Border,
            1 => EdgeKind::Turned,
            _ => EdgeKind::Flat,
        })
    }

    /// The same as a word for shaders.
    pub fn beyond_word(&self) -> u32 {
        self.beyond
    }
}

/// Neighbours lie in one plane up to this angle, in radians: what files round, and no more than a fine tessellation turns.
const FLAT: f32 = 1e-3;
/// Or up to this share of their largest coordinate.
const ROUNDING: f32 = 2e-6;
/// Bytes that a triangle takes while its neighbours are looked for, and a vertex.
const PASSING: u64 = 160;
const VERTEX: u64 = 64;
/// Of so many triangles at one edge each is held against all others.
const MOST_AT_AN_EDGE: usize = 16;

impl Mesh {
    /// The position of a vertex, counted through all primitives, where a filter has asked for its edges.
    pub fn vertex(&self, number: u32) -> Option<Vec3> {
        // Of primitives without vertices the next begins where they do.
        let behind = self.primitives.partition_point(|own| own.first_vertex <= number);
        let primitive = &self.primitives[behind.checked_sub(1)?];
        primitive.positions.get((number - primitive.first_vertex) as usize).copied()
    }

    fn number_vertices(&mut self) {
        let mut next = 0;
        for primitive in &mut self.primitives {
            primitive.first_vertex = next;
            next += primitive.positions.len() as u32;
        }
    }
}

impl Model {
    /// Finds what lies across the edges of all triangles that are drawn, in every version.
    pub(super) fn add_across(&mut self, budget: &mut Budget) -> Result<(), InputError> {
        let mut drawn: Vec<usize> = self.nodes.iter().filter(|node| node.drawn).filter_map(|node| node.mesh).collect();
        drawn.sort_unstable();
        drawn.dedup();
        let is_known = |own: &Primitive| {
            let simplified = || own.simplified.iter().all(|version| version.across.len() == version.triangles.len());
            own.across.len() == own.triangles.len() && simplified()
        };
        drawn.retain(|mesh| !self.meshes[*mesh].primitives.iter().all(is_known));
        let primitives = || drawn.iter().flat_map(|mesh| &self.meshes[*mesh].primitives);
        let of_versions = |own: &Primitive| own.versions().map(|(_, triangles)| triangles.len() as u64).sum::<u64>();
        let triangles: u64 = primitives().map(of_versions).sum();
        let vertices: u64 = primitives().map(|own| own.positions.len() as u64).sum();
        let passing = PASSING * triangles + VERTEX * vertices;
        let kept = size_of::<Edges>() as u64 * triangles;
        let what = || format!("{}: what lies across the edges of {triangles} triangles, for wires", self.name);
        budget.take(kept + passing, what)?;
        let all: Vec<Vec<Version>> = drawn.par_iter().map(|mesh| versions(&self.meshes[*mesh])).collect();
        for (mesh, versions) in drawn.into_iter().zip(all) {
            self.meshes[mesh].number_vertices();
            for Version { primitive, number, across } in versions {
                let primitive = &mut self.meshes[mesh].primitives[primitive];
                match number.checked_sub(1) {
                    None => primitive.across = across,
                    Some(simplified) => primitive.simplified[simplified].across = across,
                }
            }
        }
        budget.give_back(passing);
        Ok(())
    }
}

/// The triangles of a primitive (number 0) or a simplified version of it, with what lies across their edges.
struct Version {
    primitive: usize,
    number: usize,
    across: Vec<Edges>,
}

/// All versions of a mesh: simplified ones beside those of the same ratio, where there are such.
fn versions(mesh: &Mesh) -> Vec<Version> {
    let mut ratios: Vec<f32> = mesh.primitives.iter().flat_map(|own| own.versions().map(|(ratio, _)| ratio)).collect();
    ratios.sort_by(|a, b| b.total_cmp(a));
    ratios.dedup();
    let places = Places::new(mesh);
    let of_ratio = |ratio: &f32| {
        let lists: Vec<&[[u32; 3]]> =
            mesh.primitives.iter().map(|own| own.version(*ratio).unwrap_or(&own.triangles)).collect();
        let mut across = across(&places, &lists);
        let found = mesh.primitives.iter().enumerate().filter_map(|(primitive, own)| {
            let number = own.versions().position(|(own, _)| own == *ratio)?;
            Some(Version { primitive, number, across: std::mem::take(&mut across[primitive]) })
        });
        found.collect::<Vec<_>>()
    };
    ratios.iter().flat_map(of_ratio).collect()
}

/// Where the vertices of a mesh are.
struct Places {
    /// Of each primitive's first vertex, counted through all of them.
    first: Vec<u32>,
    positions: Vec<Vec3>,
    /// Of each vertex: the same number for all at one place.
    of: Vec<u32>,
    bounds: Aabb,
}

impl Places {
    fn new(mesh: &Mesh) -> Self {
        let positions: Vec<Vec3> = mesh.primitives.iter().flat_map(|own| &own.positions).copied().collect();
        let starts = mesh.primitives.iter().scan(0, |next, own: &Primitive| {
            let first = *next;
            *next += own.positions.len() as u32;
            Some(first)
        });
        let bounds = Aabb::from_points(positions.iter().map(|p| p.as_dvec3()));
        Self { first: starts.collect(), of: places(&positions), positions, bounds }
    }
}

/// A triangle's way along an edge: the places of its ends, the lower first, and the edge's number among all.
type Run = ([u32; 2], u32);

/// What lies across each edge of the triangles of each primitive.
fn across(places: &Places, lists: &[&[[u32; 3]]]) -> Vec<Vec<Edges>> {
    let first = |primitive: usize| places.first[primitive];
    let corners: Vec<[u32; 3]> = lists
        .iter()
        .enumerate()
        .flat_map(|(primitive, list)| list.iter().map(move |corners| corners.map(|c| first(primitive) + c)))
        .collect();
    let mut found = vec![Edges::ALONE; corners.len()];
    let mut partners = vec![NO_SIDE; 3 * corners.len()];
    let sides = Sides { places, corners: &corners, ends: ends(lists) };
    let runs: Vec<Run> = corners.par_iter().enumerate().flat_map_iter(|(i, own)| runs(i, own, &places.of)).collect();
    let lone = sides.meet(runs, &mut found, &mut partners);
    // Seams whose two sides were computed apart.
    let welded = weld(&sides, &lone);
    let again = lone.into_iter().map(|(ends, side)| (ends.map(|end| welded.get(&end).copied().unwrap_or(end)), side));
    let again = again.map(|([a, b], side)| ([a.min(b), a.max(b)], side)).filter(|([a, b], _)| a != b);
    sides.meet(again.collect(), &mut found, &mut partners);
    sides.look_beyond(&mut found, &partners);
    let mut rest = &found[..];
    let own = |list: &&[[u32; 3]]| {
        let (own, others) = rest.split_at(list.len());
        rest = others;
        own.to_vec()
    };
    lists.iter().map(own).collect()
}

fn runs(triangle: usize, corners: &[u32; 3], places: &[u32]) -> impl Iterator<Item = Run> + use<> {
    let [a, b, c] = corners.map(|corner| places[corner as usize]);
    let sides = [[a, b], [b, c], [c, a]].into_iter().enumerate();
    let sides = sides.filter(|(_, [from, to])| from != to);
    sides.map(move |(side, [from, to])| ([from.min(to), from.max(to)], 3 * triangle as u32 + side as u32))
}

/// The number after the last triangle of each primitive.
fn ends(lists: &[&[[u32; 3]]]) -> Vec<u32> {
    lists
        .iter()
        .scan(0, |end, list| {
            *end += list.len() as u32;
            Some(*end)
        })
        .collect()
}

/// The edges of all triangles of a mesh: number 3 t + i is the i-th of triangle t.
struct Sides<'a> {
    places: &'a Places,
    /// Vertices, counted through all primitives.
    corners: &'a [[u32; 3]],
    /// The number after the last triangle of each primitive.
    ends: Vec<u32>,
}

impl Sides<'_> {
    /// Says what lies across the edges along which several triangles run; returns the others.
    fn meet(&self, mut runs: Vec<Run>, found: &mut [Edges], partners: &mut [u32]) -> Vec<Run> {
        runs.par_sort_unstable();
        let mut lone = Vec::new();
        for at_edge in runs.chunk_by(|a, b| a.0 == b.0) {
            if let [only] = at_edge {
                lone.push(*only);
                continue;
            }
            for (place, (_, side)) in at_edge.iter().enumerate() {
                let near = if at_edge.len() <= MOST_AT_AN_EDGE { 0 } else { place.saturating_sub(MOST_AT_AN_EDGE / 2) };
                let others =
                    at_edge[near..].iter().take(MOST_AT_AN_EDGE).map(|run| run.1).filter(|other| other != side);
                let (across, partner) = self.across(*side, others);
                found[(side / 3) as usize].across[(side % 3) as usize] = across;
                partners[*side as usize] = partner;
            }
        }
        lone
    }

    /// Says what the other edges of the triangles across are.
    fn look_beyond(&self, found: &mut [Edges], partners: &[u32]) {
        let kind = |found: &[Edges], side: u32| match found[(side / 3) as usize].across[(side % 3) as usize].kind() {
            EdgeKind::Border => 0,
            EdgeKind::Turned => 1,
            EdgeKind::Flat => 2,
        };
        for (side, other) in (0u32..).zip(partners).filter(|(_, other)| **other != NO_SIDE) {
            let next = |step: u32| other / 3 * 3 + (other + step) % 3;
            let [first, _, _] = self.points(side);
            let [a, b, _] = self.points(*other);
            // Neighbours run along an edge in opposite directions, where none is turned.
            let (from, to) =
                if a.distance(first) < b.distance(first) { (next(2), next(1)) } else { (next(1), next(2)) };
            let bits = kind(found, from) | kind(found, to) << 2;
            found[(side / 3) as usize].beyond |= bits << (4 * (side % 3));
        }
    }

    /// Of several triangles across an edge the one that best goes on with the surface, and which edge of it that is.
    fn across(&self, side: u32, others: impl Iterator<Item = u32>) -> (Across, u32) {
        let (mut best, mut is_feature) = (None, false);
        for other in others {
            let turn = self.turn(side, other);
            is_feature |= !self.is_flat(side, other) || self.primitive(side) != self.primitive(other);
            if best.is_none_or(|(known, _)| turn < known) {
                best = Some((turn, other));
            }
        }
        match best {
            // Where it folds back there is an end, flat as it is.
            Some((turn, other)) => (Across::new(self.opposite(other), is_feature || turn >= 0.0), other),
            None => (Across::BORDER, NO_SIDE),
        }
    }

    fn primitive(&self, side: u32) -> usize {
        self.ends.partition_point(|end| *end <= side / 3)
    }

    /// The vertex of the edge's triangle that is not on it.
    fn opposite(&self, side: u32) -> u32 {
        self.corners[(side / 3) as usize][((side + 2) % 3) as usize]
    }

    fn point(&self, vertex: u32) -> Vec3 {
        self.places.positions[vertex as usize]
    }

    /// The edge's ends, and the corner opposite.
    fn points(&self, side: u32) -> [Vec3; 3] {
        let own = self.corners[(side / 3) as usize];
        [0, 1, 2].map(|step| self.point(own[(side as usize % 3 + step) % 3]))
    }

    /// The cosine between the ways in which two triangles leave their edge: -1 where one goes on with the other.
    fn turn(&self, side: u32, other: u32) -> f32 {
        let away = |[a, b, c]: [Vec3; 3]| {
            let along = (b - a).normalize_or_zero();
            ((c - a) - along * along.dot(c - a)).normalize_or_zero()
        };
        away(self.points(side)).dot(away(self.points(other)))
    }

    /// Whether two triangles at an edge lie in one plane: a sliver lies in any that it is near to.
    fn is_flat(&self, side: u32, other: u32) -> bool {
        let lies_in = |[a, b, c]: [Vec3; 3], p: Vec3| {
            let (normal, away) = ((b - a).cross(c - a).normalize_or_zero(), p - a);
            let largest = [a, b, c, p].map(|p| p.abs().max_element()).into_iter().fold(0.0, f32::max);
            let across = away - (b - a) * (away.dot(b - a) / (b - a).length_squared().max(f32::MIN_POSITIVE));
            normal.dot(away).abs() <= (FLAT * across.length()).max(ROUNDING * largest)
        };
        let (own, others) = (self.points(side), self.points(other));
        lies_in(own, others[2]) || lies_in(others, own[2])
    }
}

/// The places at the ends of some runs that are nearly one, with the number of the first of them.
fn weld(sides: &Sides, lone: &[Run]) -> HashMap<u32, u32> {
    let places = sides.places;
    let mut ends: Vec<(u32, u32)> = lone
        .iter()
        .flat_map(|(_, side)| {
            let own = sides.corners[(side / 3) as usize];
            [own[(side % 3) as usize], own[((side + 1) % 3) as usize]]
        })
        .map(|vertex| (places.of[vertex as usize], vertex))
        .collect();
    ends.sort_unstable();
    ends.dedup_by_key(|(place, _)| *place);
    let mut welder = Welder::new(&places.bounds);
    // Of each vertex of the welder, the first place that is there.
    let mut firsts: Vec<u32> = Vec::new();
    let mut welded = HashMap::new();
    for (place, vertex) in ends {
        match firsts.get(welder.vertex(sides.point(vertex).as_dvec3()) as usize) {
            Some(first) => _ = welded.insert(place, *first),
            None => firsts.push(place),
        }
    }
    welded
}

#[cfg(test)]
mod tests {
    use super::*;

    fn mesh(primitives: &[&[[Vec3; 3]]]) -> Mesh {
        let primitive = |own: &&[[Vec3; 3]]| Primitive {
            positions: own.concat(),
            triangles: (0..own.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            ..Primitive::default()
        };
        Mesh { name: String::new(), primitives: primitives.iter().map(primitive).collect() }
    }

    fn found(mesh: &Mesh) -> Vec<Vec<Edges>> {
        versions(mesh).into_iter().map(|version| version.across).collect()
    }

    fn count(all: &[Vec<Edges>], counts: impl Fn(Across) -> bool) -> usize {
        all.iter().flatten().flat_map(|edges| edges.across).filter(|across| counts(*across)).count()
    }

    /// A quad with corners of its own for each triangle.
    fn quad([a, b, c, d]: [Vec3; 4]) -> [[Vec3; 3]; 2] {
        [[a, b, c], [a, c, d]]
    }

    fn square(z: f32) -> [[Vec3; 3]; 2] {
        quad([Vec3::new(0.0, 0.0, z), Vec3::new(1.0, 0.0, z), Vec3::new(1.0, 1.0, z), Vec3::new(0.0, 1.0, z)])
    }

    #[test]
    fn a_square_has_four_borders_and_a_flat_diagonal() {
        let mesh = mesh(&[&square(0.0)]);
        let all = found(&mesh);
        assert_eq!(count(&all, |across| across == Across::BORDER), 4);
        let diagonal = all[0][0].across[2];
        assert_eq!(all[0][0].beyond(2), [EdgeKind::Border; 2]);
        assert!(!diagonal.is_feature());
        assert_eq!(diagonal.opposite().and_then(|vertex| mesh.vertex(vertex)), Some(Vec3::Y));
    }

    #[test]
    fn edges_beyond_an_edge_are_told_from_its_first_end() {
        // Beyond the diagonal from (1, 1) to (0, 0) there is a border, and a flat edge with a third triangle behind it.
        let [one, other] = square(0.0);
        let third = [Vec3::Y, Vec3::ZERO, Vec3::new(-1.0, 0.5, 0.0)];
        let all = found(&mesh(&[&[one, other, third]]));
        assert_eq!(all[0][0].beyond(2), [EdgeKind::Border, EdgeKind::Flat]);
        assert_eq!(all[0][1].beyond(0), [EdgeKind::Border; 2]);
    }

    #[test]
    fn a_cube_has_edges_and_diagonals_and_no_border() {
        let corner = |i: usize| Vec3::new((i & 1) as f32, (i >> 1 & 1) as f32, (i >> 2) as f32);
        let faces = [[0, 2, 3, 1], [4, 5, 7, 6], [0, 1, 5, 4], [2, 6, 7, 3], [0, 4, 6, 2], [1, 3, 7, 5]];
        let faces: Vec<[Vec3; 3]> = faces.iter().flat_map(|face| quad(face.map(corner))).collect();
        let all = found(&mesh(&[&faces]));
        assert_eq!(count(&all, |across| across.opposite().is_none()), 0);
        assert_eq!((count(&all, Across::is_feature), count(&all, |across| !across.is_feature())), (24, 12));
    }

    #[test]
    fn where_another_primitive_begins_is_an_edge() {
        let [one, other] = square(0.0);
        let all = found(&mesh(&[&[one], &[other]]));
        assert_eq!(count(&all, |across| across.opposite().is_some() && across.is_feature()), 2);
    }

    #[test]
    fn seams_that_were_computed_apart_are_joined() {
        let [one, mut other] = square(0.0);
        other[1] += Vec3::splat(3e-7);
        assert_eq!(count(&found(&mesh(&[&[one, other]])), |across| across == Across::BORDER), 4);
        other[1] += Vec3::splat(1e-4);
        assert_eq!(count(&found(&mesh(&[&[one, other]])), |across| across == Across::BORDER), 6);
    }

    #[test]
    fn a_sheet_with_two_sides_ends_where_they_meet() {
        let [one, other] = square(0.0);
        let back = |[a, b, c]: [Vec3; 3]| [a, c, b];
        let all = found(&mesh(&[&[one, other, back(one), back(other)]]));
        assert_eq!((count(&all, Across::is_feature), count(&all, |across| !across.is_feature())), (8, 4));
    }

    #[test]
    fn very_many_triangles_at_one_edge_take_no_time() {
        let turn = |i: usize| Vec3::new((i as f32).cos(), (i as f32).sin(), 0.5);
        let all: Vec<[Vec3; 3]> = (0..50_000).map(|i| [Vec3::ZERO, Vec3::Z, turn(i)]).collect();
        assert_eq!(found(&mesh(&[&all]))[0].len(), 50_000);
    }
}
