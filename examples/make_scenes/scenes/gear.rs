//! Spur gears with involute teeth, a rim, a thin web and a hub.

use std::f64::consts::{PI, TAU};

use glam::DVec3;

use super::det;
use super::loft::{Loop, circle, ring};
use super::mesh::Mesh;

/// A spur gear about the z axis; lengths in scene units.
#[derive(Clone, Copy)]
pub struct Gear {
    pub teeth: usize,
    /// Pitch diameter / number of teeth.
    pub module: f64,
    pub width: f64,
    pub bore: f64,
}

/// cos, and tan - angle, of the usual pressure angle of 20 degrees.
const COS_PRESSURE: f64 = 0.939_692_620_785_908_4;
const INVOLUTE_PRESSURE: f64 = 0.014_904_383_867;
/// Narrows each tooth so that meshing flanks do not touch.
const BACKLASH: f64 = 0.965;

impl Gear {
    pub fn pitch_radius(&self) -> f64 {
        0.5 * self.module * self.teeth as f64
    }

    /// The closed solid, the middle of tooth 0 on the +x axis.
    pub fn mesh(&self) -> Mesh {
        let half = 0.5 * self.width;
        let bevel = 0.18 * self.module;
        let root = self.pitch_radius() - 1.25 * self.module;
        let (hub, rim) = (self.bore * 1.75, root - 1.1 * self.module);
        let mut lower: Vec<Loop> = vec![circle(self.bore + bevel, -half, 64)];
        if rim > hub * 1.25 {
            lower.extend(self.web(half, hub, rim));
        }
        lower.push(self.outline(bevel, -half));
        lower.push(self.outline(0.0, -half + bevel));
        let upper: Vec<Loop> = lower.iter().rev().map(mirrored).collect();
        let bore = [half - bevel, -half + bevel].map(|z| circle(self.bore, z, 64));
        ring(&lower.into_iter().chain(upper).chain(bore).collect::<Vec<_>>()).shaded(48.0)
    }

    /// The recess between hub and rim, on the lower side.
    fn web(&self, half: f64, hub: f64, rim: f64) -> Vec<Loop> {
        let (floor, slope) = (-0.32 * half, 0.4 * self.module);
        [(hub, -half), (hub + slope, floor), (rim - slope, floor), (rim, -half)]
            .map(|(radius, z)| circle(radius, z, 96))
            .to_vec()
    }

    /// The toothed outline at height `z`, drawn in by `inset`.
    fn outline(&self, inset: f64, z: f64) -> Loop {
        let pitch = TAU / self.teeth as f64;
        (0..self.teeth)
            .flat_map(|tooth| self.tooth(inset).into_iter().map(move |(angle, r)| (angle + pitch * tooth as f64, r)))
            .map(|(angle, radius)| DVec3::new(radius * det::cos(angle), radius * det::sin(angle), z))
            .collect()
    }

    /// One tooth as (angle, radius) from the middle of the gap before it, counter-clockwise.
    fn tooth(&self, inset: f64) -> Vec<(f64, f64)> {
        let (tip, root) = (self.pitch_radius() + self.module, self.pitch_radius() - 1.25 * self.module);
        let flank_start = root + 0.3 * self.module;
        let radii = (0..4).map(|i| det::lerp(flank_start, tip, f64::from(i) / 3.0));
        let half: Vec<(f64, f64)> = std::iter::once((self.half_angle(flank_start) * 1.12, root))
            .chain(radii.map(|r| (self.half_angle(r), r)))
            .map(|(angle, r)| (angle, r - inset))
            .collect();
        let before = half.iter().map(|(angle, r)| (-angle, *r));
        let gap = (-PI / self.teeth as f64, root - inset);
        std::iter::once(gap).chain(before).chain(half.iter().rev().copied()).collect()
    }

    /// Half the angle a tooth takes at radius `r`.
    fn half_angle(&self, r: f64) -> f64 {
        let base = self.pitch_radius() * COS_PRESSURE;
        let ratio = (r / base).max(1.0);
        let tangent = (ratio * ratio - 1.0).sqrt();
        let involute = tangent - det::atan(tangent);
        (PI / (2 * self.teeth) as f64 * BACKLASH + INVOLUTE_PRESSURE - involute).max(0.004)
    }
}

fn mirrored(points: &Loop) -> Loop {
    points.iter().map(|p| DVec3::new(p.x, p.y, -p.z)).collect()
}
