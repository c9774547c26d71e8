//! Lids over small holes, so that rays which pass one count as others do.

use glam::DVec3;

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
    // Corners of one hole.
    let mut parents: Vec<u32> = if borders.is_empty() { Vec::new() } else { (0..vertices.len() as u32).collect() };
    for Border { ends: [a, b], .. } in borders {
        let (a, b) = (find(&mut parents, *a), find(&mut parents, *b));
        parents[a.max(b) as usize] = a.min(b);
    }
    for Border { piece, ends, net } in borders {
        let [a, b] = if *net > 0 { *ends } else { [ends[1], ends[0]] };
        let apex = find(&mut parents, a);
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

fn find(parents: &mut [u32], mut at: u32) -> u32 {
    while parents[at as usize] != at {
        parents[at as usize] = parents[parents[at as usize] as usize];
        at = parents[at as usize];
    }
    at
}
