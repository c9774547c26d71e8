//! Which backend renders, and one line on why.

use super::args::{BackendChoice, EngineChoice};
use super::stages::Stages;
use crate::InputError;
use crate::cpu;
use crate::frame::Frame;
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
                    eprintln!("note: --engine is about the GPU, and the CPU renders");
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

fn on_cpu(scene: &Scene, plan: &Plan, aovs: bool, stages: &mut Stages) -> Frame {
    let renderer = stages.time("bvh", || cpu::Renderer::new(scene, plan));
    let pixels = plan.view.size.iter().map(|s| u64::from(*s)).product();
    let bar = super::stages::progress(pixels);
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
    let fail = |e: crate::gpu::Error| {
        InputError::new(format!("the GPU cannot make this picture: {e}"))
            .help("try a smaller `--size`, or `--backend cpu`")
    };
    let mut renderer = stages.time("setup", || device.renderer(scene)).map_err(fail)?;
    let mut timings = Some(Timings::default());
    let frame =
        device.render_with(&mut renderer, scene, plan, RenderOptions { engine, aovs }, &mut timings).map_err(fail)?;
    if let Some(t) = timings {
        for (name, seconds) in [
            ("prepare", t.prepare),
            ("layers", t.layers),
            ("visibility", t.visibility),
            ("resolve", t.resolve),
            ("finish", t.finish),
            ("readback", t.readback),
        ] {
            stages.note(name, seconds);
        }
    }
    Ok(frame)
}
