//! Triangles that lie over each other in one plane: which of them is seen must not be left to rounding (SEMANTICS 6.3).
//!
//! They are given one plane, by which both backends find their depth, and a rank in it. Planes that agree are found by
//! hashing them with room for rounding, and what overlaps among them by a hierarchy where there are many; so a scene
//! without such triangles pays for a pass over its triangles and a sort, once a pose. Triangles, pairs and what is
//! kept at once are bounded; where that leaves something out the plan says so.

mod candidates;
mod cells;
mod face;
mod group;

use std::sync::{Arc, Mutex, PoisonError};

use glam::{DAffine3, DVec3, Vec3};

use face::Face;

/// What is drawn of a node, with the number of its first triangle among all: lower ones are in front.
#[derive(Debug, Clone, Copy)]
pub struct Part<'a> {
    /// Parts with the same place are versions of one primitive, or one thing twice: they never hide each other.
    pub place: [usize; 3],
    pub world_from_local: DAffine3,
    pub positions: &'a [Vec3],
    pub triangles: &'a [[u32; 3]],
    pub first_triangle: u32,
}

/// A plane in the world: the points with `normal·p = offset`; the normal has unit length.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Plane {
    pub normal: DVec3,
    pub offset: f64,
}

/// A triangle that shares its plane with others that lie over it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Shared {
    /// Into its part's triangles.
    pub triangle: u32,
    /// Into [`Coincident::planes`].
    pub plane: u32,
    /// More than that of each triangle in front of it.
    pub rank: u32,
}

/// The triangles of some parts that coincide with others.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Coincident {
    /// Of each part, by rising triangle.
    pub parts: Vec<Vec<Shared>>,
    pub planes: Vec<Plane>,
    /// There are more triangles, or more of them lie over each other, than are looked at.
    pub is_partial: bool,
}

impl Coincident {
    /// `parts`: by rising first triangle.
    pub fn new(parts: &[Part]) -> Self {
        let (pairs, is_whole) = candidates::pairs(parts);
        Self { is_partial: !is_whole, ..group::grouped(parts, pairs) }
    }

    pub fn is_empty(&self) -> bool {
        self.planes.is_empty()
    }

    /// Of a triangle of a part; `None` where it shares its plane with nothing.
    pub fn shared(&self, part: usize, triangle: u32) -> Option<&Shared> {
        let list = &self.parts[part];
        list.binary_search_by_key(&triangle, |shared| shared.triangle).ok().map(|at| &list[at])
    }
}

impl Part<'_> {
    fn face(&self, triangle: u32, origin: DVec3) -> Face {
        let local = self.triangles[triangle as usize].map(|corner| self.positions[corner as usize].as_dvec3());
        Face::new(local, &self.world_from_local, origin)
    }
}

/// By what a part is known: its place, its version, and where it stands.
type Known = ([usize; 3], u32, usize, DAffine3);

/// What has been found last, as long as nothing has moved; as [`super::BoundsCache`].
#[derive(Debug, Default)]
pub struct CoincidentCache(Mutex<Option<(Vec<Known>, Arc<Coincident>)>>);

impl Clone for CoincidentCache {
    /// An empty one: the other scene may be changed.
    fn clone(&self) -> Self {
        Self::default()
    }
}

impl CoincidentCache {
    pub fn get(&self, parts: &[Part]) -> Arc<Coincident> {
        let known = |part: &Part| (part.place, part.first_triangle, part.triangles.len(), part.world_from_local);
        let asked: Vec<Known> = parts.iter().map(known).collect();
        let cache = || self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some((_, found)) = cache().as_ref().filter(|(known, _)| *known == asked) {
            return found.clone();
        }
        // Without the lock, see `Model::closure`.
        let found = Arc::new(Coincident::new(parts));
        *cache() = Some((asked, found.clone()));
        found
    }
}

#[cfg(test)]
mod tests {
    use glam::DQuat;

    use super::*;

    /// A square from -1 to 1 in z = 0, of so many quads along each side.
    fn square(quads: u32) -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let side = quads + 1;
        let at = |i: u32| 2.0 * i as f32 / quads as f32 - 1.0;
        let positions = (0..side * side).map(|i| Vec3::new(at(i % side), at(i / side), 0.0)).collect();
        let corners = (0..quads * quads).map(|i| i / quads * side + i % quads);
        let triangles = corners.flat_map(|i| [[i, i + 1, i + side], [i + 1, i + side + 1, i + side]]).collect();
        (positions, triangles)
    }

    type Mesh = (Vec<Vec3>, Vec<[u32; 3]>);

    fn found(meshes: &[(&Mesh, DAffine3)]) -> Coincident {
        let mut first_triangle = 0;
        let parts: Vec<Part> = meshes
            .iter()
            .enumerate()
            .map(|(place, ((positions, triangles), world_from_local))| {
                let world_from_local = *world_from_local;
                let part = Part { place: [0, place, 0], world_from_local, positions, triangles, first_triangle };
                first_triangle += triangles.len() as u32;
                part
            })
            .collect();
        Coincident::new(&parts)
    }

    fn turned(angle: f64) -> DAffine3 {
        let tilt = DQuat::from_xyzw(0.21, 0.34, 0.11, 0.910_054_943).normalize();
        DAffine3::from_quat(tilt * DQuat::from_rotation_z(angle))
    }

    #[test]
    fn differently_triangulated_faces_share_one_plane_and_the_lower_is_in_front() {
        let (coarse, fine) = (square(1), square(6));
        let found = found(&[(&coarse, turned(0.0)), (&fine, turned(0.7))]);
        assert_eq!(found.planes.len(), 1);
        assert_eq!(found.parts[0].len(), 2);
        assert!(found.parts[1].len() > 60, "all but those beyond the coarse one's corners: {}", found.parts[1].len());
        assert!(found.parts[0].iter().all(|shared| shared.rank == 0));
        assert!(found.parts[1].iter().all(|shared| shared.rank == 1));
        let inside = turned(0.0).transform_point3(DVec3::new(0.3, 0.4, 0.0));
        assert!((found.planes[0].normal.dot(inside) - found.planes[0].offset).abs() < 1e-7);
    }

    #[test]
    fn copies_a_float_step_apart_coincide_and_what_is_apart_does_not() {
        let square = square(2);
        let shifted = |by: f64| turned(0.0) * DAffine3::from_translation(DVec3::Z * by);
        assert!(!found(&[(&square, shifted(0.0)), (&square, shifted(1.2e-7))]).is_empty());
        assert!(found(&[(&square, shifted(0.0)), (&square, shifted(1e-4))]).is_empty());
        let tilted = turned(0.0) * DAffine3::from_rotation_x(1e-3);
        assert!(found(&[(&square, turned(0.0)), (&square, tilted)]).is_empty());
    }

    #[test]
    fn neighbours_in_one_plane_are_no_matter() {
        let fine = square(40);
        let beside = turned(0.0) * DAffine3::from_translation(DVec3::X * 2.0);
        assert!(found(&[(&fine, turned(0.0)), (&fine, beside)]).is_empty());
        let halfway = turned(0.0) * DAffine3::from_translation(DVec3::X);
        assert!(!found(&[(&fine, turned(0.0)), (&fine, halfway)]).is_empty());
    }

    #[test]
    fn a_stack_of_copies_is_ranked_in_its_order() {
        let square = square(1);
        let found = found(&[(&square, turned(0.0)), (&square, turned(0.1)), (&square, turned(0.2))]);
        let ranks = found.parts.iter().map(|part| part[0].rank).collect::<Vec<_>>();
        assert_eq!((found.planes.len(), ranks), (1, vec![0, 1, 2]));
    }

    #[test]
    fn far_from_the_origin_and_at_any_size() {
        let (coarse, fine) = (square(1), square(5));
        for (scale, away) in [(1.0, 1e7), (1e-6, 0.0), (1e6, 0.0), (1.0, -3e5)] {
            let place = DAffine3::from_translation(DVec3::splat(away)) * DAffine3::from_scale(DVec3::splat(scale));
            let found = found(&[(&coarse, place * turned(0.0)), (&fine, place * turned(0.7))]);
            assert_eq!((found.planes.len(), found.parts[0].len()), (1, 2), "{scale} {away}");
        }
    }

    #[test]
    fn very_many_copies_take_no_time() {
        let square = square(1);
        let copies = vec![(&square, turned(0.0)); 3000];
        let found = found(&copies);
        assert!(found.parts.iter().all(|part| part.len() == 2));
        assert!(found.parts.windows(2).all(|pair| pair[0][0].rank <= pair[1][0].rank));
    }
}
