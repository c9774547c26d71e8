//! The records of a frame: one for each sample or, for `peel`, for each layer of each sample.

use glam::DVec2;

use super::records::{FrameRecord, all_words, extended};
use super::tiles::Tiles;
use super::{Engine, Window};
use crate::plan::{LensSet, Plan};

/// One pass of the whole pipeline over a window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Sample {
    /// Where it lies in its pixel, in pixels from the top left corner.
    pub at: DVec2,
    pub index: u32,
    /// Counts towards the picture; else it is only for the maps of pixel centres.
    pub colors: bool,
    pub maps: bool,
}

/// Where a fragment stands among all of its ray.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Place {
    pub depth: f32,
    /// The number of its triangle among all.
    pub key: u32,
    /// The number of its record.
    pub item: u32,
    /// The lenses and rules that act on it and on nearer ones.
    pub passed: LensSet,
}

impl Place {
    /// Before all fragments.
    pub const FIRST: Place = Place { depth: f32::MIN, key: 0, item: 0, passed: LensSet::EMPTY };
}

/// The samples of a plan: a square grid and, when maps are asked for, the pixel's centre.
pub fn samples(plan: &Plan, aovs: bool) -> Vec<Sample> {
    let side = f64::from(plan.samples).sqrt().round().max(1.0) as u32;
    let offset = |i: u32| (f64::from(i) + 0.5) / f64::from(side);
    let mut samples: Vec<Sample> = (0..side * side)
        .map(|index| Sample {
            at: DVec2::new(offset(index % side), offset(index / side)),
            index,
            colors: true,
            maps: aovs && side == 1,
        })
        .collect();
    if aovs && side > 1 {
        samples.push(Sample { at: DVec2::splat(0.5), index: side * side, colors: false, maps: true });
    }
    samples
}

/// How often the scene is drawn for a sample.
pub fn passes(engine: Engine, tiles: &Tiles) -> u32 {
    match engine {
        Engine::Fused => 1,
        Engine::Peel => tiles.most_layers,
    }
}

/// What all records of a frame share.
pub struct FrameShape<'a> {
    pub plan: &'a Plan,
    pub window: Window,
    pub tiles: &'a Tiles,
    pub fragment_capacity: u32,
    pub target_is_srgb: bool,
    /// For accounts: the fragment of which the next one behind is looked for.
    pub after: Option<Place>,
}

impl FrameShape<'_> {
    /// The record of one sample and layer.
    pub fn record(&self, sample: &Sample, layer: u32) -> FrameRecord {
        let plan = self.plan;
        let view = &plan.view;
        let (dx, dy) = view.pixel_steps();
        let merging = view.anchor.merging;
        let drawn = view.anchor.drawn;
        let (clip_scale, clip_shift) = self.clip(sample.at);
        let space = plan.texture_space;
        FrameRecord {
            ray_dx: extended(dx),
            ray_dy: extended(dy),
            right: extended(view.right),
            up: extended(view.up),
            forward: extended(view.forward),
            clip_scale: clip_scale.as_vec2().to_array(),
            clip_shift: clip_shift.as_vec2().to_array(),
            middle: view.size.map(|length| 0.5 * length as f32),
            shares: view.shares().map(|share| share as f32),
            near: view.near as f32,
            far: view.far as f32,
            perspective: u32::from(view.is_perspective()),
            layer,
            window_min: self.window.min,
            window_size: self.window.size,
            sample: sample.at.as_vec2().to_array(),
            sample_index: sample.index,
            samples: plan.samples,
            ambient: plan.lighting.up.extend(plan.lighting.ambient).to_array(),
            texture_space: (space.origin - view.origin()).as_vec3().extend(space.scale).to_array(),
            background: plan.background,
            fragment_capacity: self.fragment_capacity,
            active_tiles: self.tiles.active,
            target_is_srgb: u32::from(self.target_is_srgb),
            lens_count: plan.lenses.len() as u32,
            rule_count: plan.rules.len() as u32,
            after_depth: self.after.map_or(0.0, |place| place.depth),
            after_key: self.after.map_or(u32::MAX, |place| place.key),
            after_item: self.after.map_or(0, |place| place.item),
            tone_mapping: plan.tone_mapping,
            drawn: drawn.map(|depth| depth as f32),
            drawn_from_eye: view.from_eye(drawn[0]) as f32,
            origin: view.origin().as_vec3().to_array(),
            anchor: view.anchor.depth as f32,
            merge_most: merging.most.min(1e37) as f32,
            merge_across: merging.across as f32,
            pad: 0.0,
            picture_scale: (1.0 / view.half_height()) as f32,
            by_pixel: all_words(&plan.by_pixel),
            translucent: all_words(&plan.translucent()),
            passed: all_words(&self.after.map_or(LensSet::EMPTY, |place| place.passed)),
        }
    }

    /// Scale and shift of clip coordinates: from view space to the window, moved so that the middle of each of its
    /// pixels falls on the sample.
    fn clip(&self, sample: DVec2) -> (DVec2, DVec2) {
        let view = &self.plan.view;
        let double = |v: [u32; 2]| DVec2::new(f64::from(v[0]), f64::from(v[1]));
        let (whole, window, min) = (double(view.size), double(self.window.size), double(self.window.min));
        let picture = DVec2::new(whole.y / whole.x, 1.0) / view.half_height();
        let shift = (whole + 1.0 - 2.0 * sample - 2.0 * min) / window - 1.0;
        (picture * whole / window, DVec2::new(shift.x, -shift.y))
    }
}
