//! Cells of planes: two that agree, rounding allowed for, have one in common.

use glam::DVec3;
use rayon::prelude::*;

use super::Part;
use super::face::Face;

/// Planes are sorted into cells: by two slopes against the axis that they face most, and by where they cross it.
const SLOPES: f64 = 1.0 / 64.0;
/// As a share of the extent of what is drawn.
const OFFSETS: f64 = 1.0 / 256.0;

/// Where all that is drawn lies, more or less: one stray vertex does not move it.
#[derive(Debug, Clone, Copy)]
pub struct Place {
    pub origin: DVec3,
    extent: f64,
}

impl Place {
    pub fn of(parts: &[Part]) -> Self {
        let bounds = |part: &Part| {
            let ends = |low: DVec3, high: DVec3, p: DVec3| (low.min(p), high.max(p));
            let (low, high) = part
                .positions
                .iter()
                .fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(low, high), p| ends(low, high, p.as_dvec3()));
            (low.cmple(high).all()).then(|| {
                let world = &part.world_from_local;
                let size = world.transform_vector3(high - low).length();
                (world.transform_point3(0.5 * (low + high)), 0.5 * size)
            })
        };
        let balls: Vec<(DVec3, f64)> = parts.par_iter().filter_map(bounds).collect();
        let median = |mut values: Vec<f64>| {
            values.sort_unstable_by(f64::total_cmp);
            values.get(values.len() / 2).copied().unwrap_or_default()
        };
        let origin = DVec3::from_array([0, 1, 2].map(|axis| median(balls.iter().map(|ball| ball.0[axis]).collect())));
        let extent = median(balls.iter().map(|(center, radius)| center.distance(origin) + radius).collect());
        Self { origin, extent: extent.max(f64::MIN_POSITIVE) }
    }

    /// The cells that a triangle's plane may belong to, whatever rounding did to it.
    pub fn cells(&self, face: &Face) -> Vec<u64> {
        let mut cells = Vec::new();
        if !face.is_sound() {
            return cells;
        }
        let room = 4.0 * face.tolerance / face.height;
        let largest = face.normal.abs().max_element();
        for axis in 0..3 {
            let facing = face.normal[axis];
            // Of axes that it faces alike another one's plane may choose either.
            if facing.abs() < largest * (1.0 - room) - 1e-6 {
                continue;
            }
            let others = [(axis + 1) % 3, (axis + 2) % 3];
            let slopes = others.map(|other| face.normal[other] / facing);
            let center = face.center();
            let offset = center[axis] + slopes[0] * center[others[0]] + slopes[1] * center[others[1]];
            let away = center[others[0]].abs() + center[others[1]].abs();
            let [a, b] = slopes.map(|slope| steps(slope / SLOPES, 2.0 * room / SLOPES));
            let size = OFFSETS * self.extent;
            let c = steps(offset / size, (4.0 * face.tolerance + 2.0 * room * away) / size);
            for a in a.0..=a.1 {
                for b in b.0..=b.1 {
                    cells.extend((c.0..=c.1).map(|c| key(axis, a, b, c)));
                }
            }
        }
        cells
    }
}

/// The whole numbers below a value and within some room of it: three at the most.
fn steps(value: f64, room: f64) -> (i64, i64) {
    let room = room.min(1.0);
    ((value - room).floor() as i64, (value + room).floor() as i64)
}

fn key(axis: usize, a: i64, b: i64, c: i64) -> u64 {
    let slope = |step: i64| (step + 512) as u64 & 1023;
    (axis as u64) << 60 | slope(a) << 50 | slope(b) << 40 | (c as u64 & 0xff_ffff_ffff)
}
