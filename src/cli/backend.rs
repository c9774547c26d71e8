//! Which backend renders, and one line on why.

#[cfg(feature = "gpu")]
use std::cell::Cell;

use super::args::{BackendChoice, EngineChoice};
use super::stages::Stages;
use crate::InputError;
use crate::cpu;
use crate::frame::{Aovs, Frame, InFront};
use crate::lens::LayerStart;
use crate::pick::Pick;
use crate::pixel::PixelReport;
use crate::plan::Plan;
use crate::scene::Scene;

/// A backend ready to render.
pub enum Backend {
    Cpu,
    #[cfg(feature = "gpu")]
    Gpu {
        device: Box<crate::gpu::Headless>,
        /// Where it cannot make a picture the CPU does: nobody asked for the GPU.
        or_cpu: bool,
        /// It could not.
        gave_up: Cell<bool>,
    },
}

/// Chooses as the user asked; the text says what and why.
#[cfg(feature = "gpu")]
pub fn choose(choice: BackendChoice) -> Result<(Backend, String), InputError> {
    use crate::gpu::{Headless, choose_hardware, choose_named};
    let fail = |e: crate::gpu::Error| InputError::new(e.to_string()).help("`--backend cpu` needs no graphics device");
    let gpu = |adapter: crate::gpu::AdapterChoice, or_cpu: bool| {
        let device = Box::new(Headless::new(&adapter)?);
        Ok((Backend::Gpu { device, or_cpu, gave_up: Cell::new(false) }, format!("gpu: {}", adapter.reason)))
    };
    match choice {
        BackendChoice::Cpu => Ok((Backend::Cpu, "cpu: it was asked for".into())),
        BackendChoice::Gpu => choose_named(None).and_then(|adapter| gpu(adapter, false)).map_err(fail),
        BackendChoice::Auto => Ok(choose_hardware()
            .and_then(|adapter| gpu(adapter, true))
            .unwrap_or_else(|reason| (Backend::Cpu, format!("cpu: {reason}")))),
    }
}

/// Chooses as the user asked; the text says what and why.
#[cfg(not(feature = "gpu"))]
pub fn choose(choice: BackendChoice) -> Result<(Backend, String), InputError> {
    match choice {
        BackendChoice::Cpu => Ok((Backend::Cpu, "cpu: it was asked for".into())),
        BackendChoice::Auto => Ok((Backend::Cpu, "cpu: this program was built without the `gpu` feature".into())),
        BackendChoice::Gpu => Err(InputError::new("this program was built without the `gpu` feature")
            .help("build it with default features, or use `--backend cpu`")),
    }
}

impl Backend {
    /// The picture. An engine is a matter of the GPU; where the CPU renders, a note says so.
    pub fn render(
        &self,
        scene: &Scene,
        plan: &Plan,
        engine: Option<EngineChoice>,
        aovs: bool,
        stages: &mut Stages,
    ) -> Result<Frame, InputError> {
        #[cfg(feature = "gpu")]
        if let Some(device) = self.device() {
            let engine = match engine {
                None | Some(EngineChoice::Fused) => crate::gpu::Engine::Fused,
                Some(EngineChoice::Peel) => crate::gpu::Engine::Peel,
            };
            match on_gpu(device, scene, plan, engine, aovs, stages) {
                Ok(frame) => return Ok(frame),
                Err(error) => self.give_up(error)?,
            }
            return on_cpu(scene, plan, aovs, stages);
        }
        if engine.is_some() {
            eprintln!("note: --engine is about the GPU, and the CPU renders");
        }
        on_cpu(scene, plan, aovs, stages)
    }
}

#[cfg(feature = "gpu")]
impl Backend {
    /// The device, as long as it makes pictures.
    fn device(&self) -> Option<&crate::gpu::Headless> {
        match self {
            Backend::Gpu { device, gave_up, .. } if !gave_up.get() => Some(device),
            _ => None,
        }
    }

    /// Leaves the picture, and all that follows, to the CPU, if that may take over; one line says so.
    fn give_up(&self, error: crate::gpu::Error) -> Result<(), InputError> {
        match self {
            Backend::Gpu { or_cpu: true, gave_up, .. } => {
                eprintln!("cpu: the GPU cannot make this picture: {error}");
                gave_up.set(true);
                Ok(())
            }
            _ => Err(no_picture(error)),
        }
    }
}

/// What lies in front of what is visible, which the CPU finds whoever renders.
pub fn in_front(scene: &Scene, plan: &Plan) -> Result<InFront, InputError> {
    Ok(cpu::Renderer::new(scene, plan)?.in_front()?)
}

impl Backend {
    /// In a word.
    pub fn name(&self) -> &'static str {
        #[cfg(feature = "gpu")]
        if self.device().is_some() {
            return "gpu";
        }
        "cpu"
    }

    /// What lies at the centre of each pixel.
    pub fn maps(&self, scene: &Scene, plan: &Plan, stages: &mut Stages) -> Result<Aovs, InputError> {
        #[cfg(feature = "gpu")]
        if let Some(device) = self.device() {
            match on_gpu(device, scene, plan, crate::gpu::Engine::Fused, true, stages) {
                Ok(frame) => return Ok(frame.aovs.unwrap_or_default()),
                Err(error) => self.give_up(error)?,
            }
        }
        let renderer = stages.time("bvh", || cpu::Renderer::new(scene, plan))?;
        let bar = super::stages::progress(plan.view.size.iter().map(|s| u64::from(*s)).product());
        let maps = stages.time("render", || renderer.maps(&|done| bar.inc(done)));
        bar.finish_and_clear();
        Ok(maps?)
    }

    /// What the ray through a pixel's centre meets.
    pub fn explain(&self, scene: &Scene, plan: &Plan, [x, y]: [u32; 2]) -> Result<PixelReport, InputError> {
        #[cfg(feature = "gpu")]
        if let Some(device) = self.device() {
            let report = |mut renderer| device.explain(&mut renderer, scene, plan, [x, y]);
            match device.renderer(scene).and_then(report) {
                Ok(report) => return Ok(report),
                Err(error) => self.give_up(error)?,
            }
        }
        Ok(cpu::Renderer::new(scene, plan)?.explain(x, y))
    }

    /// What is visible at a pixel.
    pub fn pick(&self, scene: &Scene, plan: &Plan, [x, y]: [u32; 2]) -> Result<Option<Pick>, InputError> {
        #[cfg(feature = "gpu")]
        if let Some(device) = self.device() {
            let pick = |mut renderer| device.pick(&mut renderer, scene, plan, [x, y]);
            match device.renderer(scene).and_then(pick) {
                Ok(pick) => return Ok(pick),
                Err(error) => self.give_up(error)?,
            }
        }
        Ok(cpu::Renderer::new(scene, plan)?.pick(x, y))
    }

    /// The layers of the rays through the pixel centres of a row.
    pub fn row_layers(&self, scene: &Scene, plan: &Plan, row: u32) -> Result<Vec<Vec<LayerStart>>, InputError> {
        #[cfg(feature = "gpu")]
        if let Some(device) = self.device() {
            let window = crate::gpu::Window { min: [0, row], size: [plan.view.size[0], 1] };
            let layers = |mut renderer| device.layers(&mut renderer, scene, plan, window);
            match device.renderer(scene).and_then(layers) {
                Ok(layers) => return Ok(layers),
                Err(error) => self.give_up(error)?,
            }
        }
        Ok(cpu::Renderer::new(scene, plan)?.row_layers(row))
    }
}

#[cfg(feature = "gpu")]
fn no_picture(error: crate::gpu::Error) -> InputError {
    InputError::new(format!("the GPU cannot make this picture: {error}"))
        .help("try a smaller `--size`, or `--backend cpu`")
}

fn on_cpu(scene: &Scene, plan: &Plan, aovs: bool, stages: &mut Stages) -> Result<Frame, InputError> {
    let renderer = stages.time("bvh", || cpu::Renderer::new(scene, plan))?;
    let pixels = plan.view.size.iter().map(|s| u64::from(*s)).product();
    let bar = super::stages::progress(pixels);
    let frame = stages.time("render", || renderer.render(aovs, &|done| bar.inc(done)));
    bar.finish_and_clear();
    Ok(frame?)
}

#[cfg(feature = "gpu")]
fn on_gpu(
    device: &crate::gpu::Headless,
    scene: &Scene,
    plan: &Plan,
    engine: crate::gpu::Engine,
    aovs: bool,
    stages: &mut Stages,
) -> Result<Frame, crate::gpu::Error> {
    use crate::gpu::{RenderOptions, Timings};
    let mut renderer = stages.time("setup", || device.renderer(scene))?;
    let mut timings = Some(Timings::default());
    let frame = device.render_with(&mut renderer, scene, plan, RenderOptions { engine, aovs }, &mut timings)?;
    if let Some(t) = timings {
        for (name, seconds) in [
            ("prepare", t.prepare),
            ("layers", t.layers),
            ("visibility", t.visibility),
            ("resolve", t.resolve),
            ("readback", t.readback),
        ] {
            stages.note(name, seconds);
        }
    }
    Ok(frame)
}

#[cfg(all(test, feature = "gpu"))]
mod tests {
    use super::*;

    #[test]
    fn the_cpu_takes_over_only_where_nobody_asked_for_the_gpu() {
        let Ok(adapter) = crate::gpu::choose_named(None) else { return };
        let device = Box::new(crate::gpu::Headless::new(&adapter).expect("the device opens"));
        let text = "[scene]\nfile = \"none.glb\"\n[image]\nsize = [8, 6]\nsamples = 1";
        let spec = crate::spec::Spec::parse(text, "test.toml", std::path::Path::new("")).expect("a spec");
        let scene = Scene::new(vec![crate::scene::Model::default()], Vec::new());
        let plan = Plan::new(&spec, &scene).expect("a plan");
        // A renderer fails for good on a plan of another scene; the CPU then says what is wrong in its own words.
        let other = Scene::new(vec![crate::scene::Model::default()], Vec::new());
        let mut backend = Backend::Gpu { device, or_cpu: false, gave_up: Cell::new(false) };
        let error = backend.maps(&other, &plan, &mut Stages::default()).expect_err("another scene");
        assert!(error.message.starts_with("the GPU cannot make this picture"), "{error}");
        assert_eq!(backend.name(), "gpu");
        if let Backend::Gpu { or_cpu, .. } = &mut backend {
            *or_cpu = true;
        }
        let error = backend.maps(&other, &plan, &mut Stages::default()).expect_err("another scene");
        assert!(error.message.starts_with("the plan was made for another scene"), "{error}");
        assert_eq!(backend.name(), "cpu");
        assert!(backend.maps(&scene, &plan, &mut Stages::default()).is_ok(), "the CPU goes on");
    }
}
