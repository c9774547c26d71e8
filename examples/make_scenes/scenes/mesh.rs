//! Triangle meshes and their shading normals.

use glam::{DMat3, DVec2, DVec3, DVec4};

use super::det;

/// An indexed triangle mesh. All but the triangles are empty or as long as `positions`.
#[derive(Debug, Clone, Default)]
pub struct Mesh {
    pub positions: Vec<DVec3>,
    pub normals: Vec<DVec3>,
    /// With the sign of the bitangent.
    pub tangents: Vec<DVec4>,
    pub uv: Vec<DVec2>,
    /// Linear light and alpha.
    pub colors: Vec<[u8; 4]>,
    pub temperatures: Vec<[f32; 1]>,
    pub triangles: Vec<[u32; 3]>,
}

impl Mesh {
    /// Moves every vertex by a rotation and then a translation.
    pub fn moved(mut self, rotation: DMat3, translation: DVec3) -> Self {
        self.positions.iter_mut().for_each(|p| *p = rotation * *p + translation);
        self.normals.iter_mut().for_each(|n| *n = rotation * *n);
        self
    }

    /// Turns a solid built around +z so that its axis becomes +y.
    pub fn upright(self) -> Self {
        self.moved(DMat3::from_cols(DVec3::X, DVec3::NEG_Z, DVec3::Y), DVec3::ZERO)
    }

    /// Appends another mesh with the same attributes.
    pub fn join(&mut self, other: Mesh) {
        let first = self.positions.len() as u32;
        self.positions.extend(other.positions);
        self.normals.extend(other.normals);
        self.uv.extend(other.uv);
        self.colors.extend(other.colors);
        self.temperatures.extend(other.temperatures);
        self.triangles.extend(other.triangles.iter().map(|t| t.map(|i| i + first)));
    }

    /// Area-weighted normals that are smooth across edges up to `crease` degrees and split at sharper ones. With a
    /// crease above a bevel's angle, flat faces stay flat and the bevel looks round.
    pub fn shaded(self, crease: f64) -> Self {
        let least_dot = det::cos(det::radians(crease));
        let faces: Vec<DVec3> = self.triangles.iter().map(|t| self.face(*t)).collect();
        let mut around = vec![Vec::new(); self.positions.len()];
        for (face, triangle) in self.triangles.iter().enumerate() {
            triangle.iter().for_each(|v| around[*v as usize].push(face));
        }
        let mut out = Mesh::default();
        let mut copies: Vec<Vec<u32>> = vec![Vec::new(); self.positions.len()];
        for (face, triangle) in self.triangles.iter().enumerate() {
            let own = faces[face].normalize_or_zero();
            let corners = triangle.map(|v| {
                let near = around[v as usize].iter().map(|f| faces[*f]);
                let sum: DVec3 = near.filter(|f| f.normalize_or_zero().dot(own) >= least_dot).sum();
                out.corner(self.positions[v as usize], sum.normalize_or(own), &mut copies[v as usize])
            });
            out.triangles.push(corners);
        }
        out
    }

    /// Twice the area times the normal.
    fn face(&self, triangle: [u32; 3]) -> DVec3 {
        let [a, b, c] = triangle.map(|i| self.positions[i as usize]);
        (b - a).cross(c - a)
    }

    /// The copy of a vertex with this normal, new if there is none yet.
    fn corner(&mut self, position: DVec3, normal: DVec3, copies: &mut Vec<u32>) -> u32 {
        if let Some(same) = copies.iter().find(|i| self.normals[**i as usize].dot(normal) > 0.9999) {
            return *same;
        }
        let index = self.positions.len() as u32;
        self.positions.push(position);
        self.normals.push(normal);
        copies.push(index);
        index
    }
}
