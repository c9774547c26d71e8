//! Which pieces are holes in others: those that lie wholly inside larger ones and face the other way. All others are solid,
//! whichever way they face.

use glam::DVec3;

use super::{Pieces, Role};
use crate::lens::TriangleTree;

/// Runs along no symmetry that a surface is likely to have.
const ANYWHERE: DVec3 = DVec3::new(0.391_287, 0.817_213, 0.423_119);
/// How far towards its middle a piece is asked where it lies, beside its outermost corners.
const INWARDS: f64 = 1e-3;
/// So many crossings are looked at; pieces that are left then stay as they face ([`Pieces::unsorted`]).
const MOST_CROSSINGS: usize = 1 << 26;

/// A closed piece that faces one way.
struct Solid {
    piece: u32,
    /// Six times its volume, positive where it faces outwards.
    volume: f64,
    /// The corners that lie lowest and highest along each axis.
    outermost: [DVec3; 6],
}

/// Turns pieces so that solids face outwards and holes inwards.
pub fn turn(vertices: &[DVec3], triangles: &[[u32; 3]], pieces: &mut Pieces) {
    let own = triangles.iter().zip(&pieces.roles).zip(&pieces.numbers);
    let own = own.map(|((corners, role), piece)| (*corners, *role, *piece));
    let counted: Vec<([u32; 3], Role, u32)> =
        own.chain(pieces.lids.iter().copied()).filter(|(_, role, _)| role.faces_one_way()).collect();
    let mut solids = solids(vertices, &counted);
    // Where all face one way there is no hole, and it makes no difference which.
    if solids.iter().all(|solid| solid.volume >= 0.0) || solids.iter().all(|solid| solid.volume <= 0.0) {
        return;
    }
    solids.sort_by(|a, b| b.volume.abs().total_cmp(&a.volume.abs()).then(a.piece.cmp(&b.piece)));
    let (turned, sorted) = Nesting::new(vertices, &counted, &solids).turned(MOST_CROSSINGS);
    pieces.unsorted = solids.len() - sorted;
    let of_triangles = pieces.roles.iter_mut().zip(&pieces.numbers);
    let all = of_triangles.chain(pieces.lids.iter_mut().map(|(_, role, piece)| (role, &*piece)));
    for (role, piece) in all.filter(|(role, _)| role.faces_one_way()) {
        if turned[*piece as usize] {
            *role = role.turned();
        }
    }
}

fn solids(vertices: &[DVec3], counted: &[([u32; 3], Role, u32)]) -> Vec<Solid> {
    let mut places = vec![u32::MAX; counted.iter().map(|(.., piece)| *piece as usize + 1).max().unwrap_or(0)];
    let mut solids: Vec<Solid> = Vec::new();
    for (corners, role, piece) in counted {
        let corners = corners.map(|i| vertices[i as usize]);
        let place = &mut places[*piece as usize];
        if *place == u32::MAX {
            *place = solids.len() as u32;
            solids.push(Solid { piece: *piece, volume: 0.0, outermost: [corners[0]; 6] });
        }
        let solid = &mut solids[*place as usize];
        // Measured from one of its own corners: it may be small and far off.
        let [a, b, c] = corners.map(|p| p - solid.outermost[0]);
        let volume = a.dot(b.cross(c));
        solid.volume += if *role == Role::PLAIN { volume } else { -volume };
        for (i, p) in corners.into_iter().flat_map(|p| (0..6).map(move |i| (i, p))) {
            let along = |p: DVec3| if i < 3 { p[i] } else { -p[i - 3] };
            if i != 0 && along(p) < along(solid.outermost[i]) {
                solid.outermost[i] = p;
            }
        }
    }
    solids
}

/// Pieces in each other, the largest first.
struct Nesting<'a> {
    solids: &'a [Solid],
    counted: &'a [([u32; 3], Role, u32)],
    tree: TriangleTree,
    /// Of each piece, its place among the solids.
    places: Vec<u32>,
}

/// What larger pieces wind around a point, as they face and as they are turned.
#[derive(Default)]
struct Larger {
    as_they_face: i32,
    as_turned: i32,
    crossings: usize,
}

impl<'a> Nesting<'a> {
    fn new(vertices: &[DVec3], counted: &'a [([u32; 3], Role, u32)], solids: &'a [Solid]) -> Self {
        let corners: Vec<[u32; 3]> = counted.iter().map(|(corners, ..)| *corners).collect();
        let mut places = vec![0; solids.iter().map(|solid| solid.piece as usize + 1).max().unwrap_or(0)];
        (0u32..).zip(solids).for_each(|(place, solid)| places[solid.piece as usize] = place);
        Self { solids, counted, tree: TriangleTree::new(vertices.to_vec(), &corners), places }
    }

    /// Of each piece, whether it is to be turned round; and of how many that is known, by so many crossings.
    fn turned(&self, most: usize) -> (Vec<bool>, usize) {
        let mut turned = vec![false; self.places.len()];
        let mut left = most;
        for (sorted, solid) in self.solids.iter().enumerate() {
            let Some(asked) = self.hole_in(solid, &turned, &mut left) else { return (turned, sorted) };
            let faces_outwards = solid.volume > 0.0;
            turned[solid.piece as usize] = match asked {
                Some(around) => (around > 0) == faces_outwards,
                None => !faces_outwards,
            };
        }
        (turned, self.solids.len())
    }

    /// How often what it is a hole in winds around it, if it is one. `None` where too much has been looked at.
    fn hole_in(&self, solid: &Solid, turned: &[bool], left: &mut usize) -> Option<Option<i32>> {
        let middle = solid.outermost.iter().sum::<DVec3>() / 6.0;
        let mut around = 0;
        for corner in &solid.outermost {
            let larger = self.larger(corner.lerp(middle, INWARDS), solid, turned);
            *left = left.checked_sub(larger.crossings)?;
            let faces_it = larger.as_they_face != 0 && (larger.as_they_face > 0) != (solid.volume > 0.0);
            if !faces_it || larger.as_turned == 0 {
                return Some(None);
            }
            around = larger.as_turned;
        }
        Some(Some(around))
    }

    fn larger(&self, p: DVec3, solid: &Solid, turned: &[bool]) -> Larger {
        let mut larger = Larger::default();
        let place = self.places[solid.piece as usize];
        self.tree.cross(p, ANYWHERE, |face, crossing| {
            larger.crossings += 1;
            let (_, role, piece) = self.counted[self.tree.numbers[face as usize] as usize];
            if crossing.t > 0.0 && self.places[piece as usize] < place {
                // From inside, what faces outwards is seen from behind.
                let winding = if crossing.turns_left == (role == Role::PLAIN) { -1 } else { 1 };
                larger.as_they_face += winding;
                larger.as_turned += if turned[piece as usize] { -winding } else { winding };
            }
        });
        larger
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pieces::Pieces;

    #[test]
    fn what_is_left_when_too_much_has_been_looked_at_is_counted() {
        // Two tetrahedra, one in the other, which faces inwards.
        let corner =
            |size: f64| [[0.0; 3], [size, 0.0, 0.0], [0.0, size, 0.0], [0.0, 0.0, size]].map(DVec3::from_array);
        let vertices: Vec<DVec3> = corner(0.8).into_iter().chain(corner(0.1).map(|p| p + DVec3::splat(0.05))).collect();
        let faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]];
        let inner = faces.map(|[a, b, c]: [u32; 3]| [a + 4, c + 4, b + 4]);
        let triangles: Vec<[u32; 3]> = faces.into_iter().chain(inner).collect();
        let pieces = Pieces::new(&vertices, &triangles);
        assert_eq!((pieces.closed, pieces.unsorted), (2, 0));
        let counted: Vec<([u32; 3], Role, u32)> =
            triangles.iter().zip(&pieces.numbers).map(|(corners, piece)| (*corners, Role::PLAIN, *piece)).collect();
        let mut solids = solids(&vertices, &counted);
        solids.sort_by(|a, b| b.volume.abs().total_cmp(&a.volume.abs()));
        let nesting = Nesting::new(&vertices, &counted, &solids);
        assert_eq!(nesting.turned(1000).1, 2);
        assert_eq!(nesting.turned(0).1, 0);
    }
}
