//! Whether meshes are closed: only those have an inside that a cut can lay open.

use std::collections::HashMap;
use std::sync::{Arc, Mutex, PoisonError};

use rayon::prelude::*;

use super::{Mesh, Model, Primitive};

/// Where a mesh ends: its edges, once corners at the same place are one.
///
/// An edge is closed if triangles run along it as often one way as the other. So parts may touch in an edge, and of
/// any place it can be said how often the surface winds around it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Closure {
    pub edges: usize,
    /// Edges where the mesh ends, or where triangles are turned against each other.
    pub open_edges: usize,
    /// Of each primitive, whether it is closed by itself.
    pub primitives: Vec<bool>,
}

impl Closure {
    pub fn is_closed(&self) -> bool {
        self.open_edges == 0
    }

    pub(super) fn new(mesh: &Mesh) -> Self {
        let mut places = HashMap::new();
        let runs: Vec<Vec<Run>> = mesh.primitives.iter().map(|primitive| runs(primitive, &mut places)).collect();
        let (edges, open_edges) = count(runs.concat());
        let primitives = runs.into_iter().map(|own| count(own).1 == 0).collect();
        Self { edges, open_edges, primitives }
    }
}

/// A triangle's way along an edge: the edge's ends, the lower first, and whether it starts there.
type Run = ([u32; 2], bool);

fn runs(primitive: &Primitive, places: &mut HashMap<[u32; 3], u32>) -> Vec<Run> {
    let place = |position: &glam::Vec3| {
        let next = places.len() as u32;
        // Zeros of either sign are one place.
        *places.entry((*position + 0.0).to_array().map(f32::to_bits)).or_insert(next)
    };
    let corners: Vec<u32> = primitive.positions.iter().map(place).collect();
    let sides = primitive.triangles.iter().flat_map(|[a, b, c]| [[a, b], [b, c], [c, a]]);
    let sides = sides.map(|ends| ends.map(|corner| corners[*corner as usize])).filter(|[from, to]| from != to);
    sides.map(|[from, to]| ([from.min(to), from.max(to)], from < to)).collect()
}

/// Edges, and those of them that are open.
fn count(mut runs: Vec<Run>) -> (usize, usize) {
    runs.par_sort_unstable();
    let open = |runs: &&[Run]| 2 * runs.iter().filter(|(_, forward)| *forward).count() != runs.len();
    let edges = || runs.chunk_by(|a, b| a.0 == b.0);
    (edges().count(), edges().filter(open).count())
}

/// What [`Model::closure`] remembers of each mesh; as [`super::BoundsCache`].
#[derive(Debug, Default)]
pub struct ClosureCache(Mutex<Vec<Option<Arc<Closure>>>>);

impl Clone for ClosureCache {
    /// An empty one: the other model may be changed.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl Model {
    /// Where a mesh ends, if anywhere; looked for once.
    pub fn closure(&self, mesh: usize) -> Arc<Closure> {
        let cache = || self.closure_cache.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(known) = cache().get(mesh).and_then(Option::clone) {
            return known;
        }
        // Without the lock: the threads that sort edges may take up other work meanwhile, which asks as well.
        let found = Arc::new(Closure::new(&self.meshes[mesh]));
        let mut known = cache();
        let length = self.meshes.len().max(known.len());
        known.resize(length, None);
        known[mesh].get_or_insert(found).clone()
    }
}

#[cfg(test)]
mod tests {
    use glam::Vec3;

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

    #[test]
    fn primitives_close_a_mesh_together() {
        let whole = Closure::new(&tetrahedron(&[&[0, 1, 2, 3]]));
        assert_eq!(whole, Closure { edges: 6, open_edges: 0, primitives: vec![true] });
        let parts = Closure::new(&tetrahedron(&[&[0, 3], &[1, 2]]));
        assert_eq!(parts, Closure { edges: 6, open_edges: 0, primitives: vec![false, false] });
    }

    #[test]
    fn a_missing_or_a_turned_triangle_opens_its_edges() {
        let missing = Closure::new(&tetrahedron(&[&[0, 1, 2]]));
        assert_eq!((missing.edges, missing.open_edges), (6, 3));
        let mut turned = tetrahedron(&[&[0, 1, 2, 3]]);
        turned.primitives[0].triangles[2].swap(0, 1);
        assert_eq!(Closure::new(&turned).open_edges, 3);
    }

    #[test]
    fn solids_that_touch_in_an_edge_and_zeros_of_either_sign_are_closed() {
        let mut mesh = tetrahedron(&[&[0, 1, 2, 3], &[0, 1, 2, 3]]);
        // The other one turned by half around the x axis, which both have for an edge.
        mesh.primitives[1].positions.iter_mut().for_each(|p| *p = Vec3::new(p.x, -p.y, -p.z));
        assert_eq!(Closure::new(&mesh), Closure { edges: 11, open_edges: 0, primitives: vec![true, true] });
    }

    #[test]
    fn many_threads_may_ask_at_once() {
        let whole = tetrahedron(&[&[0, 1, 2, 3][..]; 20_000]);
        let model = Model { meshes: vec![whole], ..Model::default() };
        let found: Vec<Arc<Closure>> = (0..64).into_par_iter().map(|_| model.closure(0)).collect();
        assert!(found.iter().all(|closure| closure.is_closed() && Arc::ptr_eq(closure, &found[0])));
    }

    #[test]
    fn a_triangle_without_area_opens_nothing() {
        let mut mesh = tetrahedron(&[&[0, 1, 2, 3]]);
        mesh.primitives[0].triangles.push([0, 0, 1]);
        assert!(Closure::new(&mesh).is_closed());
    }
}
