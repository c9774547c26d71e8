//! Lids over small holes, so that rays which pass one count as others do.

use glam::DVec3;
use petgraph::unionfind::UnionFind;

use super::patches::{Border, Patches, area};

/// A piece is closed over its holes where their lids have so large a share of its own area at the most: more is no hole in a
/// solid but a sheet. A box without one of its six sides is closed, a bowl and a tube without ends are not.
const LARGEST_SHARE: f64 = 0.25;

/// Of each piece, the triangles that close its holes over; none where it has none, or too large ones.
///
/// A hole's lid is a fan from one of its corners: with it every edge is run along as often one way as the other,
/// whatever shape the hole has.
pub fn lids(vertices: &[DVec3], patches: &Patches, borders: &[Border]) -> Vec<Vec<[u32; 3]>> {
    let mut lids: Vec<Vec<[u32; 3]>> = vec![Vec::new(); patches.pieces.len()];
    if borders.is_empty() {
        return lids;
    }
    let mut holes = UnionFind::<u32>::new(vertices.len());
    borders.iter().for_each(|Border { ends: [a, b], .. }| _ = holes.union(*a, *b));
    let holes = holes.into_labeling();
    // Of each hole, its first corner.
    let mut firsts = vec![u32::MAX; vertices.len()];
    (0u32..).zip(&holes).for_each(|(vertex, hole)| firsts[*hole as usize] = firsts[*hole as usize].min(vertex));
    for Border { piece, ends, net } in borders {
        let [a, b] = if *net > 0 { *ends } else { [ends[1], ends[0]] };
        let apex = firsts[holes[a as usize] as usize];
        if apex != a && apex != b {
            lids[*piece as usize].extend(std::iter::repeat_n([apex, b, a], net.unsigned_abs() as usize));
        }
    }
    for (own, piece) in lids.iter_mut().zip(&patches.pieces) {
        if own.iter().map(|lid| area(vertices, lid)).sum::<f64>() > LARGEST_SHARE * piece.area {
            own.clear();
        }
    }
    lids
}
