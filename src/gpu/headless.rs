//! A device without a window: for the program and the tests.

use std::sync::{Arc, Mutex};
use std::time::Instant;

use super::job::Job;
use super::pipelines::PipelineStore;
use super::readback::{Readback, row_bytes};
use super::renderer::Renderer;
use super::targets::FRAGMENT_BYTES;
use super::upload::check_size;
use super::{AdapterChoice, Error, RenderOptions, Room, Window, alloc, aov, caps};
use crate::frame::{Aovs, Frame, RegionTable, check_memory, filled};
use crate::lens::LayerStart;
use crate::plan::Plan;
use crate::scene::Scene;

/// Pictures come back as these bytes.
const FORMAT: wgpu::TextureFormat = wgpu::TextureFormat::Rgba8Unorm;

/// Owns a device; renders and reads back.
#[derive(Debug)]
pub struct Headless {
    pub(super) device: wgpu::Device,
    pub(super) queue: wgpu::Queue,
    store: Arc<PipelineStore>,
    /// What the device reported outside of any call's result.
    reported: Arc<Mutex<Option<String>>>,
    /// Which adapter this is and why it was chosen.
    pub reason: String,
}

/// Wall-clock seconds of each stage, summed over samples and windows.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Timings {
    /// Upload of the plan; the first time also compilation of shaders.
    pub prepare: f64,
    pub layers: f64,
    pub visibility: f64,
    pub resolve: f64,
    pub readback: f64,
}

/// A picture in the making.
struct Picture {
    /// Of the whole.
    part: Window,
    pixels: Vec<[u8; 4]>,
    aovs: Option<Aovs>,
    table: RegionTable,
}

impl Headless {
    pub fn new(choice: &AdapterChoice) -> Result<Self, Error> {
        let adapter = &choice.adapter;
        let request = adapter.request_device(&wgpu::DeviceDescriptor {
            label: Some("lenspeel"),
            required_features: caps::wanted_features(adapter),
            required_limits: caps::required_limits(&adapter.limits()),
            ..Default::default()
        });
        let (device, queue) = pollster::block_on(request).map_err(|e| Error::Device(e.to_string()))?;
        let reported = Arc::new(Mutex::new(None));
        let first = reported.clone();
        device.on_uncaptured_error(Arc::new(move |error: wgpu::Error| {
            if let Ok(mut slot) = first.lock() {
                slot.get_or_insert(error.to_string());
            }
        }));
        let store = Arc::new(PipelineStore::new(&device, FORMAT));
        Ok(Self { device, queue, store, reported, reason: choice.reason.clone() })
    }

    /// The device and its queue, for work beside this.
    pub fn parts(&self) -> (&wgpu::Device, &wgpu::Queue) {
        (&self.device, &self.queue)
    }

    /// Uploads a scene for any number of renders.
    pub fn renderer(&self, scene: &Scene) -> Result<Renderer, Error> {
        let renderer = Renderer::with_store(&self.device, &self.queue, scene, self.store.clone())?;
        self.check()?;
        Ok(renderer)
    }

    /// The picture of a plan, in several windows if one would outgrow the device.
    pub fn render(&self, scene: &Scene, plan: &Plan, options: RenderOptions) -> Result<Frame, Error> {
        let mut renderer = self.renderer(scene)?;
        self.render_with(&mut renderer, scene, plan, options, &mut None)
    }

    /// The same with a renderer that has been made before. Times each stage when asked to, waiting for one after the other.
    pub fn render_with(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        options: RenderOptions,
        timings: &mut Option<Timings>,
    ) -> Result<Frame, Error> {
        let mut frame = self.render_part(renderer, scene, plan, Window::whole(&plan.view), options, timings)?;
        if plan.has_legend {
            crate::legend::draw(plan, &mut frame);
        }
        Ok(frame)
    }

    /// A part of the picture.
    pub(super) fn render_part(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        part: Window,
        options: RenderOptions,
        timings: &mut Option<Timings>,
    ) -> Result<Frame, Error> {
        check_memory(part.size, options.aovs)?;
        let mut picture = Picture {
            part,
            pixels: filled(part.pixels() as usize, [0; 4])?,
            aovs: options.aovs.then(|| Aovs::empty(part.size)).transpose()?,
            table: RegionTable::default(),
        };
        let mut windows = vec![part];
        while let Some(window) = windows.pop() {
            match self.render_window(renderer, scene, plan, window, options, timings, &mut picture) {
                Err(error) => windows.extend(smaller(&window, error)?),
                Ok(()) => continue,
            }
        }
        if let Some(aovs) = &mut picture.aovs {
            aovs.table = picture.table.table;
        }
        Ok(Frame { size: part.size, pixels: picture.pixels, aovs: picture.aovs })
    }

    /// The layers of the rays through the pixel centres of a window, row by row, as the device finds them.
    pub fn layers(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        window: Window,
    ) -> Result<Vec<Vec<LayerStart>>, Error> {
        loop {
            let job = renderer.prepare_layers(&self.device, scene, plan, window)?;
            let mut encoder = self.encoder();
            for sample in job.samples.iter().filter(|sample| sample.maps) {
                job.encode_layers(&mut encoder, sample);
            }
            let counts = Readback::of_buffer(&self.device, &mut encoder, &job.needed)?;
            let copy = Readback::of_buffer(&self.device, &mut encoder, &job.targets.layers)?;
            self.queue.submit([encoder.finish()]);
            let needed = Room::needed(&counts.bytes(&self.device)?);
            let bytes = copy.bytes(&self.device)?;
            self.check()?;
            if job.room.holds(needed) {
                let words: Vec<u32> =
                    bytes.chunks_exact(4).map(|b| u32::from_le_bytes([b[0], b[1], b[2], b[3]])).collect();
                return Ok(job.tiles.decode(&words, window.size, plan.view.near));
            }
            renderer.reserve(needed);
        }
    }

    #[expect(clippy::too_many_arguments, reason = "the parts of one call, handed on as they came")]
    fn render_window(
        &self,
        renderer: &mut Renderer,
        scene: &Scene,
        plan: &Plan,
        window: Window,
        options: RenderOptions,
        timings: &mut Option<Timings>,
        picture: &mut Picture,
    ) -> Result<(), Error> {
        // Filters of the screen look beyond the window.
        let drawn = window.grown(plan.screen_reach(), &picture.part);
        loop {
            let start = Instant::now();
            let job = renderer.prepare(&self.device, scene, plan, drawn, options)?;
            if let Some(timings) = timings {
                timings.prepare += start.elapsed().as_secs_f64();
            }
            let needed = self.draw(plan, &job, &window, timings, picture)?;
            if job.room.holds(needed) {
                return Ok(());
            }
            check_size(renderer.largest_buffer(), "the listed fragments", needed.fragments * FRAGMENT_BYTES)?;
            // A little more, so that the next frame of an animation fits, too.
            let fragments = (needed.fragments + needed.fragments / 8).min(renderer.largest_buffer() / FRAGMENT_BYTES);
            renderer.reserve(Room { fragments, ..needed });
        }
    }

    /// Draws at least a window into the picture and says how much room it needed; where it had less, the picture stays as it is.
    fn draw(
        &self,
        plan: &Plan,
        job: &Job,
        window: &Window,
        timings: &mut Option<Timings>,
        picture: &mut Picture,
    ) -> Result<Room, Error> {
        let target = self.target(job.window.size)?;
        let view = target.create_view(&Default::default());
        let mut stages = Stages { headless: self, encoder: None, timings };
        for sample in &job.samples {
            stages.run(|t| &mut t.layers, |e| job.encode_layers(e, sample))?;
            stages.run(|t| &mut t.visibility, |e| job.encode_visibility(e, sample))?;
            stages.run(|t| &mut t.resolve, |e| job.encode_resolve(e, sample, &view))?;
        }
        stages.end()?;
        let start = Instant::now();
        let mut encoder = self.encoder();
        let counts = Readback::of_buffer(&self.device, &mut encoder, &job.needed)?;
        let pixels = Readback::of_texture(&self.device, &mut encoder, &target)?;
        let maps = job.maps.as_ref().map(|maps| Readback::of_buffer(&self.device, &mut encoder, maps)).transpose()?;
        self.queue.submit([encoder.finish()]);
        let needed = Room::needed(&counts.bytes(&self.device)?);
        if job.room.holds(needed) {
            picture.store(window, &job.window, &pixels.bytes(&self.device)?);
            if let (Some(aovs), Some(maps)) = (&mut picture.aovs, maps) {
                aov::store(
                    aovs,
                    &mut picture.table,
                    plan,
                    &picture.part,
                    window,
                    &job.window,
                    job.words,
                    &maps.bytes(&self.device)?,
                );
            }
        }
        if let Some(timings) = timings {
            timings.readback += start.elapsed().as_secs_f64();
        }
        self.check()?;
        Ok(needed)
    }

    /// What the picture of a window is drawn into.
    pub(super) fn target(&self, [width, height]: [u32; 2]) -> Result<wgpu::Texture, Error> {
        let descriptor = wgpu::TextureDescriptor {
            label: Some("picture"),
            size: wgpu::Extent3d { width, height, depth_or_array_layers: 1 },
            mip_level_count: 1,
            sample_count: 1,
            dimension: wgpu::TextureDimension::D2,
            format: FORMAT,
            usage: wgpu::TextureUsages::RENDER_ATTACHMENT | wgpu::TextureUsages::COPY_SRC,
            view_formats: &[],
        };
        alloc::texture(&self.device, "the picture", &descriptor)
    }

    pub(super) fn encoder(&self) -> wgpu::CommandEncoder {
        self.device.create_command_encoder(&Default::default())
    }

    pub(super) fn wait(&self) -> Result<(), Error> {
        self.device.poll(wgpu::PollType::wait_indefinitely()).map_err(|e| Error::Lost(e.to_string()))?;
        self.check()
    }

    /// Fails when the device has reported something.
    pub(super) fn check(&self) -> Result<(), Error> {
        match self.reported.lock().map(|mut slot| slot.take()) {
            Ok(None) => Ok(()),
            Ok(Some(message)) => Err(Error::Lost(message)),
            Err(error) => Err(Error::Lost(error.to_string())),
        }
    }
}

/// Encodes stages into one submission, or each into its own when they are timed.
struct Stages<'a> {
    headless: &'a Headless,
    encoder: Option<wgpu::CommandEncoder>,
    timings: &'a mut Option<Timings>,
}

impl Stages<'_> {
    fn run(
        &mut self,
        slot: impl Fn(&mut Timings) -> &mut f64,
        encode: impl FnOnce(&mut wgpu::CommandEncoder),
    ) -> Result<(), Error> {
        let encoder = self.encoder.get_or_insert_with(|| self.headless.encoder());
        encode(encoder);
        if self.timings.is_some() {
            let start = Instant::now();
            self.end()?;
            if let Some(timings) = self.timings {
                *slot(timings) += start.elapsed().as_secs_f64();
            }
        }
        Ok(())
    }

    fn end(&mut self) -> Result<(), Error> {
        if let Some(encoder) = self.encoder.take() {
            self.headless.queue.submit([encoder.finish()]);
            self.headless.wait()?;
        }
        Ok(())
    }
}

impl Picture {
    /// Puts a window's rows where they belong; `drawn`: the window that the bytes are of, which holds it.
    fn store(&mut self, window: &Window, drawn: &Window, bytes: &[u8]) {
        let row = row_bytes(drawn.size[0]) as usize;
        let length = window.size[0] as usize;
        let first = 4 * (window.min[0] - drawn.min[0]) as usize;
        let rows = bytes.chunks_exact(row).skip((window.min[1] - drawn.min[1]) as usize);
        for (y, source) in (0..window.size[1]).zip(rows) {
            let start = self.part.place([window.min[0], window.min[1] + y]);
            self.pixels[start..start + length]
                .copy_from_slice(bytemuck::cast_slice(&source[first..first + 4 * length]));
        }
    }
}

/// The halves of a window that outgrew the device, the upper last so that it is drawn first; any other error stays one.
pub(super) fn smaller(window: &Window, error: Error) -> Result<[Window; 2], Error> {
    let is_whole = |what: &str| what.starts_with("the scene's") || what.starts_with("the plan's");
    let too_large = matches!(&error, Error::TooLarge { what, .. } | Error::NoRoom { what, .. } if !is_whole(what))
        || matches!(&error, Error::TextureTooLarge { name, .. } if name == "of the picture");
    match (too_large, window.halves()) {
        (true, Some([first, second])) => Ok([second, first]),
        _ => Err(error),
    }
}
