//! Which backend renders, and one line on why.

use std::fmt;
use std::rc::Rc;

use super::args::{BackendChoice, EngineChoice};
use super::stages::Stages;
#[cfg(feature = "gpu")]
use super::streams::Messages;
use crate::InputError;
use crate::cpu;
use crate::frame::{Aovs, Frame, InFront};
#[cfg(feature = "gpu")]
use crate::gpu::{Engine, Error, Headless, RenderOptions, Renderer, Timings, Window};
use crate::lens::LayerStart;
use crate::pick::Pick;
use crate::pixel::PixelReport;
use crate::plan::Plan;
use crate::scene::Scene;

/// What renders, and why.
pub struct Backend {
    #[cfg(feature = "gpu")]
    gpu: Option<Gpu>,
    pub reason: String,
}

#[cfg(feature = "gpu")]
struct Gpu {
    device: Box<Headless>,
    /// Where it cannot make a picture the CPU does: nobody asked for the GPU.
    or_cpu: bool,
}

/// Chooses as the user asked.
#[cfg(feature = "gpu")]
pub fn choose(choice: BackendChoice) -> Result<Backend, InputError> {
    use crate::gpu::{AdapterChoice, choose_hardware, choose_named};
    let gpu = |adapter: AdapterChoice, or_cpu: bool| {
        let device = Box::new(Headless::new(&adapter)?);
        Ok(Backend { gpu: Some(Gpu { device, or_cpu }), reason: adapter.reason })
    };
    match choice {
        BackendChoice::Cpu => Ok(Backend::cpu("it was asked for")),
        BackendChoice::Gpu => choose_named(None).and_then(|adapter| gpu(adapter, false)).map_err(|error: Error| {
            InputError::new(error.to_string()).help("`--backend cpu` needs no graphics device")
        }),
        BackendChoice::Auto => {
            let chosen = choose_hardware().and_then(|adapter| gpu(adapter, true));
            Ok(chosen.unwrap_or_else(|error| Backend::cpu(error.to_string())))
        }
    }
}

/// Chooses as the user asked.
#[cfg(not(feature = "gpu"))]
pub fn choose(choice: BackendChoice) -> Result<Backend, InputError> {
    match choice {
        BackendChoice::Cpu => Ok(Backend::cpu("it was asked for")),
        BackendChoice::Auto => Ok(Backend::cpu("this program was built without the `gpu` feature")),
        BackendChoice::Gpu => Err(InputError::new("this program was built without the `gpu` feature")
            .help("build it with default features, or use `--backend cpu`")),
    }
}

impl Backend {
    pub fn cpu(reason: impl Into<String>) -> Self {
        Self {
            #[cfg(feature = "gpu")]
            gpu: None,
            reason: reason.into(),
        }
    }

    /// In a word.
    pub fn name(&self) -> &'static str {
        #[cfg(feature = "gpu")]
        if self.gpu.is_some() {
            return "gpu";
        }
        "cpu"
    }

    /// Leaves the picture, and all that follows, to the CPU, if that may take over; one line says so.
    #[cfg(feature = "gpu")]
    fn give_up(&mut self, error: Error, messages: Messages) -> Result<(), InputError> {
        let reason = format!("the GPU cannot make this picture: {error}");
        if !self.gpu.as_ref().is_some_and(|gpu| gpu.or_cpu) {
            return Err(InputError::new(reason).help("try a smaller `--size`, or `--backend cpu`"));
        }
        *self = Self::cpu(reason);
        messages.note(&*self);
        Ok(())
    }
}

impl fmt::Display for Backend {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}", self.name(), self.reason)
    }
}

/// A backend at work on a plan. What only the CPU finds it finds whoever renders.
pub struct Session<'a> {
    pub backend: Backend,
    pub stages: Stages,
    scene: &'a Scene,
    plan: &'a Plan,
    /// Made when they are first needed.
    cpu: Option<Rc<cpu::Renderer<'a>>>,
    #[cfg(feature = "gpu")]
    gpu: Option<Renderer>,
}

impl<'a> Session<'a> {
    pub fn new(backend: Backend, scene: &'a Scene, plan: &'a Plan, stages: Stages) -> Self {
        Self {
            backend,
            stages,
            scene,
            plan,
            cpu: None,
            #[cfg(feature = "gpu")]
            gpu: None,
        }
    }

    /// The picture. An engine is a matter of the GPU; where the CPU renders, a note says so.
    pub fn render(&mut self, engine: Option<EngineChoice>, aovs: bool) -> Result<Frame, InputError> {
        #[cfg(feature = "gpu")]
        if let Some(frame) = self.frame_on_gpu(engine.unwrap_or(EngineChoice::Fused), aovs)? {
            return Ok(frame);
        }
        if engine.is_some() {
            self.stages.messages.note("note: --engine is about the GPU, and the CPU renders");
        }
        self.on_all_pixels(|renderer, done| renderer.render(aovs, done))
    }

    /// What lies at the centre of each pixel.
    pub fn maps(&mut self) -> Result<Aovs, InputError> {
        #[cfg(feature = "gpu")]
        if let Some(frame) = self.frame_on_gpu(EngineChoice::Fused, true)? {
            return Ok(frame.aovs.unwrap_or_default());
        }
        self.on_all_pixels(|renderer, done| renderer.maps(done))
    }

    /// What the ray through a pixel's centre meets.
    pub fn explain(&mut self, [x, y]: [u32; 2]) -> Result<PixelReport, InputError> {
        #[cfg(feature = "gpu")]
        if let Some(report) =
            self.on_gpu(|device, renderer, scene, plan, _| device.explain(renderer, scene, plan, [x, y]))?
        {
            return Ok(report);
        }
        Ok(self.cpu()?.explain(x, y))
    }

    /// What is visible at a pixel.
    pub fn pick(&mut self, [x, y]: [u32; 2]) -> Result<Option<Pick>, InputError> {
        #[cfg(feature = "gpu")]
        if let Some(pick) =
            self.on_gpu(|device, renderer, scene, plan, _| device.pick(renderer, scene, plan, [x, y]))?
        {
            return Ok(pick);
        }
        Ok(self.cpu()?.pick(x, y))
    }

    /// The layers of the rays through the pixel centres of a row.
    pub fn row_layers(&mut self, row: u32) -> Result<Vec<Vec<LayerStart>>, InputError> {
        #[cfg(feature = "gpu")]
        {
            let window = Window { min: [0, row], size: [self.plan.view.size[0], 1] };
            let layers =
                self.on_gpu(|device, renderer, scene, plan, _| device.layers(renderer, scene, plan, window))?;
            if let Some(layers) = layers {
                return Ok(layers);
            }
        }
        Ok(self.cpu()?.row_layers(row))
    }

    /// What lies in front of what is visible, which the CPU finds.
    pub fn in_front(&mut self) -> Result<InFront, InputError> {
        Ok(self.cpu()?.in_front()?)
    }

    fn cpu(&mut self) -> Result<Rc<cpu::Renderer<'a>>, InputError> {
        if let Some(renderer) = &self.cpu {
            return Ok(renderer.clone());
        }
        let renderer = Rc::new(self.stages.time("bvh", || cpu::Renderer::new(self.scene, self.plan))?);
        Ok(self.cpu.insert(renderer).clone())
    }

    /// What the CPU makes of all pixels, with a bar that shows how far it is.
    fn on_all_pixels<T>(
        &mut self,
        work: impl FnOnce(&cpu::Renderer, &(dyn Fn(u64) + Sync)) -> Result<T, cpu::Error>,
    ) -> Result<T, InputError> {
        let renderer = self.cpu()?;
        let bar = self.stages.progress(self.plan.view.size.iter().map(|side| u64::from(*side)).product());
        let made = self.stages.time("render", || work(&renderer, &|done| bar.inc(done)));
        bar.finish_and_clear();
        Ok(made?)
    }
}

#[cfg(feature = "gpu")]
impl<'a> Session<'a> {
    /// What the GPU makes of the plan; `None` where that is left to the CPU.
    fn on_gpu<T>(
        &mut self,
        work: impl FnOnce(&Headless, &mut Renderer, &'a Scene, &'a Plan, &mut Stages) -> Result<T, Error>,
    ) -> Result<Option<T>, InputError> {
        let Some(Gpu { device, .. }) = &self.backend.gpu else { return Ok(None) };
        let renderer = match self.gpu.take() {
            Some(renderer) => Ok(renderer),
            None => self.stages.time("setup", || device.renderer(self.scene)),
        };
        let made = renderer.and_then(|mut renderer| {
            let made = work(device, &mut renderer, self.scene, self.plan, &mut self.stages)?;
            self.gpu = Some(renderer);
            Ok(made)
        });
        match made {
            Ok(made) => Ok(Some(made)),
            Err(error) => self.backend.give_up(error, self.stages.messages).map(|()| None),
        }
    }

    fn frame_on_gpu(&mut self, engine: EngineChoice, aovs: bool) -> Result<Option<Frame>, InputError> {
        let engine = match engine {
            EngineChoice::Fused => Engine::Fused,
            EngineChoice::Peel => Engine::Peel,
        };
        self.on_gpu(|device, renderer, scene, plan, stages| {
            let mut timings = Some(Timings::default());
            let frame = device.render_with(renderer, scene, plan, RenderOptions { engine, aovs }, &mut timings)?;
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
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::cli::streams::Messages;

    const QUIET: Messages = Messages { quiet: true, color: clap::ColorChoice::Never };

    fn empty() -> Scene {
        Scene::new(vec![crate::scene::Model::default()], Vec::new())
    }

    fn plan(scene: &Scene) -> Plan {
        let text = "[scene]\nfile = \"none.glb\"\n[image]\nsize = [8, 6]\nsamples = 1";
        let spec = crate::spec::Spec::parse(text, "test.toml", std::path::Path::new("")).expect("a spec");
        Plan::new(&spec, scene).expect("a plan")
    }

    #[test]
    fn the_cpu_prepares_a_scene_once() {
        let scene = empty();
        let plan = plan(&scene);
        let mut session = Session::new(Backend::cpu("a test"), &scene, &plan, Stages::new(QUIET));
        session.render(None, true).expect("a picture");
        session.in_front().expect("an account");
        assert_eq!(session.row_layers(3).expect("a row").len(), 8);
        assert_eq!(session.stages.text().matches("bvh").count(), 1, "{}", session.stages.text());
    }

    #[cfg(feature = "gpu")]
    #[test]
    fn the_cpu_takes_over_only_where_nobody_asked_for_the_gpu() {
        let Ok(adapter) = crate::gpu::choose_named(None) else { return };
        let device = || Box::new(Headless::new(&adapter).expect("the device opens"));
        let gpu = |or_cpu| Backend { gpu: Some(Gpu { device: device(), or_cpu }), reason: "a test".into() };
        // A renderer fails for good on a plan of another scene; the CPU then says what is wrong in its own words.
        let (scene, other) = (empty(), empty());
        let plan = plan(&scene);
        let mut session = Session::new(gpu(false), &other, &plan, Stages::new(QUIET));
        let error = session.maps().expect_err("another scene");
        assert!(error.message.starts_with("the GPU cannot make this picture"), "{error}");
        assert_eq!(session.backend.to_string(), "gpu: a test");
        let mut session = Session::new(gpu(true), &other, &plan, Stages::new(QUIET));
        let error = session.maps().expect_err("another scene");
        assert!(error.message.starts_with("the plan was made for another scene"), "{error}");
        let told = session.backend.to_string();
        assert!(told.starts_with("cpu: the GPU cannot make this picture: "), "{told}");
        let mut session = Session::new(session.backend, &scene, &plan, Stages::new(QUIET));
        assert!(session.maps().is_ok(), "the CPU goes on");
    }
}
