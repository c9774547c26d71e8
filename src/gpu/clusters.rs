//! A primitive's triangles in an order in which neighbours in space stand together, cut into clusters: what a lens shows
//! or changes is then drawn without the rest of its mesh.

use std::time::Duration;

use glam::{Vec3, Vec3A};
use obvhs::bvh2::{Bvh2, builder::build_bvh2};
use obvhs::{Boundable, BvhBuildParams};

use crate::scene::Aabb;

/// So many triangles at the most: few enough to follow a lens's outline, enough to keep draws few.
const MOST: u32 = 512;

/// Consecutive triangles, in the order of [`Clustered::order`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Cluster {
    pub first: u32,
    pub count: u32,
    /// In the node's local space.
    pub bounds: Aabb,
}

/// The triangles of a primitive in their new order.
#[derive(Debug, Clone, PartialEq)]
pub struct Clustered {
    /// The number that each triangle has in the primitive.
    pub order: Vec<u32>,
    pub clusters: Vec<Cluster>,
}

impl Clustered {
    pub fn new(positions: &[Vec3], triangles: &[[u32; 3]]) -> Self {
        let count = triangles.len() as u32;
        let bounds = |own: &[u32]| bounds(positions, own.iter().map(|triangle| triangles[*triangle as usize]));
        let mut order: Vec<u32> = (0..count).collect();
        if count <= MOST {
            let clusters = (count > 0).then(|| Cluster { first: 0, count, bounds: bounds(&order) });
            return Self { order, clusters: clusters.into_iter().collect() };
        }
        let boxes: Vec<Boxed> = triangles.iter().map(|corners| Boxed::new(positions, corners)).collect();
        let bvh = build_bvh2(&boxes, BvhBuildParams::fastest_build(), &mut Duration::default());
        drop(boxes);
        let mut clusters = Vec::new();
        order.clear();
        // At one depth the lower number is in front, and what is drawn first.
        let mut lists: Vec<Vec<u32>> = roots(&bvh).into_iter().map(|node| leaves(&bvh, node)).collect();
        lists.sort_unstable_by_key(|list| list[0]);
        for own in lists {
            let first = order.len() as u32;
            clusters.push(Cluster { first, count: own.len() as u32, bounds: bounds(&own) });
            order.extend(own);
        }
        Self { order, clusters }
    }
}

fn bounds(positions: &[Vec3], triangles: impl Iterator<Item = [u32; 3]>) -> Aabb {
    Aabb::from_points(triangles.flatten().map(|corner| positions[corner as usize].as_dvec3()))
}

/// The largest subtrees without too many triangles.
fn roots(bvh: &Bvh2) -> Vec<u32> {
    let mut counts = vec![0u32; bvh.nodes.len()];
    // Children before their parents.
    let (mut down, mut order) = (vec![0u32], Vec::with_capacity(bvh.nodes.len()));
    while let Some(node) = down.pop() {
        order.push(node);
        down.extend(children(bvh, node));
    }
    for node in order.iter().rev() {
        let own = &bvh.nodes[*node as usize];
        let below: u32 = children(bvh, *node).map(|child| counts[child as usize]).sum();
        counts[*node as usize] = if own.is_leaf() { own.prim_count } else { below };
    }
    let (mut found, mut rest) = (Vec::new(), vec![0u32]);
    while let Some(node) = rest.pop() {
        if counts[node as usize] <= MOST || bvh.nodes[node as usize].is_leaf() {
            found.push(node);
        } else {
            rest.extend(children(bvh, node));
        }
    }
    found
}

/// The triangles below a node, in their old order.
fn leaves(bvh: &Bvh2, root: u32) -> Vec<u32> {
    let (mut out, mut rest) = (Vec::new(), vec![root]);
    while let Some(node) = rest.pop() {
        let own = &bvh.nodes[node as usize];
        if own.is_leaf() {
            let first = own.first_index as usize;
            out.extend_from_slice(&bvh.primitive_indices[first..first + own.prim_count as usize]);
        }
        rest.extend(children(bvh, node));
    }
    out.sort_unstable();
    out
}

fn children(bvh: &Bvh2, node: u32) -> impl Iterator<Item = u32> + use<> {
    let own = &bvh.nodes[node as usize];
    let first = own.first_index;
    (0..if own.is_leaf() { 0 } else { 2 }).map(move |i| first + i)
}

/// The bounds of a triangle.
struct Boxed(obvhs::aabb::Aabb);

impl Boxed {
    fn new(positions: &[Vec3], corners: &[u32; 3]) -> Self {
        let [a, b, c] = corners.map(|corner| Vec3A::from(positions[corner as usize]));
        Self(obvhs::aabb::Aabb { min: a.min(b).min(c), max: a.max(b).max(c) })
    }
}

impl Boundable for Boxed {
    fn aabb(&self) -> obvhs::aabb::Aabb {
        self.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Corners and triangles of a square of 64 x 64 quads, row by row.
    fn grid() -> (Vec<Vec3>, Vec<[u32; 3]>) {
        let corner = |x: u32, y: u32| y * 65 + x;
        let quad = |(x, y)| {
            let [a, b, c, d] = [corner(x, y), corner(x + 1, y), corner(x, y + 1), corner(x + 1, y + 1)];
            [[a, b, d], [a, d, c]]
        };
        let positions = (0..65 * 65).map(|i| Vec3::new((i % 65) as f32, (i / 65) as f32, 0.0)).collect();
        (positions, (0..64).flat_map(|y| (0..64).map(move |x| (x, y))).flat_map(quad).collect())
    }

    #[test]
    fn every_triangle_stands_in_one_small_cluster() {
        let (positions, triangles) = grid();
        let Clustered { order, clusters } = Clustered::new(&positions, &triangles);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..8192));
        let mut next = 0;
        for cluster in &clusters {
            assert_eq!(cluster.first, next);
            next += cluster.count;
            let own = &order[cluster.first as usize..next as usize];
            assert!(cluster.count <= MOST && own.is_sorted());
            let own = own.iter().map(|triangle| triangles[*triangle as usize]);
            assert_eq!(cluster.bounds, bounds(&positions, own));
        }
        assert_eq!(next, 8192);
        // Rows would be 64 wide.
        let widths: f64 = clusters.iter().map(|cluster| cluster.bounds.size().max_element()).sum();
        assert!(widths / (clusters.len() as f64) < 40.0, "{widths} over {}", clusters.len());
    }

    #[test]
    fn few_triangles_stay_as_they_are() {
        let Clustered { order, clusters } = Clustered::new(&grid().0, &[[0, 1, 66], [1, 2, 67]]);
        assert_eq!((order, clusters.len(), clusters[0].count), (vec![0, 1], 1, 2));
        assert!(Clustered::new(&[], &[]).clusters.is_empty());
    }

    #[test]
    fn triangles_that_lie_on_each_other_stay_together() {
        let (positions, triangles) = grid();
        let twice: Vec<[u32; 3]> = triangles.iter().flat_map(|triangle| [*triangle; 2]).collect();
        let Clustered { order, clusters } = Clustered::new(&positions, &twice);
        let mut cluster_of = vec![0; order.len()];
        for (number, cluster) in clusters.iter().enumerate() {
            let own = &order[cluster.first as usize..(cluster.first + cluster.count) as usize];
            own.iter().for_each(|triangle| cluster_of[*triangle as usize] = number);
        }
        assert!(cluster_of.chunks_exact(2).all(|pair| pair[0] == pair[1]));
    }
}
