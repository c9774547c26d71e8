//! Which parts of a triangle surface enclose something: the notion of a closed solid, for caps and for mesh lenses alike
//! (SEMANTICS 6.6).
//!
//! Corners that nearly coincide are one ([`Welder`]). Triangles that meet two at an edge make a patch, and are turned to
//! face one way; patches that end together in other edges make a piece. A piece is closed if an even number of its
//! triangles meets at every edge. Whether a point is inside is told along any ray from it ([`Around`]): by how often the
//! closed pieces wind around it, and by parity for a piece that cannot be turned to face one way.

mod holes;
mod nesting;
mod patches;
mod weld;

use glam::DVec3;

pub use weld::Welder;

use patches::Patches;

/// Parity is told apart for so many pieces; where more of them overlap, it is exclusive or.
const SLOTS: u32 = 32;

/// How rays count a triangle. Twin of `shaders/gpu/roles.wgsl`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, bytemuck::Pod, bytemuck::Zeroable)]
#[repr(transparent)]
pub struct Role(u8);

impl Role {
    /// Of a piece that faces one way, as its corners run.
    pub const PLAIN: Role = Role(0);
    /// Its piece encloses nothing.
    pub const OPEN: Role = Role(63 << 1);

    /// Of a piece that faces one way; `turned`: against the corners' order.
    fn winding(turned: bool) -> Self {
        Self(u8::from(turned))
    }

    /// Of the n-th of the pieces that are told by parity.
    fn parity(number: u32) -> Self {
        Self((1 + (number % SLOTS) as u8) << 1)
    }

    fn faces_one_way(self) -> bool {
        self.slot() == 0
    }

    /// Of the same piece, turned round.
    fn turned(self) -> Self {
        Self(self.0 ^ 1)
    }

    /// Whether its piece encloses something.
    pub fn is_closed(self) -> bool {
        self != Self::OPEN
    }

    /// 0 for a piece that faces one way, else one more than the slot by which its parity is told.
    pub fn slot(self) -> u32 {
        u32::from(self.0 >> 1)
    }

    /// Whether its piece faces against its corners' order.
    pub fn is_turned(self) -> bool {
        self.0 & 1 != 0
    }

    pub fn bits(self) -> u8 {
        self.0
    }
}

/// What lies around a point, by the crossings of a ray from it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Around {
    winding: i32,
    /// Bit i: the ray crosses the pieces of slot i an odd number of times.
    odd: u32,
}

impl Around {
    /// The ray crosses a triangle; `turns_left`: its corners run to the left as the ray sees them.
    pub fn cross(&mut self, role: Role, turns_left: bool) {
        match role.slot() {
            0 => self.winding += if turns_left == role.is_turned() { -1 } else { 1 },
            slot if role.is_closed() => self.odd ^= 1 << (slot - 1),
            _ => {}
        }
    }

    pub fn is_inside(&self) -> bool {
        self.winding != 0 || self.odd != 0
    }
}

/// The edges of a surface, once corners at the same place are one.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct EdgeCounts {
    pub all: usize,
    /// Of one triangle: the surface ends there.
    pub open: usize,
    /// Of two that face different ways.
    pub turned: usize,
    /// Of more than two.
    pub touching: usize,
}

/// The pieces of a surface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Pieces {
    pub edges: EdgeCounts,
    /// Pieces that enclose something, those with holes that are closed over among them.
    pub closed: usize,
    /// Pieces with holes that are closed over.
    pub mended: usize,
    /// Pieces that enclose nothing.
    pub open: usize,
    /// Closed pieces of which it is not known whether they are holes in others: too much would have to be looked at.
    pub unsorted: usize,
    /// Of each triangle, its piece.
    pub numbers: Vec<u32>,
    /// Of each triangle.
    pub roles: Vec<Role>,
    /// Triangles that close holes over: corners, role, piece.
    pub lids: Vec<([u32; 3], Role, u32)>,
}

impl Pieces {
    /// Of a surface in the cube from -1 to 1, over welded vertices; triangles may have coinciding corners.
    pub fn new(vertices: &[DVec3], triangles: &[[u32; 3]]) -> Self {
        let mut patches = Patches::new(vertices, triangles);
        let borders = patches.join();
        let lids = holes::lids(vertices, &patches, &borders);
        let mended: Vec<bool> = lids.iter().map(|lid| !lid.is_empty()).collect();
        let count = patches.pieces.len();
        let is_closed = |piece: usize| {
            let own = &patches.pieces[piece];
            !own.is_empty && (!own.is_open || mended[piece])
        };
        let mut number = 0;
        // Of each piece, that of its triangles that are not turned.
        let roles: Vec<Role> = (0..count)
            .map(|piece| match &patches.pieces[piece] {
                _ if !is_closed(piece) => Role::OPEN,
                own if own.is_by_parity => {
                    number += 1;
                    Role::parity(number - 1)
                }
                _ => Role::PLAIN,
            })
            .collect();
        let role = |piece: u32, turned: bool| match roles[piece as usize] {
            Role::PLAIN => Role::winding(turned),
            other => other,
        };
        let of_triangle = |i: usize| role(patches.numbers[i], patches.turned[i]);
        let lids = lids.into_iter().enumerate().flat_map(|(piece, corners)| {
            let role = roles[piece];
            corners.into_iter().map(move |corners| (corners, role, piece as u32))
        });
        let closed = (0..count).filter(|piece| is_closed(*piece)).count();
        let mut pieces = Self {
            edges: patches.edges,
            closed,
            mended: mended.iter().filter(|is| **is).count(),
            open: (0..count).filter(|piece| !is_closed(*piece) && !patches.pieces[*piece].is_empty).count(),
            unsorted: 0,
            roles: (0..triangles.len()).map(of_triangle).collect(),
            lids: lids.collect(),
            numbers: patches.numbers,
        };
        nesting::turn(vertices, triangles, &mut pieces);
        pieces
    }

    /// Every piece is closed, without mending.
    pub fn are_closed(&self) -> bool {
        self.open == 0 && self.mended == 0
    }
}

#[cfg(test)]
mod tests;
