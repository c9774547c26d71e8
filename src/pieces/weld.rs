//! Corners that nearly coincide as one.

use std::collections::HashMap;

use glam::{DAffine3, DQuat, DVec3, I64Vec3};

use crate::scene::Aabb;

/// Corners nearer than this are one, as a share of the longest side of what they belong to (SEMANTICS 6.6).
const WELD: f64 = 1e-6;
/// Of the largest coordinate: positions are f32 in a file.
const ROUNDING: f64 = 4.0 * f32::EPSILON as f64;
/// Sides of the grid's cells, in distances within which corners are one: most corners then ask one cell.
const CELL: f64 = 16.0;
const NO_VERTEX: u32 = u32::MAX;

/// Finds vertices by the cells of a grid.
#[derive(Debug)]
pub struct Welder {
    /// In the cube from -1 to 1.
    pub vertices: Vec<DVec3>,
    center: DVec3,
    half: f64,
    distance: f64,
    /// Of each cell, its last vertex; and of each vertex, the one before it in its cell.
    cells: HashMap<I64Vec3, u32>,
    before: Vec<u32>,
}

impl Welder {
    /// For points in these bounds, as files have them. The longest side of the bounds fills the cube.
    pub fn new(bounds: &Aabb) -> Self {
        let half = (0.5 * bounds.size().max_element()).max(f64::MIN_POSITIVE);
        let largest = bounds.min.abs().max(bounds.max.abs()).max_element() / half;
        let distance = (2.0 * WELD).max(ROUNDING * largest);
        let (cells, before) = Default::default();
        Self { vertices: Vec::new(), center: bounds.center(), half, distance, cells, before }
    }

    /// From the cube to where the points are.
    pub fn pose(&self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(DVec3::splat(self.half), DQuat::IDENTITY, self.center)
    }

    fn cell(&self, p: DVec3) -> I64Vec3 {
        (p / (CELL * self.distance)).floor().as_i64vec3()
    }

    /// The vertex at a point, new if there is none near enough.
    pub fn vertex(&mut self, point: DVec3) -> u32 {
        let p = (point - self.center) / self.half;
        let (low, high) = (self.cell(p - self.distance), self.cell(p + self.distance));
        for x in low.x..=high.x {
            for y in low.y..=high.y {
                for z in low.z..=high.z {
                    let mut next = self.cells.get(&I64Vec3::new(x, y, z)).copied().unwrap_or(NO_VERTEX);
                    while next != NO_VERTEX {
                        if self.vertices[next as usize].distance(p) <= self.distance {
                            return next;
                        }
                        next = self.before[next as usize];
                    }
                }
            }
        }
        let vertex = self.vertices.len() as u32;
        self.vertices.push(p);
        self.before.push(self.cells.insert(self.cell(p), vertex).unwrap_or(NO_VERTEX));
        vertex
    }
}
