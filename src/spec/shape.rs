//! Lens shapes as written.

use std::path::PathBuf;

use super::At;

#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Rotation {
    /// Degrees, intrinsic X then Y then Z.
    Euler([f64; 3]),
    /// `[x, y, z, w]`, of any length but zero.
    Quaternion([f64; 4]),
}

impl Default for Rotation {
    fn default() -> Self {
        Rotation::Euler([0.0; 3])
    }
}

/// A lens volume in its own space. Sizes are positive and finite.
#[derive(Debug, Clone, PartialEq)]
pub enum Shape {
    Sphere {
        center: [f64; 3],
        radius: f64,
    },
    Ellipsoid {
        center: [f64; 3],
        radii: [f64; 3],
        rotation: Rotation,
    },
    Box {
        center: [f64; 3],
        size: [f64; 3],
        rotation: Rotation,
    },
    Cylinder {
        from: [f64; 3],
        to: [f64; 3],
        radius: f64,
    },
    /// At most one radius is zero.
    Cone {
        from: [f64; 3],
        to: [f64; 3],
        from_radius: f64,
        to_radius: f64,
    },
    Capsule {
        from: [f64; 3],
        to: [f64; 3],
        radius: f64,
    },
    /// `[nx, ny, nz, d]`: the points with `n·p <= d` for all.
    Polytope {
        planes: Vec<[f64; 4]>,
    },
    Hull {
        points: Vec<[f64; 3]>,
    },
    /// All that `normal` points away from, without an end.
    HalfSpace {
        point: [f64; 3],
        normal: [f64; 3],
    },
    /// Between two planes across `normal`; `point` lies midway.
    Slab {
        point: [f64; 3],
        normal: [f64; 3],
        thickness: f64,
    },
    Flat {
        corners: Vec<[f64; 3]>,
        depth: Option<f64>,
    },
    Mesh(MeshShape),
    /// Lists have at least one entry; a list of one is that shape.
    Union(Vec<At<Shape>>),
    Intersection(Vec<At<Shape>>),
    /// The first less the others.
    Difference(Vec<At<Shape>>),
}

impl Shape {
    /// Whether it goes on for ever as a half-space does: such a lens has no glass unless that is asked for.
    pub fn is_half_space(&self) -> bool {
        match self {
            Shape::HalfSpace { .. } => true,
            Shape::Union(list) => list.iter().any(|part| part.value.is_half_space()),
            Shape::Intersection(list) => list.iter().all(|part| part.value.is_half_space()),
            Shape::Difference(list) => list.first().is_some_and(|part| part.value.is_half_space()),
            _ => false,
        }
    }
}

impl At<Shape> {
    /// The shapes that are no compounds, in the order of the file; of such a shape, itself.
    pub fn parts(&self) -> Vec<&At<Shape>> {
        match &self.value {
            Shape::Union(list) | Shape::Intersection(list) | Shape::Difference(list) => {
                list.iter().flat_map(|shape| shape.parts()).collect()
            }
            _ => vec![self],
        }
    }
}

/// A mesh of a glTF file as a volume.
#[derive(Debug, Clone, PartialEq)]
pub struct MeshShape {
    /// Resolved against the spec file's folder.
    pub file: At<PathBuf>,
    /// With its descendants; `None`: all that the file's default scene shows.
    pub node: Option<At<String>>,
    pub convex: Convex,
}

/// What is made of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Convex {
    /// It must be convex as it stands.
    AsItStands,
    /// The convex hull of its vertices.
    Hull,
    /// Any closed mesh, with its hollows and holes.
    Decompose,
}
