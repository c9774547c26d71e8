//! Which parts of meshes enclose something: only those have an inside that a cut can lay open (SEMANTICS 6.6).

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};

use glam::Vec3;
use petgraph::unionfind::UnionFind;

use super::{Aabb, Mesh, Model};
use crate::pieces::{EdgeCounts, Pieces, Role, Welder};

/// What a mesh encloses, once corners at the same place are one.
#[derive(Debug, Clone, PartialEq)]
pub struct Closure {
    pub edges: EdgeCounts,
    /// Its connected pieces that enclose something.
    pub closed: usize,
    /// Those of them that do so because their holes are closed over.
    pub mended: usize,
    /// Its pieces that enclose nothing.
    pub open: usize,
    /// See [`Pieces::unsorted`].
    pub unsorted: usize,
    pub primitives: Vec<Enclosing>,
}

/// What a primitive has of closed pieces.
#[derive(Debug, Clone, PartialEq)]
pub struct Enclosing {
    /// The first of the primitives that have pieces together with it, itself if there is no other.
    pub group: usize,
    /// Of each triangle; none where all are [`Role::PLAIN`].
    pub roles: Vec<Role>,
    /// What closes holes over, as triangles after its own.
    pub lids: Vec<([Vec3; 3], Role)>,
    triangles: usize,
}

impl Enclosing {
    /// It has no triangles.
    pub fn is_empty(&self) -> bool {
        self.triangles == 0
    }

    /// Of one of its triangles, or of a lid behind them.
    pub fn role(&self, triangle: usize) -> Role {
        let lid = triangle.checked_sub(self.triangles).and_then(|lid| self.lids.get(lid));
        lid.map_or(self.roles.get(triangle).copied().unwrap_or(Role::PLAIN), |lid| lid.1)
    }
}

impl Closure {
    /// All of it is closed, without mending.
    pub fn is_closed(&self) -> bool {
        self.open == 0 && self.mended == 0
    }

    /// Of the version of a mesh with a share of its triangles.
    pub(super) fn new(mesh: &Mesh, ratio: f32) -> Self {
        let lists: Vec<&[[u32; 3]]> = mesh.primitives.iter().map(|p| p.version(ratio).unwrap_or_default()).collect();
        let used = mesh.primitives.iter().zip(&lists).flat_map(|(primitive, list)| {
            list.iter().flatten().map(|corner| primitive.positions[*corner as usize].as_dvec3())
        });
        let mut welder = Welder::new(&Aabb::from_points(used));
        // As the file has them.
        let mut places: Vec<Vec3> = Vec::new();
        let mut triangles: Vec<[u32; 3]> = Vec::with_capacity(lists.iter().map(|list| list.len()).sum());
        for (primitive, list) in mesh.primitives.iter().zip(&lists) {
            let mut welded = vec![u32::MAX; primitive.positions.len()];
            let mut vertex = |corner: u32| {
                let known = &mut welded[corner as usize];
                if *known == u32::MAX {
                    let place = primitive.positions[corner as usize];
                    *known = welder.vertex(place.as_dvec3());
                    places.resize(places.len().max(*known as usize + 1), place);
                }
                *known
            };
            triangles.extend(list.iter().map(|corners| corners.map(&mut vertex)));
        }
        let pieces = Pieces::new(&welder.vertices, &triangles);
        let primitives = enclosing(&lists, &pieces, &places);
        let Pieces { edges, closed, mended, open, unsorted, .. } = pieces;
        Self { edges, closed, mended, open, unsorted, primitives }
    }
}

/// `lists`: the triangles of each primitive.
fn enclosing(lists: &[&[[u32; 3]]], pieces: &Pieces, places: &[Vec3]) -> Vec<Enclosing> {
    let starts = lists.iter().scan(0, |end, list| {
        *end += list.len();
        Some(*end - list.len())
    });
    let ranges: Vec<std::ops::Range<usize>> =
        starts.zip(lists).map(|(start, list)| start..start + list.len()).collect();
    // Of each piece, the first primitive that has some of it.
    let mut firsts: BTreeMap<u32, usize> = BTreeMap::new();
    let mut groups = UnionFind::<usize>::new(lists.len());
    for (primitive, range) in ranges.iter().enumerate() {
        let mut last = None;
        for i in range.clone().filter(|i| pieces.roles[*i].is_closed()) {
            let piece = pieces.numbers[i];
            if last == Some(piece) {
                continue;
            }
            last = Some(piece);
            let first = *firsts.entry(piece).or_insert(primitive);
            groups.union(first, primitive);
        }
    }
    let labels = groups.into_labeling();
    let mut heads = vec![usize::MAX; lists.len()];
    labels.iter().enumerate().for_each(|(primitive, label)| heads[*label] = heads[*label].min(primitive));
    let mut all: Vec<Enclosing> = ranges
        .into_iter()
        .enumerate()
        .map(|(primitive, range)| {
            let roles = &pieces.roles[range.clone()];
            let are_plain = roles.iter().all(|role| *role == Role::PLAIN);
            let roles = if are_plain { Vec::new() } else { roles.to_vec() };
            Enclosing { group: heads[labels[primitive]], roles, lids: Vec::new(), triangles: range.len() }
        })
        .collect();
    for (corners, role, piece) in &pieces.lids {
        if let Some(primitive) = firsts.get(piece) {
            all[*primitive].lids.push((corners.map(|corner| places[corner as usize]), *role));
        }
    }
    all
}

/// What [`Model::closure`] remembers of each version of a mesh, by the bits of its ratio; as [`super::BoundsCache`].
#[derive(Debug, Default)]
pub struct ClosureCache(Mutex<BTreeMap<(usize, u32), Arc<Closure>>>);

impl Clone for ClosureCache {
    /// An empty one: the other model may be changed.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Model {
    /// What a mesh encloses, or the version of it with a share of its triangles; looked for once.
    pub fn closure(&self, mesh: usize, ratio: f32) -> Arc<Closure> {
        let cache = || self.closure_cache.0.lock().unwrap_or_else(PoisonError::into_inner);
        let key = (mesh, ratio.to_bits());
        if let Some(known) = cache().get(&key) {
            return Arc::clone(known);
        }
        // Without the lock: the threads that sort edges may take up other work meanwhile, which asks as well.
        let found = Arc::new(Closure::new(&self.meshes[mesh], ratio));
        cache().entry(key).or_insert(found).clone()
    }
}

#[cfg(test)]
mod tests {
    use rayon::prelude::*;

    use super::super::Primitive;
    use super::*;

    /// A tetrahedron, each triangle with corners of its own, its faces in these primitives.
    fn tetrahedron(primitives: &[&[usize]]) -> Mesh {
        let corners = [Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::Z];
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let primitive = |own: &&[usize]| Primitive {
            positions: own.iter().flat_map(|face| faces[*face].map(|corner| corners[corner])).collect(),
            triangles: (0..own.len() as u32).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            ..Primitive::default()
        };
        Mesh { name: String::new(), primitives: primitives.iter().map(primitive).collect() }
    }

    fn closure(mesh: &Mesh) -> Closure {
        Closure::new(mesh, 1.0)
    }

    fn groups(closure: &Closure) -> Vec<usize> {
        closure.primitives.iter().map(|primitive| primitive.group).collect()
    }

    #[test]
    fn primitives_close_a_mesh_together() {
        let whole = closure(&tetrahedron(&[&[0, 1, 2, 3]]));
        assert_eq!((whole.edges, whole.closed, whole.open), (EdgeCounts { all: 6, ..EdgeCounts::default() }, 1, 0));
        assert!(whole.primitives[0].roles.is_empty(), "nothing is to be said of each triangle");
        let parts = closure(&tetrahedron(&[&[0, 3], &[1, 2]]));
        assert_eq!((parts.closed, groups(&parts)), (1, vec![0, 0]));
        let two = closure(&tetrahedron(&[&[0, 1, 2, 3], &[0, 1, 2, 3]]));
        assert_eq!(groups(&two), [0, 1], "of triangles over the same corners one counts");
    }

    #[test]
    fn a_missing_triangle_opens_its_edges_and_a_turned_one_turns_them() {
        let missing = closure(&tetrahedron(&[&[0, 1, 2]]));
        assert_eq!((missing.edges.all, missing.edges.open, missing.closed, missing.open), (6, 3, 0, 1));
        assert_eq!(missing.primitives[0].role(2), Role::OPEN);
        let mut turned = tetrahedron(&[&[0, 1, 2, 3]]);
        turned.primitives[0].triangles[2].swap(0, 1);
        let turned = closure(&turned);
        assert_eq!((turned.edges.open, turned.edges.turned, turned.closed), (0, 3, 1));
    }

    #[test]
    fn solids_that_touch_in_an_edge_and_zeros_of_either_sign_are_closed() {
        let mut mesh = tetrahedron(&[&[0, 1, 2, 3], &[0, 1, 2, 3]]);
        // The other one turned by half around the x axis, which both have for an edge.
        mesh.primitives[1].positions.iter_mut().for_each(|p| *p = Vec3::new(p.x, -p.y, -p.z));
        let both = closure(&mesh);
        assert_eq!(both.edges, EdgeCounts { all: 11, touching: 1, ..EdgeCounts::default() });
        assert_eq!((both.closed, groups(&both)), (2, vec![0, 1]));
    }

    #[test]
    fn what_is_small_and_far_from_the_origin_is_closed_as_its_rounding_allows() {
        let mut mesh = tetrahedron(&[&[0, 1], &[2, 3]]);
        let far = Vec3::new(4e6, -3e6, 2e5);
        mesh.primitives[0].positions.iter_mut().for_each(|p| *p = *p * 100.0 + far);
        mesh.primitives[1].positions.iter_mut().for_each(|p| *p = *p * 100.0 + far + Vec3::X * 0.25);
        assert!(closure(&mesh).is_closed());
    }

    #[test]
    fn a_small_hole_has_a_lid_of_the_first_primitive() {
        // A strip of 32 sides with two ends, one triangle short.
        let at = |i: u32, y: f32| {
            let angle = i as f32 / 32.0 * std::f32::consts::TAU;
            Vec3::new(angle.cos(), y, angle.sin())
        };
        let tube = |i| vec![at(i, 0.0), at(i, 1.0), at(i + 1, 1.0), at(i, 0.0), at(i + 1, 1.0), at(i + 1, 0.0)];
        let end = |y, i| {
            if y == 0.0 { vec![Vec3::ZERO, at(i, y), at(i + 1, y)] } else { vec![Vec3::Y, at(i + 1, y), at(i, y)] }
        };
        let of = |positions: Vec<Vec3>| Primitive {
            triangles: (0..positions.len() as u32 / 3).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            positions,
            ..Primitive::default()
        };
        let side = of((0..32).flat_map(tube).collect());
        let ends = of((0..32).flat_map(|i| [end(0.0, i), end(1.0, i)]).skip(1).flatten().collect());
        let mended = closure(&Mesh { name: String::new(), primitives: vec![side, ends] });
        assert_eq!((mended.closed, mended.mended, mended.edges.open, groups(&mended)), (1, 1, 3, vec![0, 0]));
        let [side, ends] = &mended.primitives[..] else { panic!("two primitives") };
        assert_eq!((side.lids.len(), ends.lids.len()), (1, 0));
        assert_eq!(side.role(64), side.lids[0].1);
        assert!(side.role(63) == Role::PLAIN && side.lids[0].0.iter().all(|p| p.y == 0.0));
    }

    #[test]
    fn many_threads_may_ask_at_once() {
        let whole = tetrahedron(&[&[0, 1, 2, 3][..]; 20_000]);
        let model = Model { meshes: vec![whole], ..Model::default() };
        let found: Vec<Arc<Closure>> = (0..64).into_par_iter().map(|_| model.closure(0, 1.0)).collect();
        assert!(found.iter().all(|closure| closure.is_closed() && Arc::ptr_eq(closure, &found[0])));
    }

    #[test]
    fn a_triangle_without_area_opens_nothing() {
        let mut mesh = tetrahedron(&[&[0, 1, 2, 3]]);
        mesh.primitives[0].triangles.push([0, 0, 1]);
        assert!(closure(&mesh).is_closed());
    }
}
