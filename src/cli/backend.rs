//! Which backend renders, and one line on why.

use super::args::{BackendChoice, EngineChoice};
use super::stages::Stages;
use crate::InputError;
use crate::cpu;
use crate::frame::{Aovs, Frame};
use crate::lens::LayerStart;
use crate::pick::Pick;
use crate::pixel::PixelReport;
use crate::plan::Plan;
use crate::scene::Scene;

/// A backend ready to render.
pub enum Backend {
    Cpu,
    #[cfg(feature = "gpu")]
    Gpu(crate::gpu::Headless),
}

/// Chooses as the user asked; the text says what and why.
#[cfg(feature = "gpu")]
pub fn choose(choice: BackendChoice) -> Result<(Backend, String), InputError> {
    use crate::gpu::{Headless, choose_hardware, choose_named};
    let fail = |e: crate::gpu::Error| InputError::new(e.to_string()).help("`--backend cpu` needs no graphics device");
    let gpu = |adapter: crate::gpu::AdapterChoice| {
        let text = format!("gpu: {}", adapter.reason);
        Headless::new(&adapter).map(|device| (Backend::Gpu(device), text)).map_err(fail)
    };
    match choice {
        BackendChoice::Cpu => Ok((Backend::Cpu, "cpu: it was asked for".into())),
        BackendChoice::Gpu => gpu(choose_named(None).map_err(fail)?),
        BackendChoice::Auto => match choose_hardware() {
            Ok(adapter) => gpu(adapter),
            Err(reason) => Ok((Backend::Cpu, format!("cpu: {reason}"))),
        },
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
        match self {
            Backend::Cpu => {
                if engine.is_some() {
                    stages.messages.note("note: --engine is about the GPU, and the CPU renders");
                }
                Ok(on_cpu(scene, plan, aovs, stages))
            }
            #[cfg(feature = "gpu")]
            Backend::Gpu(device) => {
                let engine = match engine {
                    None | Some(EngineChoice::Fused) => crate::gpu::Engine::Fused,
                    Some(EngineChoice::Peel) => crate::gpu::Engine::Peel,
                };
                on_gpu(device, scene, plan, engine, aovs, stages)
            }
        }
    }
}

impl Backend {
    /// In a word.
    pub fn name(&self) -> &'static str {
        match self {
            Backend::Cpu => "cpu",
            #[cfg(feature = "gpu")]
            Backend::Gpu(_) => "gpu",
        }
    }

    /// What lies at the centre of each pixel.
    pub fn maps(&self, scene: &Scene, plan: &Plan, stages: &mut Stages) -> Result<Aovs, InputError> {
        match self {
            Backend::Cpu => {
                let renderer = stages.time("bvh", || cpu::Renderer::new(scene, plan));
                let bar = stages.progress(plan.view.size.iter().map(|s| u64::from(*s)).product());
                let maps = stages.time("render", || renderer.maps(&|done| bar.inc(done)));
                bar.finish_and_clear();
                Ok(maps)
            }
            #[cfg(feature = "gpu")]
            Backend::Gpu(device) => {
                let frame = on_gpu(device, scene, plan, crate::gpu::Engine::Fused, true, stages)?;
                Ok(frame.aovs.unwrap_or_default())
            }
        }
    }

    /// What the ray through a pixel's centre meets.
    pub fn explain(&self, scene: &Scene, plan: &Plan, [x, y]: [u32; 2]) -> Result<PixelReport, InputError> {
        match self {
            Backend::Cpu => Ok(cpu::Renderer::new(scene, plan).explain(x, y)),
            #[cfg(feature = "gpu")]
            Backend::Gpu(device) => {
                let mut renderer = device.renderer(scene).map_err(no_picture)?;
                device.explain(&mut renderer, scene, plan, [x, y]).map_err(no_picture)
            }
        }
    }

    /// What is visible at a pixel.
    pub fn pick(&self, scene: &Scene, plan: &Plan, [x, y]: [u32; 2]) -> Result<Option<Pick>, InputError> {
        match self {
            Backend::Cpu => Ok(cpu::Renderer::new(scene, plan).pick(x, y)),
            #[cfg(feature = "gpu")]
            Backend::Gpu(device) => {
                let mut renderer = device.renderer(scene).map_err(no_picture)?;
                device.pick(&mut renderer, scene, plan, [x, y]).map_err(no_picture)
            }
        }
    }

    /// The layers of the rays through the pixel centres of a row.
    pub fn row_layers(&self, scene: &Scene, plan: &Plan, row: u32) -> Result<Vec<Vec<LayerStart>>, InputError> {
        match self {
            Backend::Cpu => Ok(cpu::Renderer::new(scene, plan).row_layers(row)),
            #[cfg(feature = "gpu")]
            Backend::Gpu(device) => {
                let window = crate::gpu::Window { min: [0, row], size: [plan.view.size[0], 1] };
                let mut renderer = device.renderer(scene).map_err(no_picture)?;
                device.layers(&mut renderer, scene, plan, window).map_err(no_picture)
            }
        }
    }
}

#[cfg(feature = "gpu")]
fn no_picture(error: crate::gpu::Error) -> InputError {
    InputError::new(format!("the GPU cannot make this picture: {error}"))
        .help("try a smaller `--size`, or `--backend cpu`")
}

fn on_cpu(scene: &Scene, plan: &Plan, aovs: bool, stages: &mut Stages) -> Frame {
    let renderer = stages.time("bvh", || cpu::Renderer::new(scene, plan));
    let pixels = plan.view.size.iter().map(|s| u64::from(*s)).product();
    let bar = stages.progress(pixels);
    let frame = stages.time("render", || renderer.render(aovs, &|done| bar.inc(done)));
    bar.finish_and_clear();
    frame
}

#[cfg(feature = "gpu")]
fn on_gpu(
    device: &crate::gpu::Headless,
    scene: &Scene,
    plan: &Plan,
    engine: crate::gpu::Engine,
    aovs: bool,
    stages: &mut Stages,
) -> Result<Frame, InputError> {
    use crate::gpu::{RenderOptions, Timings};
    let mut renderer = stages.time("setup", || device.renderer(scene)).map_err(no_picture)?;
    let mut timings = Some(Timings::default());
    let frame = device
        .render_with(&mut renderer, scene, plan, RenderOptions { engine, aovs }, &mut timings)
        .map_err(no_picture)?;
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
