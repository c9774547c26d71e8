//! From pairs of triangles that coincide to planes and ranks.

use glam::DVec3;
use petgraph::unionfind::UnionFind;

use super::face::Face;
use super::{Coincident, Part, Plane, Shared};

/// No more can be told apart by the steps of a depth.
const MOST_RANKS: u32 = 4096;
/// Corners lie this near to the plane that they share, in their tolerance.
const SPREAD: f64 = 4.0;
/// Of several planes of one group so many are tried.
const LAST_PLANES: usize = 8;

/// `pairs`: of numbers of triangles, sorted.
pub fn grouped(parts: &[Part], pairs: Vec<(u32, u32)>) -> Coincident {
    let mut found = Coincident { parts: vec![Vec::new(); parts.len()], ..Coincident::default() };
    let mut numbers: Vec<u32> = pairs.iter().flat_map(|(low, high)| [*low, *high]).collect();
    numbers.sort_unstable();
    numbers.dedup();
    let place = |number: u32| numbers.partition_point(|known| *known < number);
    let mut groups = UnionFind::<u32>::new(numbers.len());
    let mut ranks = vec![0u32; numbers.len()];
    // By the lower one: its own rank is known when it is asked for.
    for (low, high) in &pairs {
        let (low, high) = (place(*low), place(*high));
        groups.union(low as u32, high as u32);
        ranks[high] = ranks[high].max(ranks[low] + 1).min(MOST_RANKS);
    }
    let mut members: Vec<(u32, usize)> = groups.into_labeling().into_iter().zip(0..).collect();
    members.sort_unstable();
    let part_of = |member: usize| parts.partition_point(|part| part.first_triangle <= numbers[member]) - 1;
    for group in members.chunk_by(|a, b| a.0 == b.0) {
        let face = |(_, member): &(u32, usize)| {
            let part = &parts[part_of(*member)];
            part.face(numbers[*member] - part.first_triangle, DVec3::ZERO)
        };
        let faces: Vec<Face> = group.iter().map(face).collect();
        for ((_, member), plane) in group.iter().zip(planes(&faces, &mut found.planes)) {
            let part = part_of(*member);
            let triangle = numbers[*member] - parts[part].first_triangle;
            found.parts[part].push(Shared { triangle, plane, rank: ranks[*member] });
        }
    }
    found.parts.iter_mut().for_each(|part| part.sort_unstable_by_key(|shared| shared.triangle));
    found
}

/// The plane of each face of a group: one for all, if one is near enough to all. Its number among all planes.
fn planes(faces: &[Face], all: &mut Vec<Plane>) -> Vec<u32> {
    let tolerance = SPREAD * faces.iter().map(|face| face.tolerance).fold(0.0, f64::max);
    let first = all.len();
    let mut plane_of = |faces: &mut dyn Iterator<Item = &Face>| {
        all.push(mean(faces));
        all.len() - 1
    };
    let common = plane_of(&mut faces.iter());
    if faces.iter().all(|face| face.lies_in(&all[common], tolerance)) {
        return vec![common as u32; faces.len()];
    }
    // They lead from one plane to another: each gets one that it lies in, the largest first.
    all.truncate(first);
    let mut order: Vec<usize> = (0..faces.len()).collect();
    order.sort_by(|a, b| faces[*b].area.total_cmp(&faces[*a].area));
    let mut chosen = vec![0; faces.len()];
    for number in order {
        let last = first.max(all.len().saturating_sub(LAST_PLANES));
        let known = (last..all.len()).find(|plane| faces[number].lies_in(&all[*plane], tolerance));
        chosen[number] = known.unwrap_or_else(|| {
            all.push(mean(&mut std::iter::once(&faces[number])));
            all.len() - 1
        }) as u32;
    }
    chosen
}

/// By area.
fn mean(faces: &mut dyn Iterator<Item = &Face>) -> Plane {
    let (mut normal, mut center, mut area) = (DVec3::ZERO, DVec3::ZERO, 0.0);
    for face in faces {
        // Either side may be out.
        let side = if face.normal.dot(normal) < 0.0 { -face.area } else { face.area };
        normal += face.normal * side;
        center += face.center() * face.area;
        area += face.area;
    }
    let normal = normal.normalize_or_zero();
    Plane { normal, offset: normal.dot(center / area) }
}

impl Face {
    fn lies_in(&self, plane: &Plane, tolerance: f64) -> bool {
        self.corners.iter().all(|p| (plane.normal.dot(*p) - plane.offset).abs() <= tolerance)
    }
}
