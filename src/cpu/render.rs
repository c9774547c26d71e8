//! A whole picture, tile by tile.

use glam::Vec4;
use rayon::prelude::*;

use super::geometry::Geometry;
use super::pixel::{PixelReport, Removed, Scratch, Tracer, Visible};
use crate::appearance as wgsl;
use crate::frame::{Aovs, Frame, RegionTable};
use crate::lens::PixelRect;
use crate::plan::Plan;
use crate::scene::Scene;

/// Side of a tile in pixels.
const TILE: u32 = 16;

/// Renders a plan over a scene. Holds the scene's acceleration structures.
pub struct Renderer<'a> {
    scene: &'a Scene,
    plan: &'a Plan,
    geometry: Vec<Geometry>,
}

/// One tile's share of the picture.
struct TileResult {
    rect: PixelRect,
    pixels: Vec<[u8; 4]>,
    centers: Vec<Center>,
}

/// What the AOVs keep of a pixel's centre.
struct Center {
    layers: u16,
    visible: Option<Visible>,
}

impl<'a> Renderer<'a> {
    pub fn new(scene: &'a Scene, plan: &'a Plan) -> Self {
        Self { scene, plan, geometry: Geometry::build_all(scene, plan) }
    }

    /// The picture; with `aovs`, what lies at the centre of each pixel, too. `done` is called with the number of
    /// pixels of each finished tile, from any thread.
    pub fn render(&self, aovs: bool, done: &(dyn Fn(u64) + Sync)) -> Frame {
        let size = self.plan.view.size;
        let tracer = Tracer::new(self.scene, self.plan, &self.geometry);
        let results: Vec<TileResult> = tiles(size)
            .into_par_iter()
            .map_init(Scratch::default, |scratch, rect| {
                let result = self.tile(&tracer, rect, aovs, scratch);
                done(rect.area());
                result
            })
            .collect();
        let count = size[0] as usize * size[1] as usize;
        let mut pixels = vec![[0; 4]; count];
        let mut maps = aovs.then(|| Aovs::empty(size));
        let mut table = RegionTable::default();
        for result in results {
            for (i, (x, y)) in pixels_of(&result.rect).enumerate() {
                let at = (y * size[0] + x) as usize;
                pixels[at] = result.pixels[i];
                if let Some(maps) = &mut maps {
                    self.store(maps, &mut table, at, &result.centers[i]);
                }
            }
        }
        if let Some(maps) = &mut maps {
            maps.table = table.table;
        }
        Frame { size, pixels, aovs: maps }
    }

    /// What the ray through a pixel's centre meets.
    pub fn explain(&self, x: u32, y: u32) -> PixelReport {
        let tracer = Tracer::new(self.scene, self.plan, &self.geometry);
        let rect = PixelRect { min: [x, y], max: [x + 1, y + 1] };
        tracer.report(f64::from(x) + 0.5, f64::from(y) + 0.5, &self.ranks(&rect), &mut Scratch::default())
    }

    /// What lenses take away from the ray through a pixel's centre before a depth, nearest first.
    pub fn removed(&self, x: u32, y: u32, before: f32) -> Vec<Removed> {
        let tracer = Tracer::new(self.scene, self.plan, &self.geometry);
        let rect = PixelRect { min: [x, y], max: [x + 1, y + 1] };
        tracer.removed(f64::from(x) + 0.5, f64::from(y) + 0.5, &self.ranks(&rect), before)
    }

    fn ranks(&self, rect: &PixelRect) -> Vec<usize> {
        (0..self.plan.lenses.len()).filter(|rank| self.plan.lenses[*rank].rect.overlaps(rect)).collect()
    }

    fn tile(&self, tracer: &Tracer, rect: PixelRect, aovs: bool, scratch: &mut Scratch) -> TileResult {
        let ranks = self.ranks(&rect);
        let side = f64::from(self.plan.samples).sqrt().round().max(1.0) as u32;
        let offset = |i: u32| (f64::from(i) + 0.5) / f64::from(side);
        let mut result = TileResult { rect, pixels: Vec::new(), centers: Vec::new() };
        for (x, y) in pixels_of(&rect) {
            let mut sum = Vec4::ZERO;
            for (i, j) in (0..side).flat_map(|j| (0..side).map(move |i| (i, j))) {
                sum += tracer.color(f64::from(x) + offset(i), f64::from(y) + offset(j), &ranks, scratch);
            }
            result.pixels.push(self.finish(sum / (side * side) as f32));
            if aovs {
                let report = tracer.report(f64::from(x) + 0.5, f64::from(y) + 0.5, &ranks, scratch);
                result.centers.push(Center { layers: report.layers.count() as u16, visible: report.visible });
            }
        }
        result
    }

    /// Puts a premultiplied linear colour over the background and encodes it.
    fn finish(&self, front: Vec4) -> [u8; 4] {
        let [r, g, b, a] = self.plan.background;
        let back = Vec4::new(r, g, b, 1.0) * a;
        let sum = front + back * (1.0 - front.w);
        if sum.w <= 0.0 {
            return [0; 4];
        }
        let straight = sum.truncate() / sum.w;
        let encode = |c: f32| (wgsl::srgb_from_linear(c) * 255.0).round() as u8;
        [encode(straight.x), encode(straight.y), encode(straight.z), (sum.w.clamp(0.0, 1.0) * 255.0).round() as u8]
    }

    fn store(&self, maps: &mut Aovs, table: &mut RegionTable, at: usize, center: &Center) {
        maps.layers[at] = center.layers;
        let Some(visible) = &center.visible else { return };
        maps.regions[at] = table.number(visible.fragment.region);
        let item = self.plan.instances[visible.fragment.instance as usize].item;
        maps.nodes[at] = self.plan.items[item].node as u32 + 1;
        maps.depth[at] = visible.fragment.depth;
        maps.normals[at] = visible.normal.to_array();
    }
}

fn tiles(size: [u32; 2]) -> Vec<PixelRect> {
    let starts = |length: u32| (0..length).step_by(TILE as usize);
    starts(size[1])
        .flat_map(|y| {
            starts(size[0])
                .map(move |x| PixelRect { min: [x, y], max: [(x + TILE).min(size[0]), (y + TILE).min(size[1])] })
        })
        .collect()
}

fn pixels_of(rect: &PixelRect) -> impl Iterator<Item = (u32, u32)> + use<> {
    let PixelRect { min, max } = *rect;
    (min[1]..max[1]).flat_map(move |y| (min[0]..max[0]).map(move |x| (x, y)))
}
