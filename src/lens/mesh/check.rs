//! Whether a surface is closed, and whether it is convex.

use std::collections::BTreeMap;

use glam::DVec3;

use super::Surface;
use crate::InputError;

/// How far inside its convex hull the surface of a convex mesh may lie, as a share of its longest side.
const DENT: f64 = 1e-4;

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

/// Refuses a surface with an edge that its number of triangles does not close.
pub fn is_closed(surface: &Surface, closes: impl Fn(usize) -> bool) -> Result<(), InputError> {
    let edges = edges(surface);
    let open: Vec<_> = edges.iter().filter(|(_, triangles)| !closes(**triangles)).collect();
    let Some((ends, triangles)) = open.first() else { return Ok(()) };
    let [p, q] = ends.map(|i| point(surface, surface.vertices[i as usize]));
    let message = format!(
        "{} is not closed: {} of its {} edges do not join two triangles; {triangles} meet at the edge from {p} to {q}",
        surface.name,
        open.len(),
        edges.len()
    );
    Err(InputError::new(message).help("close the mesh, or take its convex hull with convex = \"hull\""))
}

/// Refuses a surface that is not its own convex hull. `depth` tells how far inside the hull a point is.
pub fn is_convex(surface: &Surface, depth: impl Fn(DVec3) -> f64) -> Result<(), InputError> {
    let at = |i: &u32| surface.vertices[*i as usize];
    let corners = surface.vertices.iter().copied();
    let edges = edges(surface).into_keys().map(|ends| ends.iter().map(at).sum::<DVec3>() / 2.0);
    let faces = surface.triangles.iter().map(|corners| corners.iter().map(at).sum::<DVec3>() / 3.0);
    let depths = corners.chain(edges).chain(faces).map(|p| (depth(p), p));
    let deepest = depths.max_by(|a, b| a.0.total_cmp(&b.0));
    // The longest side of the surface is 2.
    let allowed = 2.0 * DENT;
    let Some((depth, p)) = deepest.filter(|(depth, _)| *depth > allowed) else { return Ok(()) };
    let unit = surface.pose.matrix3.x_axis.x;
    let message = format!(
        "{} is not convex: at {} its surface lies {:.3} inside its convex hull, and {:.1e} is allowed",
        surface.name,
        point(surface, p),
        depth * unit,
        allowed * unit
    );
    Err(InputError::new(message)
        .help("write convex = \"decompose\" for the mesh's own shape, or convex = \"hull\" for its convex hull"))
}

/// A point in the file's space, as messages write it.
fn point(surface: &Surface, p: DVec3) -> String {
    let p = surface.pose.transform_point3(p).as_vec3();
    format!("({}, {}, {})", p.x, p.y, p.z)
}
