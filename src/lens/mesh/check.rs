//! Whether a surface is closed, and whether it is convex.

use std::collections::BTreeMap;

use glam::DVec3;
use rayon::prelude::*;

use super::{MeshSolid, Surface};
use crate::InputError;
use crate::pieces::Pieces;

/// How far inside its convex hull the surface of a convex mesh may lie, as a share of its longest side.
const DENT: f64 = 1e-4;
/// Up to so many triangles the deepest dent is looked for.
const LARGE: usize = 65_536;

/// Refuses a surface that ends somewhere: an odd number of triangles meets there.
pub fn is_closed(surface: &Surface, pieces: &Pieces) -> Result<(), InputError> {
    if pieces.are_closed() {
        return Ok(());
    }
    let edges = edges(surface);
    let open: Vec<_> = edges.iter().filter(|(_, triangles)| *triangles % 2 == 1).collect();
    let Some((ends, triangles)) = open.first() else { return Ok(()) };
    let [p, q] = ends.map(|i| point(surface, surface.vertices[i as usize]));
    let message = format!(
        "{} is not closed: {} of its {} edges have an odd number of triangles; the edge from {p} to {q} has {triangles}",
        surface.name,
        open.len(),
        edges.len()
    );
    Err(InputError::new(message).help("close the mesh, or take its convex hull with convex = \"hull\""))
}

/// How many triangles meet at each edge, which is named by its vertices, the lower first.
fn edges(surface: &Surface) -> BTreeMap<[u32; 2], usize> {
    let mut edges = BTreeMap::new();
    for [a, b, c] in &surface.triangles {
        for (p, q) in [(a, b), (b, c), (c, a)] {
            *edges.entry([*p.min(q), *p.max(q)]).or_default() += 1;
        }
    }
    edges
}

/// Whether no corner lies in front of any triangle's plane, but for a dent that is allowed. A walk down the hierarchy for
/// each triangle ends at the boxes behind its plane: of a convex mesh that are all but those beside the triangle.
pub fn is_convex_by_planes(solid: &MeshSolid) -> bool {
    let tree = &solid.tree;
    let middle = tree.vertices.iter().sum::<DVec3>() / tree.vertices.len().max(1) as f64;
    let volume: f64 = (0..tree.triangles.len() as u32)
        .map(|face| {
            let [a, b, c] = tree.corners(face).map(|p| p - middle);
            a.dot(b.cross(c))
        })
        .sum();
    !solid.is_by_parity()
        && (0..tree.triangles.len() as u32).into_par_iter().all(|face| {
            let Some(normal) = (solid.normal(face) * volume.signum()).try_normalize() else { return true };
            let offset = normal.dot(tree.corners(face)[0]) + 2.0 * DENT;
            let mut is_behind = true;
            let met = std::cell::Cell::new(true);
            tree.visit(
                |node| met.get() && node.farthest(normal) > offset,
                |_, corners| {
                    is_behind &= corners.iter().all(|p| normal.dot(*p) <= offset);
                    met.set(is_behind);
                },
            );
            is_behind
        })
}

/// Refuses a surface that is not its own convex hull. `depth` tells how far inside the hull a point is.
pub fn is_convex(surface: &Surface, depth: impl Fn(DVec3) -> f64) -> Result<(), InputError> {
    let at = |i: &u32| surface.vertices[*i as usize];
    let corners = surface.vertices.iter().copied();
    let edges = edges(surface).into_keys().map(|ends| ends.iter().map(at).sum::<DVec3>() / 2.0);
    let faces = surface.triangles.iter().map(|corners| corners.iter().map(at).sum::<DVec3>() / 3.0);
    let depths = corners.chain(edges).chain(faces).map(|p| (depth(p), p));
    // The longest side of the surface is 2.
    let allowed = 2.0 * DENT;
    // Of a large surface the first that is too deep, rather than the deepest: each takes its time.
    let mut too_deep = depths.filter(|(depth, _)| *depth > allowed);
    let is_large = surface.triangles.len() > LARGE;
    let deepest = if is_large { too_deep.next() } else { too_deep.max_by(|a, b| a.0.total_cmp(&b.0)) };
    let Some((depth, p)) = deepest else { return Ok(()) };
    let unit = surface.pose.matrix3.x_axis.x;
    let message = format!(
        "{} is not convex: at {} its surface lies {} inside its convex hull, and {} is allowed",
        surface.name,
        point(surface, p),
        rounded(depth * unit, 3),
        rounded(allowed * unit, 1)
    );
    Err(InputError::new(message)
        .help("write convex = \"decompose\" for the mesh's own shape, or convex = \"hull\" for its convex hull"))
}

/// A point in the file's space, as messages write it.
fn point(surface: &Surface, p: DVec3) -> String {
    let [x, y, z] = surface.pose.transform_point3(p).to_array().map(|x| rounded(x, 6));
    format!("({x}, {y}, {z})")
}

/// To so many digits that count.
fn rounded(x: f64, digits: usize) -> f64 {
    format!("{x:.*e}", digits - 1).parse().unwrap_or(x)
}
