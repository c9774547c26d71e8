//! A closed triangle mesh as a solid.

use glam::DVec3;

use super::line::LineCrossing;
use super::tree::TriangleTree;
use crate::lens::{Crossing, Plane, Span};
use crate::pieces::{Around, Pieces, Role};

/// A closed triangle mesh in the cube from -1 to 1. What its pieces enclose is inside: where they overlap they unite, and
/// one inside another that faces the other way is a hole.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshSolid {
    pub tree: TriangleTree,
    /// Of each triangle of the tree, which are turned to face as their pieces do.
    pub roles: Vec<Role>,
    /// It is known to be its own convex hull.
    pub is_convex: bool,
}

/// Twice the area up to which a triangle makes no plane.
const SLIVER: f64 = 4e-14;
/// Runs along no symmetry that a mesh is likely to have.
const ANYWHERE: DVec3 = DVec3::new(0.527_348, 0.331_907, 0.782_154);

impl MeshSolid {
    /// From a closed surface whose corners at one place are one vertex.
    pub fn new(vertices: Vec<DVec3>, triangles: &[[u32; 3]]) -> Self {
        let roles = Pieces::new(&vertices, triangles).roles;
        Self::with_roles(vertices, triangles, &roles)
    }

    /// The same where the role of each triangle is known.
    pub(in crate::lens) fn with_roles(vertices: Vec<DVec3>, triangles: &[[u32; 3]], roles: &[Role]) -> Self {
        let counted = |(_, role): &(&[u32; 3], &Role)| role.is_closed();
        let (triangles, roles): (Vec<[u32; 3]>, Vec<Role>) =
            triangles.iter().zip(roles).filter(counted).map(|(corners, role)| (*corners, *role)).unzip();
        let mut tree = TriangleTree::new(vertices, &triangles);
        let mut roles: Vec<Role> = tree.numbers.iter().map(|number| roles[*number as usize]).collect();
        for (corners, role) in tree.triangles.iter_mut().zip(&mut roles).filter(|(_, role)| role.is_turned()) {
            corners.swap(1, 2);
            *role = Role::PLAIN;
        }
        Self { tree, roles, is_convex: false }
    }

    /// Whether some of its pieces are told by parity.
    pub fn is_by_parity(&self) -> bool {
        self.roles.iter().any(|role| *role != Role::PLAIN)
    }

    /// Appends what a line has inside, nearest first.
    pub fn spans(&self, origin: DVec3, direction: DVec3, out: &mut Vec<Span>) {
        let first = out.len();
        // Crossings first, each as a span without a length, then what lies between them in their place. Of the face an
        // exit keeps for a while which way it is crossed.
        self.tree.cross(origin, direction, |face, LineCrossing { t, turns_left }| {
            let turn = u32::from(turns_left);
            out.push(Span { entry: Crossing { t, face }, exit: Crossing { t, face: turn } });
        });
        out[first..].sort_unstable_by(|a, b| a.entry.t.total_cmp(&b.entry.t).then(a.entry.face.cmp(&b.entry.face)));
        let (mut end, mut around) = (first, Around::default());
        let mut entry: Option<Crossing> = None;
        for i in first..out.len() {
            let Span { entry: crossing, exit: Crossing { face: turn, .. } } = out[i];
            around.cross(self.roles[crossing.face as usize], turn == 1);
            match (entry, around.is_inside()) {
                (None, true) => entry = Some(crossing),
                (Some(from), false) => {
                    entry = None;
                    if crossing.t > from.t {
                        out[end] = Span { entry: from, exit: crossing };
                        end += 1;
                    }
                }
                _ => {}
            }
        }
        out.truncate(end);
    }

    pub fn contains(&self, p: DVec3) -> bool {
        let mut around = Around::default();
        if p.abs().max_element() <= 1.0 {
            self.tree.cross(p, ANYWHERE, |face, LineCrossing { t, turns_left }| {
                if t > 0.0 {
                    around.cross(self.roles[face as usize], turns_left);
                }
            });
        }
        around.is_inside()
    }

    /// The point of the surface nearest to `p`.
    pub fn nearest(&self, p: DVec3) -> DVec3 {
        self.tree.nearest(p).map_or(p, |(q, _)| q)
    }

    /// The planes of its triangles, if it is convex; `None` in place of one with hardly an area.
    pub fn planes(&self) -> impl Iterator<Item = Option<Plane>> + '_ {
        let middle = self.tree.vertices.iter().sum::<DVec3>() / self.tree.vertices.len().max(1) as f64;
        (0..self.tree.triangles.len() as u32).map(move |face| {
            let (normal, corner) = (self.normal(face), self.tree.corners(face)[0]);
            let outward = if normal.dot(corner - middle) < 0.0 { -normal } else { normal };
            // A sliver says little of its plane, which must cut nothing off. The mesh is about 2 long.
            (normal.length() > SLIVER).then(|| {
                let plane = Plane::through(outward, corner);
                let offset = self.tree.vertices.iter().map(|p| plane.normal.dot(*p)).fold(plane.offset, f64::max);
                Plane { offset, ..plane }
            })
        })
    }

    /// A normal of a triangle, of any length, on the side from which its corners run anticlockwise.
    pub fn normal(&self, face: u32) -> DVec3 {
        let [a, b, c] = self.tree.corners(face);
        (b - a).cross(c - a)
    }
}
