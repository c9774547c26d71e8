//! The long-lived renderer of one scene on one device, and the frames that it encodes.

use std::sync::Arc;

use super::bindings;
use super::cut_data;
use super::draws::{self, Draw, Skip};
use super::frame::{self, FrameShape, Place, Sample};
use super::item_data::ItemData;
use super::job::{CapSteps, ComputeSteps, ExplainPass, Groups, Job, ResolvePipelines};
use super::lens_data::LensData;
use super::pipelines::{PipelineStore, Pipelines, Program};
use super::plan_group::{PlanContents, PlanGroup};
use super::planes::Planes;
use super::records::FrameRecord;
use super::room::COUNTERS;
use super::screen_job::ScreenJob;
use super::targets::{FRAGMENT_BYTES, ScreenTargets, TargetSizes, Targets, work_buffer};
use super::tiles::Tiles;
use super::upload::{SceneData, largest_buffer};
use super::{Engine, Error, Needs, RenderOptions, Room, Window, aov, caps};
use crate::custom::{self, Custom};
use crate::lens::PixelRect;
use crate::plan::Plan;
use crate::scene::Scene;

/// Draws plans over one scene. Built once; a frame uploads the plan and nothing of the scene.
///
/// It borrows device, queue, encoder and target, and never submits, polls or owns a surface.
#[derive(Debug)]
pub struct Renderer {
    store: Arc<PipelineStore>,
    scene: SceneData,
    targets: Option<Arc<Targets>>,
    /// The most room that was needed so far.
    reserved: Room,
    /// Bytes.
    largest_buffer: u64,
}

/// What a frame is for.
#[derive(Clone, Copy)]
enum Work {
    Picture,
    Layers,
    /// The nearest one behind a place, whatever the lenses make of it.
    Fragment(Place),
}

impl Work {
    fn after(self) -> Option<Place> {
        match self {
            Work::Fragment(after) => Some(after),
            Work::Picture | Work::Layers => None,
        }
    }
}

/// What pictures are drawn into: colours come out encoded, in eight bits.
const TARGET_FORMATS: [wgpu::TextureFormat; 4] = [
    wgpu::TextureFormat::Rgba8Unorm,
    wgpu::TextureFormat::Rgba8UnormSrgb,
    wgpu::TextureFormat::Bgra8Unorm,
    wgpu::TextureFormat::Bgra8UnormSrgb,
];

/// What a host can learn about a frame after it has submitted it.
#[derive(Debug)]
pub struct Encoded {
    /// What the frame needed, for [`Room::needed`]; where `room` does not hold it, the picture is not right and the
    /// frame must be drawn again after [`Renderer::reserve`].
    pub needed: wgpu::Buffer,
    pub room: Room,
}

impl Renderer {
    /// Uploads a scene. `target_format`: of the views that pictures are drawn into; 8-bit, sRGB or not.
    pub fn new(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        target_format: wgpu::TextureFormat,
    ) -> Result<Self, Error> {
        if !TARGET_FORMATS.contains(&target_format) {
            let wanted = format!("pictures are drawn into {TARGET_FORMATS:?}");
            return Err(Error::TargetFormat { format: format!("{target_format:?}"), wanted });
        }
        caps::check_limits(device)?;
        Self::with_store(device, queue, scene, Arc::new(PipelineStore::new(device, target_format)))
    }

    /// The same with pipelines that other scenes use, too.
    pub(super) fn with_store(
        device: &wgpu::Device,
        queue: &wgpu::Queue,
        scene: &Scene,
        store: Arc<PipelineStore>,
    ) -> Result<Self, Error> {
        let scene = SceneData::new(device, queue, &store.layouts.scene, scene)?;
        let largest_buffer = largest_buffer(device);
        Ok(Self { store, scene, targets: None, reserved: Room::FIRST, largest_buffer })
    }

    /// Encodes a whole picture of a plan into `target`, which is as large as the plan's view.
    pub fn render(
        &mut self,
        device: &wgpu::Device,
        encoder: &mut wgpu::CommandEncoder,
        target: &wgpu::TextureView,
        scene: &Scene,
        plan: &Plan,
        options: RenderOptions,
    ) -> Result<Encoded, Error> {
        self.check_target(target.texture(), plan)?;
        let job = self.prepare(device, scene, plan, Window::whole(&plan.view), options)?;
        for sample in &job.samples {
            job.encode_layers(encoder, sample);
            job.encode_visibility(encoder, sample);
            job.encode_resolve(encoder, sample, target);
        }
        Ok(Encoded { needed: job.needed, room: job.room })
    }

    /// Whether a texture is such as pictures of a plan are drawn into. A view may show any of its mip levels.
    fn check_target(&self, target: &wgpu::Texture, plan: &Plan) -> Result<(), Error> {
        let picture = plan.view.size;
        let level = |level: u32| [target.width(), target.height()].map(|side| (side >> level).max(1));
        if !(0..target.mip_level_count()).any(|number| level(number) == picture) {
            return Err(Error::TargetSize { target: level(0), picture });
        }
        let (own, wanted) = (target.format(), self.store.target);
        if own.remove_srgb_suffix() != wanted.remove_srgb_suffix() {
            let wanted = format!("the renderer was made for {wanted:?}");
            return Err(Error::TargetFormat { format: format!("{own:?}"), wanted });
        }
        Ok(())
    }

    /// Allows no buffer of a frame to be larger than so many bytes, to leave memory to others; never more than the
    /// device allows.
    pub fn limit_buffers(&mut self, bytes: u64) {
        self.largest_buffer = self.largest_buffer.min(bytes);
    }

    /// Bytes that one buffer of a frame may have.
    pub fn largest_buffer(&self) -> u64 {
        self.largest_buffer
    }

    /// Makes at least so much room from the next frame on.
    pub fn reserve(&mut self, room: Room) {
        self.reserved = self.reserved.max(room);
    }

    /// The room that the next frame has at least.
    pub fn reserved(&self) -> Room {
        self.reserved
    }

    /// Uploads a plan and checks that its frame fits the device.
    pub(super) fn prepare(
        &mut self,
        device: &wgpu::Device,
        scene: &Scene,
        plan: &Plan,
        window: Window,
        options: RenderOptions,
    ) -> Result<Job, Error> {
        self.prepare_work(device, scene, plan, window, options, Work::Picture)
    }

    /// Prepares what finds the layers of the rays of pixel centres, and draws nothing.
    pub(super) fn prepare_layers(
        &mut self,
        device: &wgpu::Device,
        scene: &Scene,
        plan: &Plan,
        window: Window,
    ) -> Result<Job, Error> {
        let options = RenderOptions { aovs: true, ..RenderOptions::default() };
        self.prepare_work(device, scene, plan, window, options, Work::Layers)
    }

    /// Prepares a frame that draws the nearest fragment behind a place, whatever the lenses make of it.
    pub(super) fn prepare_next_behind(
        &mut self,
        device: &wgpu::Device,
        scene: &Scene,
        plan: &Plan,
        window: Window,
        after: Place,
    ) -> Result<Job, Error> {
        let options = RenderOptions { aovs: true, ..RenderOptions::default() };
        self.prepare_work(device, scene, plan, window, options, Work::Fragment(after))
    }

    /// What classifies and shades the fragment of a frame of one pixel, into so many bytes.
    pub(super) fn explain_pass(&self, device: &wgpu::Device, job: &Job, bytes: u64) -> Result<ExplainPass, Error> {
        let buffer = work_buffer(device, self.largest_buffer, "fragment of a pixel", bytes)?;
        let group = self.resolve_group(device, &job.targets, buffer.as_entire_binding());
        Ok(ExplainPass { pipeline: job.accounts.explain(&self.store), group, buffer })
    }

    fn prepare_work(
        &mut self,
        device: &wgpu::Device,
        scene: &Scene,
        plan: &Plan,
        window: Window,
        options: RenderOptions,
        work: Work,
    ) -> Result<Job, Error> {
        if scene.id != self.scene.id {
            return Err(Error::OtherScene { what: "the renderer's" });
        }
        if plan.scene != scene.id {
            return Err(Error::OtherScene { what: "the one that is drawn" });
        }
        let planes = Planes::new(scene, plan, &self.scene);
        let needs = Needs::of(scene, plan, !planes.is_empty());
        // Maps count layers, and peeling goes from one to the next, whether the picture asks for them or not.
        let cuts_layers = needs.layers || options.aovs || options.engine == Engine::Peel;
        let words = needs.set_words;
        let tiles = Tiles::new(plan, &window, words, self.reserved.crossings);
        let sizes = TargetSizes {
            summed: if plan.samples > 1 { window.pixels() } else { 0 },
            layer_words: if cuts_layers { tiles.layer_words } else { 0 },
            heads: window.pixels() * if needs.caps { 2 } else { 1 },
            fragments: self.reserved.fragments.max(first_guess(plan, &window)),
            screen: needs.screen.then_some(words),
        };
        let targets = self.targets(device, &window, &sizes)?;
        let room = Room { fragments: targets.fragments.size() / FRAGMENT_BYTES, ..self.reserved };
        let samples = frame::samples(plan, options.aovs);
        let passes = frame::passes(options.engine, &tiles);
        let record_stride = record_stride(device);
        let shape = FrameShape {
            plan,
            window,
            tiles: &tiles,
            fragment_capacity: room.fragments.min(u64::from(u32::MAX)) as u32,
            target_is_srgb: self.store.target.is_srgb(),
            after: work.after(),
        };
        let frames = frame_bytes(&shape, &samples, passes, record_stride);
        let counters = 4 * COUNTERS * samples.len() as u64;
        let needed = work_buffer(device, self.largest_buffer, "counters of samples", counters)?;
        let maps = options
            .aovs
            .then(|| work_buffer(device, self.largest_buffer, "maps of pixel centres", aov::bytes(&window, words)))
            .transpose()?;
        let mut lenses = LensData::new(plan, words, &tiles.cells, room.crossings);
        let cuts = cut_data::push_cuts(scene, plan, &self.scene, &mut lenses.parts.words);
        let plane_words = planes.push(&mut lenses.parts.words);
        let PlanGroup { group, items } = PlanContents {
            plan,
            frames: &frames,
            items: &ItemData::new(scene, plan, &self.scene, words, &cuts, &plane_words),
            lenses: &lenses,
            tiles: &tiles.words,
        }
        .upload(device, &self.store.layouts.plan, self.largest_buffer)?;
        let draws_picture = matches!(work, Work::Picture);
        // What they were made for may have needed more.
        let of_screen = targets.screen.as_ref().filter(|_| needs.screen && draws_picture);
        let screen = of_screen.map(|of_screen| self.screen(device, plan, needs, of_screen, &targets.accumulated));
        let screen = screen.transpose()?;
        let resolved = of_screen.map_or(&targets.accumulated, |of_screen| &of_screen.samples);
        let groups = self.groups(device, group, &targets, &needed, maps.as_ref(), resolved);
        let skip = if work.after().is_some() { Skip::Nothing } else { Skip::WhatIsGone };
        // Compiled side by side where they are new.
        let (store, custom) = (&self.store, &custom_text(plan));
        let pipelines = store.get(needs, custom);
        let accounts = store.get(needs.for_accounts(), custom);
        let ((draws, caps, layers), (aov, resolve)) = rayon::join(
            || {
                let layers = cuts_layers.then(|| pipelines.layers(store));
                if matches!(work, Work::Layers) {
                    return (Vec::new(), None, layers);
                }
                let program = program_of(options.engine, work.after().is_some());
                let draws = self.draws(scene, plan, &window, (skip, &planes), program, &pipelines);
                let caps = needs.caps.then(|| {
                    let lids = cut_data::lid_draws(scene, plan, &window);
                    CapSteps {
                        draws: cut_data::draws(plan, &window, &self.scene),
                        crossings: pipelines.crossings(store),
                        lids: (!lids.is_empty()).then(|| (lids, pipelines.lids(store))),
                        find: pipelines.find_caps(store),
                    }
                });
                (draws, caps, layers)
            },
            || {
                if !draws_picture {
                    return (None, None);
                }
                let aov = options.aovs.then(|| accounts.aov(store));
                let of_sample = || ResolvePipelines::Sample(pipelines.resolve_sample(store));
                let of_tiles = || {
                    let outside = || store.get(needs.outside(plan), custom).resolve(store);
                    let (inside, outside) = rayon::join(|| pipelines.resolve(store), outside);
                    ResolvePipelines::Tiles { inside, outside }
                };
                (aov, Some(if needs.screen { of_sample() } else { of_tiles() }))
            },
        );
        Ok(Job {
            samples,
            window,
            needed,
            room,
            maps,
            words,
            passes,
            tiles,
            record_stride,
            draws,
            caps,
            positions: self.scene.positions.clone(),
            indices: self.scene.indices.clone(),
            items,
            compute: ComputeSteps { layers, aov },
            accounts,
            resolve,
            screen,
            targets,
            groups,
        })
    }

    fn screen(
        &self,
        device: &wgpu::Device,
        plan: &Plan,
        needs: Needs,
        targets: &ScreenTargets,
        accumulated: &wgpu::Buffer,
    ) -> Result<ScreenJob, Error> {
        let pipelines = self.store.get(needs, &custom_text(plan)).screen(&self.store);
        ScreenJob::new(device, plan, pipelines, &self.store.layouts.screen, targets, accumulated)
    }

    /// The draws of a plan, each with the pipeline that draws it.
    fn draws(
        &self,
        scene: &Scene,
        plan: &Plan,
        window: &Window,
        (skip, planes): (Skip, &Planes),
        program: impl Fn(&Draw) -> Program,
        pipelines: &Pipelines,
    ) -> Vec<(Draw, wgpu::RenderPipeline)> {
        draws::draws(scene, plan, window, &self.scene, skip, planes)
            .into_iter()
            .map(|draw| {
                let pipeline = pipelines.draw(&self.store, program(&draw), draw.culling);
                (draw, pipeline)
            })
            .collect()
    }

    fn targets(&mut self, device: &wgpu::Device, window: &Window, sizes: &TargetSizes) -> Result<Arc<Targets>, Error> {
        if let Some(targets) = self.targets.as_ref().filter(|targets| targets.fits(window, sizes)) {
            return Ok(targets.clone());
        }
        // The old ones first, or both would be held at once.
        self.targets = None;
        let targets = Arc::new(Targets::new(device, self.largest_buffer, window, sizes)?);
        self.targets = Some(targets.clone());
        Ok(targets)
    }

    /// `resolved`: what samples are composited into.
    fn groups(
        &self,
        device: &wgpu::Device,
        plan: wgpu::BindGroup,
        targets: &Targets,
        needed: &wgpu::Buffer,
        maps: Option<&wgpu::Buffer>,
        resolved: &wgpu::Buffer,
    ) -> Groups {
        let layers = || targets.layers.as_entire_binding();
        let heads = || targets.heads.as_entire_binding();
        let fragments = || targets.fragments.as_entire_binding();
        let counters = || needed.as_entire_binding();
        Groups {
            scene: self.scene.bind_group.clone(),
            plan,
            layers: bindings::group(device, "layers", &self.store.layouts.layers, &[layers(), counters()]),
            visibility: bindings::group(
                device,
                "visibility",
                &self.store.layouts.visibility,
                &[layers(), heads(), fragments(), counters()],
            ),
            resolve: self.resolve_group(device, targets, resolved.as_entire_binding()),
            maps: maps.map(|maps| self.resolve_group(device, targets, maps.as_entire_binding())),
        }
    }

    /// What a pass over the fragments of each pixel works on, and what it writes.
    fn resolve_group(
        &self,
        device: &wgpu::Device,
        targets: &Targets,
        output: wgpu::BindingResource<'_>,
    ) -> wgpu::BindGroup {
        let buffers = [&targets.layers, &targets.heads, &targets.fragments].map(wgpu::Buffer::as_entire_binding);
        let [layers, heads, fragments] = buffers;
        let ids = wgpu::BindingResource::TextureView(&targets.ids);
        bindings::group(device, "resolve", &self.store.layouts.resolve, &[layers, heads, fragments, ids, output])
    }
}

/// The user's own filters of a plan, as WGSL.
fn custom_text(plan: &Plan) -> Arc<str> {
    let customs: Vec<&Custom> = plan.customs.iter().map(Arc::as_ref).collect();
    custom::wgsl(&customs).into()
}

/// Which fragment function draws each item.
fn program_of(engine: Engine, next_behind: bool) -> impl Fn(&Draw) -> Program {
    move |draw| match engine {
        _ if next_behind => Program::NextBehind,
        Engine::Fused if draw.plain => Program::Plain,
        Engine::Fused if draw.in_planes => Program::FusedInPlanes,
        Engine::Fused => Program::Fused,
        Engine::Peel if draw.in_planes => Program::PeelInPlanes,
        Engine::Peel => Program::Peel,
    }
}

/// Fragments to make room for at first: two a pixel where something may be translucent.
fn first_guess(plan: &Plan, window: &Window) -> u64 {
    let pixels = window.pixels();
    // A rule may hold anywhere.
    if plan.items.iter().any(|item| item.translucent) || plan.rules.iter().any(|rule| rule.translucent) {
        return 2 * pixels;
    }
    let lenses = plan.lenses.iter().filter(|lens| lens.translucent);
    // Each ray that goes into something goes out again.
    let cut = plan.bodies.iter().map(|body| cut_data::cut_rect(plan, body)).reduce(PixelRect::union);
    let cut = cut.map_or(0, |rect| 4 * window.local(&rect).area());
    (cut + 2 * lenses.map(|lens| window.local(&lens.rect).area()).sum::<u64>()).clamp(64, 4 * pixels.max(16))
}

/// Bytes from one record to the next.
fn record_stride(device: &wgpu::Device) -> u32 {
    (size_of::<FrameRecord>() as u32).next_multiple_of(device.limits().min_storage_buffer_offset_alignment)
}

fn frame_bytes(shape: &FrameShape, samples: &[Sample], passes: u32, stride: u32) -> Vec<u8> {
    let mut bytes = Vec::new();
    for sample in samples {
        for layer in 0..passes {
            bytes.extend_from_slice(bytemuck::bytes_of(&shape.record(sample, layer)));
            bytes.resize(bytes.len().next_multiple_of(stride as usize), 0);
        }
    }
    bytes
}
