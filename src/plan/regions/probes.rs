//! The lines along which regions are looked for.

use glam::DVec3;

use crate::plan::Plan;
use crate::scene::Aabb;
use crate::view::Ray;

/// Lines a side of the grid through a lens, for few lenses; fewer each for many, so that the work stays bounded.
const GRID: usize = 24;
const LINES: usize = 40_000;

/// A line, and the stretch of it that counts.
pub type Probe = (Ray, f64, f64);

impl Plan {
    /// Lines to look along, lens by lens.
    pub(super) fn probes(&self) -> Vec<Probe> {
        let per_lens = (LINES / (4 * self.lenses.len().max(1))).max(9);
        let grid = GRID.min((per_lens as f64).sqrt() as usize).max(3);
        let mut probes = Vec::new();
        for rank in self.by_pixel.iter() {
            let lens = &self.lenses[rank];
            let bounds = lens.volume.bounds();
            if !bounds.is_empty() && bounds.size().is_finite() {
                axis_probes(&bounds, grid, &mut probes);
            }
            let (min, max) = (lens.rect.min.map(f64::from), lens.rect.max.map(f64::from));
            for (u, v) in grid_points(grid) {
                let ray = self.view.ray(min[0] + (max[0] - min[0]) * u, min[1] + (max[1] - min[1]) * v);
                probes.push((ray, self.view.near, self.view.far));
            }
        }
        probes
    }
}

/// All of them in an order in which the first few are spread over all: a search may end before the last.
pub fn scattered(probes: &[Probe]) -> impl Iterator<Item = &Probe> {
    let count = probes.len();
    let step = (0.618_034 * count as f64) as usize;
    let step = (step..).find(|step| common_divisor(*step, count) <= 1).unwrap_or(1);
    (0..count).map(move |number| &probes[(number * step) % count])
}

fn common_divisor(a: usize, b: usize) -> usize {
    if b == 0 { a } else { common_divisor(b, a % b) }
}

/// Middles of the cells of a grid, shifted a little so that they fall on no symmetry.
fn grid_points(grid: usize) -> impl Iterator<Item = (f64, f64)> {
    let at = move |i: usize, shift: f64| (i as f64 + shift) / grid as f64;
    (0..grid).flat_map(move |i| (0..grid).map(move |j| (at(i, 0.4937), at(j, 0.5071))))
}

fn axis_probes(bounds: &Aabb, grid: usize, probes: &mut Vec<Probe>) {
    let size = bounds.size();
    for axis in 0..3 {
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        for (u, v) in grid_points(grid) {
            let mut origin = bounds.min;
            origin[a] += u * size[a];
            origin[b] += v * size[b];
            let ray = Ray::new(origin, DVec3::AXES[axis]);
            probes.push((ray, -1e-3 * size[axis], 1.001 * size[axis]));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_looked_along_once() {
        for count in [0, 1, 2, 3, 4, 9, 10, 36, 100, 997, 2304] {
            let probes: Vec<Probe> = (0..count).map(|i| (Ray::default(), f64::from(i), 0.0)).collect();
            let mut seen: Vec<f64> = scattered(&probes).map(|(_, number, _)| *number).collect();
            seen.sort_unstable_by(f64::total_cmp);
            assert_eq!(seen, (0..count).map(f64::from).collect::<Vec<_>>());
        }
    }
}
