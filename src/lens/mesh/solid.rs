//! A closed triangle mesh as a solid.

use std::time::Duration;

use glam::{DVec3, Vec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::bvh2::{Bvh2, builder::build_bvh2};

use super::line::ShearedLine;
use super::nearest::nearest_on_triangle;
use crate::lens::{Crossing, Plane, Span};

/// A closed triangle mesh in the cube from -1 to 1. A point is inside where a line from it crosses the surface an odd
/// number of times, so that triangles may be turned either way and hollows may be meshed in any order.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshSolid {
    pub vertices: Vec<DVec3>,
    /// In the order of the leaves of `nodes`.
    pub triangles: Vec<[u32; 3]>,
    pub nodes: Vec<MeshNode>,
    /// It is known to be its own convex hull.
    pub is_convex: bool,
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
/// Twice the area up to which a triangle makes no plane.
const SLIVER: f64 = 4e-14;
/// Runs along no symmetry that a mesh is likely to have.
const ANYWHERE: DVec3 = DVec3::new(0.527_348, 0.331_907, 0.782_154);

struct Bounds(obvhs::aabb::Aabb);

impl obvhs::Boundable for Bounds {
    fn aabb(&self) -> obvhs::aabb::Aabb {
        self.0
    }
}

impl MeshSolid {
    /// From a surface that is closed: an even number of triangles meets at every edge.
    pub fn new(vertices: Vec<DVec3>, triangles: &[[u32; 3]]) -> Self {
        let bounds = |triangle: &[u32; 3]| {
            let [a, b, c] = triangle.map(|i| vertices[i as usize].as_vec3());
            let (min, max) = (a.min(b).min(c) - PADDING, a.max(b).max(c) + PADDING);
            Bounds(obvhs::aabb::Aabb { min: Vec3A::from(min), max: Vec3A::from(max) })
        };
        let boxes: Vec<Bounds> = triangles.iter().map(bounds).collect();
        let mut solid =
            Self { vertices, triangles: Vec::with_capacity(triangles.len()), nodes: Vec::new(), is_convex: false };
        if !boxes.is_empty() {
            let bvh = build_bvh2(&boxes, BvhBuildParams::medium_build(), &mut Duration::default());
            solid.flatten(&bvh, 0, triangles);
        }
        solid
    }

    fn flatten(&mut self, bvh: &Bvh2, index: usize, triangles: &[[u32; 3]]) {
        let node = &bvh.nodes[index];
        let at = self.nodes.len();
        self.nodes.push(MeshNode {
            min: Vec3::from(node.aabb().min).to_array(),
            first: self.triangles.len() as u32,
            max: Vec3::from(node.aabb().max).to_array(),
            count: node.prim_count,
        });
        let first = node.first_index as usize;
        if node.is_leaf() {
            let own = &bvh.primitive_indices[first..first + node.prim_count as usize];
            self.triangles.extend(own.iter().map(|i| triangles[*i as usize]));
        } else {
            self.flatten(bvh, first, triangles);
            self.flatten(bvh, first + 1, triangles);
            self.nodes[at].first = self.nodes.len() as u32;
        }
    }

    /// Visits the triangles of all leaves that `meets` does not rule out, with the boxes above them.
    fn visit(&self, mut meets: impl FnMut(&MeshNode) -> bool, mut triangle: impl FnMut(u32, [DVec3; 3])) {
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            let met = meets(node);
            if met {
                (node.first..node.first + node.count).for_each(|face| triangle(face, self.corners(face)));
            }
            at = if met || node.count > 0 { at + 1 } else { node.first as usize };
        }
    }

    fn corners(&self, face: u32) -> [DVec3; 3] {
        self.triangles[face as usize].map(|i| self.vertices[i as usize])
    }

    /// Tells of every crossing of the whole line, in no order.
    fn cross(&self, origin: DVec3, direction: DVec3, mut tell: impl FnMut(Crossing)) {
        // Measured from the point of the line nearest to the middle, so that a far origin costs no precision.
        let shift = -origin.dot(direction) / direction.length_squared();
        let origin = origin + direction * shift;
        let line = ShearedLine::new(origin, direction);
        self.visit(
            |node| node.is_met(origin, direction),
            |face, corners| {
                if let Some(t) = line.crossing(corners) {
                    tell(Crossing { t: t + shift, face });
                }
            },
        );
    }

    /// Appends what a line has inside, nearest first.
    pub fn spans(&self, origin: DVec3, direction: DVec3, out: &mut Vec<Span>) {
        let first = out.len();
        // Crossings first, each as a span without a length, then pairs of them in their place.
        self.cross(origin, direction, |crossing| out.push(Span { entry: crossing, exit: crossing }));
        out[first..].sort_unstable_by(|a, b| a.entry.t.total_cmp(&b.entry.t).then(a.entry.face.cmp(&b.entry.face)));
        let mut end = first;
        for pair in 0..(out.len() - first) / 2 {
            let span = Span { entry: out[first + 2 * pair].entry, exit: out[first + 2 * pair + 1].entry };
            if span.exit.t > span.entry.t {
                out[end] = span;
                end += 1;
            }
        }
        out.truncate(end);
    }

    pub fn contains(&self, p: DVec3) -> bool {
        let mut inside = false;
        if p.abs().max_element() <= 1.0 {
            self.cross(p, ANYWHERE, |crossing| inside ^= crossing.t > 0.0);
        }
        inside
    }

    /// The point of the surface nearest to `p`.
    pub fn nearest(&self, p: DVec3) -> DVec3 {
        let best = std::cell::Cell::new((f64::INFINITY, p));
        self.visit(
            |node| node.distance_squared(p) < best.get().0,
            |_, corners| {
                let q = nearest_on_triangle(p, corners);
                if q.distance_squared(p) < best.get().0 {
                    best.set((q.distance_squared(p), q));
                }
            },
        );
        best.get().1
    }

    /// The planes of its triangles, if it is convex; `None` in place of one with hardly an area.
    pub fn planes(&self) -> impl Iterator<Item = Option<Plane>> + '_ {
        let middle = self.vertices.iter().sum::<DVec3>() / self.vertices.len().max(1) as f64;
        (0..self.triangles.len() as u32).map(move |face| {
            let (normal, corner) = (self.normal(face), self.corners(face)[0]);
            let outward = if normal.dot(corner - middle) < 0.0 { -normal } else { normal };
            // A sliver says little of its plane, which must cut nothing off. The mesh is about 2 long.
            (normal.length() > SLIVER).then(|| {
                let plane = Plane::through(outward, corner);
                let offset = self.vertices.iter().map(|p| plane.normal.dot(*p)).fold(plane.offset, f64::max);
                Plane { offset, ..plane }
            })
        })
    }

    /// A normal of a triangle, of any length, on the side from which its corners run anticlockwise.
    pub fn normal(&self, face: u32) -> DVec3 {
        let [a, b, c] = self.corners(face);
        (b - a).cross(c - a)
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

    /// From a point to the box.
    fn distance_squared(&self, p: DVec3) -> f64 {
        let (min, max) = self.ends();
        p.distance_squared(p.clamp(min, max))
    }
}
