//! A whole picture, tile by tile.

mod in_front;

use glam::Vec4;
use rayon::prelude::*;

use super::block::Block;
use super::convert::{g3, v3};
use super::memory;
use super::pixel::{Scratch, Tracer};
use super::screen::{self, Plane};
use crate::InputError;
use crate::appearance as wgsl;
use crate::frame::{Aovs, Frame, NoMemory, RegionTable, check_memory, filled};
use crate::lens::{LayerStart, PixelRect, RayLayers};
use crate::limits::FILTER_ITERATIONS;
use crate::pick::Pick;
use crate::pixel::{PixelReport, Visible};
use crate::plan::Plan;
use crate::scene::{Scene, TO_TAKE_LESS};

/// The fewest rows of a picture whose samples are kept at once, for filters of the screen, and how many samples, about: what
/// lies around a band is traced for it anew.
const BAND: u32 = 128;
const BAND_SAMPLES: u32 = 1 << 22;

/// Pixels, about, of which all that was found is kept at once, before it is brought into the picture and its maps.
const BAND_PIXELS: u32 = 1 << 20;

/// Samples along each side of a block, about.
const BLOCK: u32 = 16;

/// A picture that cannot be made.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Error {
    #[error("the plan was made for another scene than the one that is drawn")]
    OtherScene,
    /// With the numbers; see [`OpenOptions::memory_limit`](crate::scene::OpenOptions::memory_limit).
    #[error("{0}")]
    TooLarge(String),
    #[error(transparent)]
    NoMemory(#[from] NoMemory),
    #[error(
        "the loops of `wgsl` filters took more than {FILTER_ITERATIONS} iterations for one picture \
         (an iteration that computes more than 64 numbers counts as several)"
    )]
    FilterWork,
}

impl From<Error> for InputError {
    fn from(error: Error) -> Self {
        let help = match error {
            Error::OtherScene => "make a plan of this scene with `Plan::new`",
            Error::TooLarge(_) => TO_TAKE_LESS,
            Error::NoMemory(_) => "make it smaller, or leave maps out",
            Error::FilterWork => "let the loops end sooner, or make the picture smaller or with fewer samples",
        };
        InputError::new(error.to_string()).help(help)
    }
}

/// Renders a plan over a scene. Holds the scene's acceleration structures.
pub struct Renderer<'a> {
    plan: &'a Plan,
    tracer: Tracer<'a>,
}

/// What is wanted of a picture.
#[derive(Clone, Copy)]
struct Wanted {
    colors: bool,
    maps: bool,
}

/// One tile's share of the picture; a list that is not wanted is empty.
struct TileResult {
    rect: PixelRect,
    pixels: Vec<[u8; 4]>,
    centers: Vec<Center>,
}

/// The colour of a sample, and what is visible at it.
type SampleSeen = (Vec4, Option<Visible>);

/// What the AOVs keep of a pixel's centre.
struct Center {
    layers: u16,
    visible: Option<Visible>,
}

impl<'a> Renderer<'a> {
    /// # Errors
    /// The plan was made for another scene, or its triangles exceed the memory limit that the scene was opened with.
    pub fn new(scene: &'a Scene, plan: &'a Plan) -> Result<Self, Error> {
        if plan.scene != scene.id {
            return Err(Error::OtherScene);
        }
        memory::check_memory(scene, plan)?;
        Ok(Self { plan, tracer: Tracer::new(scene, plan) })
    }

    /// The picture; with `aovs`, what lies at the centre of each pixel, too. `done` is called with the number of
    /// pixels of each finished tile, from any thread.
    ///
    /// # Errors
    /// There is no memory for the picture.
    pub fn render(&self, aovs: bool, done: &(dyn Fn(u64) + Sync)) -> Result<Frame, Error> {
        let size = self.plan.view.size;
        check_memory(size, aovs)?;
        self.tracer.start_picture();
        if !self.plan.screen.is_empty() {
            let maps = if aovs { Some(self.maps(&|_| ())?) } else { None };
            return Ok(Frame { size, pixels: self.screen_filtered(done)?, aovs: maps });
        }
        let mut pixels = filled(size[0] as usize * size[1] as usize, [0; 4])?;
        let maps = self.draw(Some(&mut pixels), aovs, done)?;
        Ok(Frame { size, pixels, aovs: maps })
    }

    /// What lies at the centre of each pixel, without the picture. `done` is called as by [`Renderer::render`].
    ///
    /// # Errors
    /// There is no memory for the maps.
    pub fn maps(&self, done: &(dyn Fn(u64) + Sync)) -> Result<Aovs, Error> {
        check_memory(self.plan.view.size, true)?;
        self.tracer.start_picture();
        Ok(self.draw(None, true, done)?.unwrap_or_default())
    }

    /// Draws into a picture, if there is one, and gives the maps, if they are wanted. Goes from band to band: of each pixel of
    /// one several times as much is kept as of the others.
    fn draw(
        &self,
        mut pixels: Option<&mut [[u8; 4]]>,
        maps: bool,
        done: &(dyn Fn(u64) + Sync),
    ) -> Result<Option<Aovs>, Error> {
        let [width, height] = self.plan.view.size;
        let wanted = Wanted { colors: pixels.is_some(), maps };
        let mut table = RegionTable::default();
        let mut aovs = if maps { Some(Aovs::empty([width, height])?) } else { None };
        let rows = (BAND_PIXELS / width).next_multiple_of(BAND);
        for first in (0..height).step_by(rows as usize) {
            let band = PixelRect { min: [0, first], max: [width, (first + rows).min(height)] };
            for tile in self.tiles(band, wanted, done)? {
                for (number, (x, y)) in pixels_of(&tile.rect).enumerate() {
                    let at = y as usize * width as usize + x as usize;
                    if let Some(pixels) = &mut pixels {
                        pixels[at] = tile.pixels[number];
                    }
                    if let Some(aovs) = &mut aovs {
                        self.store(aovs, &mut table, at, &tile.centers[number]);
                    }
                }
            }
        }
        if let Some(aovs) = &mut aovs {
            aovs.table = table.table;
        }
        Ok(aovs)
    }

    /// The depth, from the anchor, at which the ray of each pixel's centre surely ends, infinite where nothing opaque is: primary visibility
    /// and nothing else.
    pub fn depths(&self) -> Vec<f32> {
        let [width, height] = self.plan.view.size;
        let tiles: Vec<(PixelRect, Vec<f32>)> = tiles_of(&PixelRect { min: [0; 2], max: [width, height] }, BLOCK)
            .into_par_iter()
            .map_init(Scratch::default, |scratch, rect| {
                let block = Block { rect, side: 1 };
                self.tracer.trace(&block, &self.ranks(&rect), scratch);
                (rect, (0..block.len()).map(|sample| scratch.depth(sample)).collect())
            })
            .collect();
        let mut depths = vec![f32::INFINITY; width as usize * height as usize];
        for (rect, own) in &tiles {
            for ((x, y), depth) in pixels_of(rect).zip(own) {
                depths[(y * width + x) as usize] = *depth;
            }
        }
        depths
    }

    /// The picture, band by band: filters of the screen work on each sample of all pixels of a band and of those that
    /// they reach around it.
    fn screen_filtered(&self, done: &(dyn Fn(u64) + Sync)) -> Result<Vec<[u8; 4]>, Error> {
        let [width, height] = self.plan.view.size;
        let reach = self.plan.screen_reach();
        let mut pixels = filled(width as usize * height as usize, [0; 4])?;
        let rows = (BAND_SAMPLES / width / self.plan.samples).saturating_sub(2 * reach).max(BAND);
        for first in (0..height).step_by(rows as usize) {
            let last = (first + rows).min(height);
            let around = PixelRect {
                min: [0, first.saturating_sub(reach)],
                max: [width, last.saturating_add(reach).min(height)],
            };
            let planes = self.planes(around)?;
            let inner = PixelRect { min: [0, first], max: [width, last] };
            let sums = screen::filtered(self.plan, planes, &inner);
            let samples = self.plan.samples as f32;
            let own = &mut pixels[first as usize * width as usize..];
            own.iter_mut().zip(sums).for_each(|(pixel, sum)| *pixel = self.finish(sum / samples));
            done(inner.area());
        }
        Ok(pixels)
    }

    /// What each sample of a rectangle's pixels sees, a plane for each sample of a pixel.
    fn planes(&self, rect: PixelRect) -> Result<Vec<Plane>, Error> {
        let side = self.samples_along();
        let mut planes: Vec<Plane> = (0..side * side).map(|sample| Plane::new(rect, sample, side)).collect();
        let traced: Result<Vec<(PixelRect, Vec<SampleSeen>)>, Error> = tiles_of(&rect, (BLOCK / side).max(1))
            .into_par_iter()
            .map_init(Scratch::default, |scratch, tile| {
                self.check_filter_work()?;
                let (block, ranks) = (Block { rect: tile, side }, self.ranks(&tile));
                self.tracer.trace(&block, &ranks, scratch);
                let samples = pixels_of(&tile).flat_map(|at| block.samples_of(at.into()));
                Ok((tile, samples.map(|sample| self.tracer.seen(sample, &ranks, scratch)).collect()))
            })
            .collect();
        for (tile, samples) in traced? {
            for ((x, y), seen) in pixels_of(&tile).zip(samples.chunks_exact(planes.len())) {
                for (plane, (color, visible)) in planes.iter_mut().zip(seen) {
                    plane.put(self.plan, [x, y], *color, visible);
                }
            }
        }
        Ok(planes)
    }

    /// Whether the user's own filters may go on.
    fn check_filter_work(&self) -> Result<(), Error> {
        if self.tracer.filter_iterations() > FILTER_ITERATIONS { Err(Error::FilterWork) } else { Ok(()) }
    }

    /// All tiles of a band.
    fn tiles(&self, band: PixelRect, wanted: Wanted, done: &(dyn Fn(u64) + Sync)) -> Result<Vec<TileResult>, Error> {
        let side = if wanted.colors { self.samples_along() } else { 1 };
        tiles_of(&band, (BLOCK / side).max(1))
            .into_par_iter()
            .map_init(Scratch::default, |scratch, rect| {
                self.check_filter_work()?;
                let result = self.tile(rect, wanted, scratch);
                done(rect.area());
                Ok(result)
            })
            .collect()
    }

    /// What the ray through a pixel's centre meets, with what lenses take away from it in front of the visible
    /// fragment. For single pixels: it looks at every triangle.
    pub fn explain(&self, x: u32, y: u32) -> PixelReport {
        let mut report = self.report(x, y);
        let end = report.visible.map_or(f32::INFINITY, |visible| visible.fragment.depth);
        report.removed = self.tracer.removed(f64::from(x) + 0.5, f64::from(y) + 0.5, &self.ranks_at(x, y), end);
        report
    }

    /// The same without what lenses take away, as fast as rendering the pixel.
    pub fn report(&self, x: u32, y: u32) -> PixelReport {
        let mut scratch = Scratch::default();
        let block = Block { rect: pixel_rect(x, y), side: 1 };
        self.tracer.trace(&block, &self.ranks(&block.rect), &mut scratch);
        self.tracer.report(0, &scratch)
    }

    /// What is visible at a pixel; `None` where nothing is and outside the picture.
    pub fn pick(&self, x: u32, y: u32) -> Option<Pick> {
        let visible = self.plan.view.has_pixel([x, y]).then(|| self.report(x, y).visible)??;
        Some(Pick::from_visible(self.plan, [x, y], &visible))
    }

    /// The layers of the rays through the pixel centres of a row, from left to right.
    pub fn row_layers(&self, y: u32) -> Vec<Vec<LayerStart>> {
        let view = &self.plan.view;
        let layers = |x: u32| {
            let volumes = self.ranks_at(x, y).into_iter().map(|rank| (rank, &self.plan.lenses[rank].volume));
            let mut layers = RayLayers::default();
            layers.find(volumes, &view.ray(f64::from(x) + 0.5, f64::from(y) + 0.5), view.near, view.far);
            layers.starts
        };
        (0..view.size[0]).map(layers).collect()
    }

    fn ranks_at(&self, x: u32, y: u32) -> Vec<usize> {
        self.ranks(&pixel_rect(x, y))
    }

    fn ranks(&self, rect: &PixelRect) -> Vec<usize> {
        (0..self.plan.lenses.len()).filter(|rank| self.plan.lenses[*rank].rect.overlaps(rect)).collect()
    }

    /// Samples along each side of a pixel.
    fn samples_along(&self) -> u32 {
        f64::from(self.plan.samples).sqrt().round().max(1.0) as u32
    }

    fn tile(&self, rect: PixelRect, wanted: Wanted, scratch: &mut Scratch) -> TileResult {
        let ranks = self.ranks(&rect);
        let mut result = TileResult { rect, pixels: Vec::new(), centers: Vec::new() };
        let mut block = Block { rect, side: self.samples_along() };
        if wanted.colors {
            self.tracer.trace(&block, &ranks, scratch);
            for (x, y) in pixels_of(&rect) {
                let colors = block.samples_of([x, y]).map(|sample| self.tracer.color(sample, &ranks, scratch));
                let sum = colors.fold(Vec4::ZERO, |sum, color| sum + color);
                result.pixels.push(self.finish(sum / (block.side * block.side) as f32));
            }
        }
        if wanted.maps {
            // The pixels' centres: traced already, if there is one sample a pixel.
            if !wanted.colors || block.side != 1 {
                block.side = 1;
                self.tracer.trace(&block, &ranks, scratch);
            }
            for sample in 0..block.len() {
                let report = self.tracer.report(sample, scratch);
                result.centers.push(Center { layers: report.layers.len() as u16, visible: report.visible });
            }
        }
        result
    }

    /// Puts a premultiplied linear colour over the background and encodes it.
    fn finish(&self, front: Vec4) -> [u8; 4] {
        let mut front = front;
        if front.w > 0.0 {
            // The background comes out as given.
            let mapped = g3(wgsl::tone_mapped(self.plan.tone_mapping, v3(front.truncate() / front.w)));
            front = (mapped * front.w).extend(front.w);
        }
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
        maps.instances[at] = visible.fragment.instance;
        maps.triangles[at] = visible.fragment.triangle;
        let item = self.plan.instances[visible.fragment.instance as usize].item;
        maps.nodes[at] = self.plan.items[item].node as u32 + 1;
        maps.depth[at] = self.plan.view.from_eye(f64::from(visible.fragment.depth));
        maps.normals[at] = visible.normal.to_array();
    }
}

/// The rectangles of another with sides of so many pixels.
fn tiles_of(rect: &PixelRect, side: u32) -> Vec<PixelRect> {
    let PixelRect { min, max } = *rect;
    let starts = |axis: usize| (min[axis]..max[axis]).step_by(side as usize);
    let tile = |x: u32, y: u32| PixelRect { min: [x, y], max: [(x + side).min(max[0]), (y + side).min(max[1])] };
    starts(1).flat_map(|y| starts(0).map(move |x| tile(x, y))).collect()
}

fn pixel_rect(x: u32, y: u32) -> PixelRect {
    PixelRect { min: [x, y], max: [x + 1, y + 1] }
}

fn pixels_of(rect: &PixelRect) -> impl Iterator<Item = (u32, u32)> + use<> {
    let PixelRect { min, max } = *rect;
    (min[1]..max[1]).flat_map(move |y| (min[0]..max[0]).map(move |x| (x, y)))
}
