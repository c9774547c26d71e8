//! Triangles in a bounding volume hierarchy.

use std::time::Duration;

use glam::{DVec3, Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::{Bvh2, builder::build_bvh2};

use super::line::{LineCrossing, ShearedLine};
use super::nearest::nearest_on_triangle;

/// Triangles in the cube from -1 to 1, in the order of the leaves of a hierarchy.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleTree {
    pub vertices: Vec<DVec3>,
    pub triangles: Vec<[u32; 3]>,
    /// Of each, which it was of those that the tree is made of.
    pub numbers: Vec<u32>,
    pub nodes: Vec<MeshNode>,
}

/// A node of the bounding volume hierarchy. They stand in depth-first order: the first child follows its parent, and
/// what follows a leaf is the next node to look at. So one walk from the front visits all that a line may meet.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct MeshNode {
    pub min: [f32; 3],
    /// Of a leaf its first triangle; of an inner node the node to go on with where its box is missed.
    pub first: u32,
    pub max: [f32; 3],
    /// Triangles; 0 for an inner node.
    pub count: u32,
}

/// Boxes are larger by this, so that rounding in the box test loses no triangle.
const PADDING: f32 = 1e-6;

struct Bounds(obvhs::aabb::Aabb);

impl obvhs::Boundable for Bounds {
    fn aabb(&self) -> obvhs::aabb::Aabb {
        self.0
    }
}

impl TriangleTree {
    pub fn new(vertices: Vec<DVec3>, triangles: &[[u32; 3]]) -> Self {
        let bounds = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| vertices[i as usize].as_vec3());
            let (min, max) = (a.min(b).min(c) - PADDING, a.max(b).max(c) + PADDING);
            Bounds(obvhs::aabb::Aabb { min: Vec3A::from(min), max: Vec3A::from(max) })
        };
        let boxes: Vec<Bounds> = triangles.iter().map(bounds).collect();
        let mut tree = Self { vertices, triangles: Vec::new(), numbers: Vec::new(), nodes: Vec::new() };
        if !boxes.is_empty() {
            let bvh = build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Duration::default());
            tree.flatten(&bvh, 0);
        }
        tree.triangles = tree.numbers.iter().map(|number| triangles[*number as usize]).collect();
        tree
    }

    fn flatten(&mut self, bvh: &Bvh2, index: usize) {
        let node = &bvh.nodes[index];
        let at = self.nodes.len();
        self.nodes.push(MeshNode {
            min: Vec3::from(node.aabb().min).to_array(),
            first: self.numbers.len() as u32,
            max: Vec3::from(node.aabb().max).to_array(),
            count: node.prim_count,
        });
        let first = node.first_index as usize;
        if node.is_leaf() {
            self.numbers.extend_from_slice(&bvh.primitive_indices[first..first + node.prim_count as usize]);
        } else {
            self.flatten(bvh, first);
            self.flatten(bvh, first + 1);
            self.nodes[at].first = self.nodes.len() as u32;
        }
    }

    /// Visits the triangles of all leaves that `meets` does not rule out, with the boxes above them.
    pub fn visit(&self, mut meets: impl FnMut(&MeshNode) -> bool, mut triangle: impl FnMut(u32, [DVec3; 3])) {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let met = meets(node);
            if met {
                (node.first..node.first + node.count).for_each(|face| triangle(face, self.corners(face)));
            }
            at = if met || node.count > 0 { at + 1 } else { node.first as usize };
        }
    }

    /// The point of the triangles nearest to `p`, and its triangle.
    pub fn nearest(&self, p: DVec3) -> Option<(DVec3, u32)> {
        let best = std::cell::Cell::new((f64::INFINITY, None));
        self.visit(
            |node| node.distance_squared(p) < best.get().0,
            |face, corners| {
                let q = nearest_on_triangle(p, corners);
                if q.distance_squared(p) < best.get().0 {
                    best.set((q.distance_squared(p), Some((q, face))));
                }
            },
        );
        best.get().1
    }

    pub fn corners(&self, face: u32) -> [DVec3; 3] {
        self.triangles[face as usize].map(|i| self.vertices[i as usize])
    }

    /// Tells of every crossing of the whole line, in no order: the triangle, and where and how it is crossed.
    pub fn cross(&self, origin: DVec3, direction: DVec3, mut tell: impl FnMut(u32, LineCrossing)) {
        // Measured from the point of the line nearest to the middle, so that a far origin costs no precision.
        let shift = -origin.dot(direction) / direction.length_squared();
        let origin = origin + direction * shift;
        let line = ShearedLine::new(origin, direction);
        self.visit(
            |node| node.is_met(origin, direction),
            |face, corners| {
                if let Some(crossing) = line.crossing(corners) {
                    tell(face, LineCrossing { t: crossing.t + shift, ..crossing });
                }
            },
        );
    }
}

impl MeshNode {
    fn ends(&self) -> (DVec3, DVec3) {
        (Vec3::from_array(self.min).as_dvec3(), Vec3::from_array(self.max).as_dvec3())
    }

    /// Whether a line meets the box.
    fn is_met(&self, origin: DVec3, direction: DVec3) -> bool {
        let (min, max) = self.ends();
        let (mut from, mut to) = (f64::NEG_INFINITY, f64::INFINITY);
        for axis in 0..3 {
            let (low, high) = (min[axis] - origin[axis], max[axis] - origin[axis]);
            if direction[axis] != 0.0 {
                let (a, b) = (low / direction[axis], high / direction[axis]);
                (from, to) = (from.max(a.min(b)), to.min(a.max(b)));
            } else if low > 0.0 || high < 0.0 {
                return false;
            }
        }
        from <= to
    }

    /// How far the box reaches along a direction.
    pub fn farthest(&self, direction: DVec3) -> f64 {
        let (min, max) = self.ends();
        (direction * min).max(direction * max).element_sum()
    }

    /// From a point to the box.
    fn distance_squared(&self, p: DVec3) -> f64 {
        let (min, max) = self.ends();
        p.distance_squared(p.clamp(min, max))
    }
}
