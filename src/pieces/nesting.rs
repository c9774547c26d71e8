//! Which pieces are holes in others: those that lie wholly inside larger ones and face the other way. All others are solid,
//! whichever way they face.

use glam::DVec3;

use super::{Pieces, Role};
use crate::lens::TriangleTree;

/// Runs along no symmetry that a surface is likely to have.
const ANYWHERE: DVec3 = DVec3::new(0.391_287, 0.817_213, 0.423_119);
/// How far towards its middle a piece is asked where it lies, beside its outermost corners.
const INWARDS: f64 = 1e-3;
/// So many crossings are looked at; pieces that are left then stay as they face.
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
    let turned = Nesting::new(vertices, &counted, &solids).turned();
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

    /// Of each piece, whether it is to be turned round.
    fn turned(&self) -> Vec<bool> {
        let mut turned = vec![false; self.places.len()];
        let mut crossings = 0;
        for solid in self.solids {
            let Some(asked) = self.hole_in(solid, &turned, &mut crossings) else { break };
            let faces_outwards = solid.volume > 0.0;
            turned[solid.piece as usize] = match asked {
                Some(around) => (around > 0) == faces_outwards,
                None => !faces_outwards,
            };
        }
        turned
    }

    /// How often what it is a hole in winds around it, if it is one. `None` where too much has been looked at.
    fn hole_in(&self, solid: &Solid, turned: &[bool], crossings: &mut usize) -> Option<Option<i32>> {
        let middle = solid.outermost.iter().sum::<DVec3>() / 6.0;
        let mut around = 0;
        for corner in &solid.outermost {
            let larger = self.larger(corner.lerp(middle, INWARDS), solid, turned);
            *crossings += larger.crossings;
            if *crossings > MOST_CROSSINGS {
                return None;
            }
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
