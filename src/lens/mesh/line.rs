//! A line against triangles of a closed surface, such that it goes in as often as it comes out.
//!
//! The projection of Woop, Benthin and Wald, "Watertight Ray/Triangle Intersection" (2013): a projected vertex is a
//! function of the vertex alone. On which side of an edge the line passes is then decided exactly, and where it meets
//! the edge, as if it were moved by an infinitesimal step (Edelsbrunner and Mücke's simulation of simplicity).

use glam::{DVec2, DVec3};

/// Where a line goes through a triangle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LineCrossing {
    /// Parameter along the line.
    pub t: f64,
    /// The triangle's corners run to the left as seen along the line.
    pub turns_left: bool,
}

/// A line prepared for triangle tests: sheared so that it runs along +z through the origin.
pub struct ShearedLine {
    origin: DVec3,
    axes: [usize; 3],
    shear: DVec3,
}

impl ShearedLine {
    pub fn new(origin: DVec3, direction: DVec3) -> Self {
        let z = direction.abs().max_position();
        let axes = [(z + 1) % 3, (z + 2) % 3, z];
        let [dx, dy, dz] = axes.map(|axis| direction[axis]);
        Self { origin, axes, shear: DVec3::new(dx / dz, dy / dz, 1.0 / dz) }
    }

    /// A vertex across the line, and the parameter of the line beside it.
    fn sheared(&self, vertex: DVec3) -> (DVec2, f64) {
        let p = vertex - self.origin;
        let [x, y, z] = self.axes.map(|axis| p[axis]);
        (DVec2::new(x - self.shear.x * z, y - self.shear.y * z), self.shear.z * z)
    }

    /// Where the line goes through a triangle, whichever way that is turned.
    pub fn crossing(&self, corners: [DVec3; 3]) -> Option<LineCrossing> {
        let [(a, ta), (b, tb), (c, tc)] = corners.map(|p| self.sheared(p));
        let sides = [side(c, b), side(a, c), side(b, a)];
        if sides != [1; 3] && sides != [-1; 3] {
            return None;
        }
        let weights = DVec3::new(c.perp_dot(b), a.perp_dot(c), b.perp_dot(a));
        let whole = weights.element_sum();
        let depths = DVec3::new(ta, tb, tc);
        // A triangle seen edge on is crossed all the same: the count must stay even.
        let t = if whole == 0.0 { depths.element_sum() / 3.0 } else { weights.dot(depths) / whole };
        Some(LineCrossing {
            t: t.clamp(depths.min_element(), depths.max_element()),
            turns_left: (sides[0] == 1) == (self.shear.z > 0.0),
        })
    }
}

/// On which side of the edge from `p` to `q` the origin lies, moved by (e, e²) where it lies on the edge. The two
/// triangles of an edge run along it in opposite directions and get opposite answers; 0 only where `p` is `q`.
fn side(p: DVec2, q: DVec2) -> i32 {
    let signs = [sign_of_cross(p, q), p.y - q.y, q.x - p.x];
    signs.into_iter().find(|s| *s != 0.0).map_or(0, |s| s.signum() as i32)
}

/// A number with the sign of the exact `p.x q.y - p.y q.x`: rounding keeps the order of two products, and where they
/// round to the same number, what was rounded off decides.
fn sign_of_cross(p: DVec2, q: DVec2) -> f64 {
    let (left, right) = (p.x * q.y, p.y * q.x);
    if left != right { left - right } else { p.x.mul_add(q.y, -left) - p.y.mul_add(q.x, -right) }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A fan of triangles around the origin in the plane z = 0, its corners on a grid.
    fn fan() -> Vec<[DVec3; 3]> {
        let ring = [(1, 0), (1, 1), (0, 1), (-1, 1), (-1, 0), (-1, -1), (0, -1), (1, -1)];
        let at = |i: usize| DVec3::new(f64::from(ring[i % 8].0), f64::from(ring[i % 8].1), 0.0);
        (0..8).map(|i| [DVec3::ZERO, at(i), at(i + 1)]).collect()
    }

    #[test]
    fn a_line_through_a_shared_corner_or_edge_crosses_once() {
        for target in [DVec3::ZERO, DVec3::new(0.5, 0.5, 0.0), DVec3::new(0.5, 0.0, 0.0), DVec3::new(-0.3, 0.1, 0.0)] {
            for eye in [DVec3::Z * 3.0, DVec3::Z * -3.0, DVec3::new(2.0, 1.0, 4.0), DVec3::new(-1.0, 3.0, 0.7)] {
                let line = ShearedLine::new(eye, target - eye);
                let depths: Vec<f64> =
                    fan().into_iter().filter_map(|t| line.crossing(t)).map(|crossing| crossing.t).collect();
                assert!(depths.len() == 1 && (depths[0] - 1.0).abs() < 1e-12, "from {eye} to {target}: {depths:?}");
            }
        }
    }

    #[test]
    fn a_triangle_without_area_is_never_crossed() {
        let line = ShearedLine::new(DVec3::ZERO, DVec3::Z);
        let flat = [DVec3::new(-1.0, 0.0, 1.0), DVec3::new(1.0, 0.0, 1.0), DVec3::new(0.0, 0.0, 1.0)];
        assert_eq!(line.crossing(flat), None);
        assert_eq!(line.crossing([DVec3::Z; 3]), None);
    }

    #[test]
    fn the_sign_is_that_of_the_exact_product() {
        // Both products round to 1; exactly, the left one is larger by 2^-104.
        let e = 2.0_f64.powi(-52);
        let (p, q) = (DVec2::new(1.0 + e, 1.0), DVec2::new(1.0, 1.0 - e));
        assert_eq!(sign_of_cross(p, q), -(e * e));
        assert_eq!(sign_of_cross(q, p), e * e);
        assert_eq!(p.perp_dot(q), 0.0);
    }
}
