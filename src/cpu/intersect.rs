//! Rays against triangles without cracks: a ray through a shared edge or corner meets exactly one triangle.
//!
//! Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (2013), with their f64 fallback, and with
//! zeros decided as if the ray were moved by an infinitesimal step (Edelsbrunner and Mücke's simulation of
//! simplicity), so that no hit is counted twice either.

use glam::{DVec2, DVec3, Vec2, Vec3};

/// A ray prepared for triangle tests: sheared so that it runs along +z from the origin.
#[derive(Debug, Clone, Copy)]
pub struct ShearedRay {
    origin: Vec3,
    axes: [usize; 3],
    shear: Vec3,
    /// In double precision, for triangles that are so large that single precision says too little of where they are.
    exact: (DVec3, DVec3),
}

/// Where a ray meets a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TriangleHit {
    pub t: f32,
    /// Barycentric weights of the corners.
    pub weights: Vec3,
    /// Its corners run to the left as the ray sees them.
    pub turns_left: bool,
}

impl ShearedRay {
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        let exact = (origin, direction);
        let (origin, direction) = (origin.as_vec3(), direction.as_vec3());
        let z = direction.abs().max_position();
        let (mut x, mut y) = ((z + 1) % 3, (z + 2) % 3);
        if direction[z] < 0.0 {
            std::mem::swap(&mut x, &mut y);
        }
        let shear = Vec3::new(direction[x] / direction[z], direction[y] / direction[z], 1.0 / direction[z]);
        Self { origin, axes: [x, y, z], shear, exact }
    }

    /// The corner in the sheared frame; a function of the corner alone, so triangles that share it agree.
    fn sheared(&self, corner: Vec3) -> (Vec2, f32) {
        let p = corner - self.origin;
        let [x, y, z] = self.axes.map(|axis| p[axis]);
        (Vec2::new(x - self.shear.x * z, y - self.shear.y * z), self.shear.z * z)
    }

    /// As [`ShearedRay::hit`], in double precision.
    pub fn hit_exact(&self, corners: &[DVec3; 3]) -> Option<TriangleHit> {
        let (origin, direction) = self.exact;
        let [x, y, z] = self.axes;
        let sheared = |corner: DVec3| {
            let p = corner - origin;
            let along = p[z] / direction[z];
            (DVec2::new(p[x] - direction[x] * along, p[y] - direction[y] * along), along)
        };
        let [(a, az), (b, bz), (c, cz)] = corners.map(sheared);
        let weights = DVec3::new(c.perp_dot(b), a.perp_dot(c), b.perp_dot(a));
        let sides = [side(weights.x, c, b), side(weights.y, a, c), side(weights.z, b, a)];
        let det = weights.element_sum();
        if (sides != [1; 3] && sides != [-1; 3]) || det == 0.0 {
            return None;
        }
        let weights = weights / det;
        let t = weights.dot(DVec3::new(az, bz, cz)) as f32;
        Some(TriangleHit { t, weights: weights.as_vec3(), turns_left: det > 0.0 })
    }

    /// Either side of the triangle counts. `t` is not bounded here.
    pub fn hit(&self, corners: &[Vec3; 3]) -> Option<TriangleHit> {
        let [(a, az), (b, bz), (c, cz)] = corners.map(|p| self.sheared(p));
        let (mut u, mut v, mut w) = (c.perp_dot(b), a.perp_dot(c), b.perp_dot(a));
        if u == 0.0 || v == 0.0 || w == 0.0 {
            let exact = |p: Vec2, q: Vec2| p.as_dvec2().perp_dot(q.as_dvec2());
            let (du, dv, dw) = (exact(c, b), exact(a, c), exact(b, a));
            let [a, b, c] = [a, b, c].map(|p| p.as_dvec2());
            let sides = [side(du, c, b), side(dv, a, c), side(dw, b, a)];
            if sides != [1; 3] && sides != [-1; 3] {
                return None;
            }
            (u, v, w) = (du as f32, dv as f32, dw as f32);
        } else if (u < 0.0 || v < 0.0 || w < 0.0) && (u > 0.0 || v > 0.0 || w > 0.0) {
            return None;
        }
        let det = u + v + w;
        if det == 0.0 {
            return None;
        }
        let weights = Vec3::new(u, v, w) / det;
        Some(TriangleHit { t: weights.dot(Vec3::new(az, bz, cz)), weights, turns_left: det > 0.0 })
    }
}

/// On which side of the edge from `p` to `q` the origin lies, moved by (e, e²) where it lies on the edge. The two
/// triangles of an edge run along it in opposite directions and get opposite answers.
fn side(value: f64, p: DVec2, q: DVec2) -> i32 {
    let signs = [value, p.y - q.y, q.x - p.x];
    signs.into_iter().find(|s| *s != 0.0).map_or(0, |s| s.signum() as i32)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn hits(origin: Vec3, direction: Vec3, triangles: &[[Vec3; 3]]) -> usize {
        let ray = ShearedRay::new(origin.as_dvec3(), direction.as_dvec3());
        let exact = |t: &[Vec3; 3]| ray.hit_exact(&t.map(|p| p.as_dvec3())).is_some_and(|h| h.t > 0.0);
        let hits = triangles.iter().filter(|t| ray.hit(t).is_some_and(|h| h.t > 0.0)).count();
        assert_eq!(triangles.iter().filter(|t| exact(t)).count(), hits, "in double precision");
        hits
    }

    /// A fan of triangles around the origin in the plane z = 0, its corners on a grid.
    fn fan() -> Vec<[Vec3; 3]> {
        let ring = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];
        let at = |i: usize| Vec3::new(ring[i % 8].0 as f32, ring[i % 8].1 as f32, 0.0);
        (0..8).map(|i| [Vec3::ZERO, at(i), at(i + 1)]).collect()
    }

    #[test]
    fn a_ray_through_a_shared_corner_or_edge_meets_one_triangle() {
        for target in [Vec3::ZERO, Vec3::new(0.5, 0.5, 0.0), Vec3::new(0.5, 0.0, 0.0), Vec3::new(-0.25, 0.0, 0.0)] {
            for eye in [
                Vec3::new(0.0, 0.0, 3.0),
                Vec3::new(0.0, 0.0, -3.0),
                Vec3::new(2.0, 1.0, 4.0),
                Vec3::new(-1.0, 3.0, 2.0),
            ] {
                assert_eq!(hits(eye, target - eye, &fan()), 1, "from {eye} to {target}");
            }
        }
    }

    #[test]
    fn the_depth_is_the_parameter_of_the_ray() {
        let triangle = [Vec3::new(-1.0, -1.0, 2.0), Vec3::new(2.0, -1.0, 2.0), Vec3::new(-1.0, 2.0, 2.0)];
        let hit = ShearedRay::new(DVec3::ZERO, DVec3::new(0.0, 0.0, 0.5)).hit(&triangle).unwrap();
        assert!((hit.t - 4.0).abs() < 1e-6);
        assert!((hit.weights.element_sum() - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_triangle_without_area_is_never_met() {
        let line = [Vec3::new(-1.0, 0.0, 1.0), Vec3::new(1.0, 0.0, 1.0), Vec3::new(0.0, 0.0, 1.0)];
        assert_eq!(hits(Vec3::ZERO, Vec3::Z, &[line, [Vec3::Z; 3]]), 0);
    }
}
