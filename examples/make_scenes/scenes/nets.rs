//! Polygonises a signed distance function: naive surface nets (Gibson 1998), vertices pulled onto the surface.

use glam::{DVec3, dvec3};

use super::mesh::Mesh;

/// Samples of the distance on a grid of cubes.
struct Grid {
    min: DVec3,
    cell: f64,
    /// Samples along x, y, z.
    size: [usize; 3],
    distance: Vec<f64>,
}

/// The closed surface where `distance` is zero, with normals along its gradient. It must lie within the bounds.
pub fn surface(min: DVec3, max: DVec3, cell: f64, distance: impl Fn(DVec3) -> f64) -> Mesh {
    let size = ((max - min) / cell).ceil().to_array().map(|n| n as usize + 1);
    let mut grid = Grid { min, cell, size, distance: Vec::new() };
    grid.distance = (0..size[0] * size[1] * size[2]).map(|i| distance(grid.position(grid.corner(i)))).collect();
    let mut mesh = Mesh::default();
    let vertices = grid.vertices(&mut mesh);
    grid.faces(&vertices, &mut mesh);
    let slope = |p: DVec3| {
        let h = 0.2 * cell;
        let along = |axis: DVec3| distance(p + axis * h) - distance(p - axis * h);
        dvec3(along(DVec3::X), along(DVec3::Y), along(DVec3::Z)).normalize()
    };
    for p in &mut mesh.positions {
        (0..3).for_each(|_| *p -= slope(*p) * distance(*p).clamp(-0.5 * cell, 0.5 * cell) * 0.9);
    }
    mesh.normals = mesh.positions.iter().map(|p| slope(*p)).collect();
    mesh
}

impl Grid {
    fn index(&self, [x, y, z]: [usize; 3]) -> usize {
        (z * self.size[1] + y) * self.size[0] + x
    }

    fn corner(&self, index: usize) -> [usize; 3] {
        let row = index / self.size[0];
        [index % self.size[0], row % self.size[1], row / self.size[1]]
    }

    fn position(&self, corner: [usize; 3]) -> DVec3 {
        self.min + DVec3::from_array(corner.map(|c| c as f64)) * self.cell
    }

    fn inside(&self, corner: [usize; 3]) -> bool {
        self.distance[self.index(corner)] < 0.0
    }

    /// One vertex in each cube that the surface crosses: the mean of the crossings of its edges.
    fn vertices(&self, mesh: &mut Mesh) -> Vec<Option<u32>> {
        let mut vertices = vec![None; self.distance.len()];
        for (index, vertex) in vertices.iter_mut().enumerate() {
            let corner = self.corner(index);
            if (0..3).any(|k| corner[k] + 1 >= self.size[k]) {
                continue;
            }
            let crossings = self.crossings(corner);
            if !crossings.is_empty() {
                *vertex = Some(mesh.positions.len() as u32);
                mesh.positions.push(crossings.iter().sum::<DVec3>() / crossings.len() as f64);
            }
        }
        vertices
    }

    fn crossings(&self, [x, y, z]: [usize; 3]) -> Vec<DVec3> {
        let corner = |k: usize| [x + (k & 1), y + (k >> 1 & 1), z + (k >> 2 & 1)];
        let mut crossings = Vec::new();
        for a in 0..8usize {
            for b in [1, 2, 4].iter().filter(|bit| a & **bit == 0).map(|bit| a | bit) {
                let (ca, cb) = (corner(a), corner(b));
                if self.inside(ca) != self.inside(cb) {
                    let (da, db) = (self.distance[self.index(ca)], self.distance[self.index(cb)]);
                    crossings.push(self.position(ca).lerp(self.position(cb), da / (da - db)));
                }
            }
        }
        crossings
    }

    /// A quad around each grid edge that the surface crosses.
    fn faces(&self, vertices: &[Option<u32>], mesh: &mut Mesh) {
        for index in 0..self.distance.len() {
            let corner = self.corner(index);
            for axis in 0..3 {
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut end = corner;
                end[axis] += 1;
                if end[axis] >= self.size[axis] || corner[u] == 0 || corner[v] == 0 {
                    continue;
                }
                if self.inside(corner) != self.inside(end) {
                    self.quad(corner, [u, v], self.inside(corner), vertices, mesh);
                }
            }
        }
    }

    fn quad(&self, corner: [usize; 3], [u, v]: [usize; 2], outward: bool, vertices: &[Option<u32>], mesh: &mut Mesh) {
        let around = [(1, 1), (0, 1), (0, 0), (1, 0)].map(|(du, dv)| {
            let mut cube = corner;
            cube[u] -= du;
            cube[v] -= dv;
            vertices[self.index(cube)]
        });
        let [Some(a), Some(b), Some(c), Some(d)] = around else { return };
        let quad = if outward { [a, b, c, d] } else { [d, c, b, a] };
        let length = |i: u32, j: u32| mesh.positions[i as usize].distance(mesh.positions[j as usize]);
        // Cut along the shorter diagonal.
        if length(quad[0], quad[2]) <= length(quad[1], quad[3]) {
            mesh.triangles.extend([[quad[0], quad[1], quad[2]], [quad[0], quad[2], quad[3]]]);
        } else {
            mesh.triangles.extend([[quad[0], quad[1], quad[3]], [quad[1], quad[2], quad[3]]]);
        }
    }
}
