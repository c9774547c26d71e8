//! `lenspeel bench`: what the lenses of a spec cost.

use serde_json::json;

use super::args::BenchArgs;
use super::stages::Stages;
use super::streams::{Messages, print, print_json};
use crate::InputError;
use crate::bench::{Case, Contender, Measured, Sample, Verdict, interleaved};
use crate::gpu::{
    Engine, Error, Headless, LensStorage, RenderOptions, Renderer, STAGES, Timings, Triangles, choose_named,
};
use crate::plan::Plan;
use crate::scene::Scene;
use crate::spec::Spec;
use crate::words::count_of;

const NO_LENS: &str = "no lens";
const FUSED: &str = "fused";
const PEEL: &str = "peel";

/// What came out, and of what.
struct Account<'a> {
    spec: &'a Spec,
    plan: &'a Plan,
    adapter: &'a str,
    /// Whether stages are timed by the device itself.
    device_clock: bool,
    contents: Contents,
}

/// What the frames took, what they drew, and what lenses kept on the device.
struct Contents {
    measured: Vec<Measured>,
    /// Of each of `measured`.
    triangles: Vec<Triangles>,
    storage: LensStorage,
}

pub fn run(args: &BenchArgs, messages: Messages) -> Result<(), InputError> {
    let mut spec = args.spec.load()?;
    spec.image.size = args.size.unwrap_or(spec.image.size);
    let scene = Scene::open_with(&spec, &args.open.options())?;
    let plan = Plan::new(&spec, &scene)?;
    for warning in &plan.warnings {
        messages.warning(warning);
    }
    let adapter = choose_named(None).map_err(no_frame)?;
    let device = Headless::new(&adapter).map_err(no_frame)?;
    messages.note(format_args!("gpu: {}", device.reason));
    let bare = without_lenses(&spec, &scene, &plan)?;
    let contents = measure(&device, &scene, &plan, &bare, args.frames, messages).map_err(no_frame)?;
    let device_clock = device.has_timestamps();
    let account = Account { spec: &spec, plan: &plan, adapter: &device.reason, device_clock, contents };
    if args.json { print_json(&account.json()) } else { print(&account.text()) }
}

fn no_frame(error: Error) -> InputError {
    InputError::new(format!("the GPU cannot draw these frames: {error}"))
        .help("`bench` measures the GPU backend; try a smaller `--size`")
}

/// The same picture without its lenses, over the same depths.
fn without_lenses(spec: &Spec, scene: &Scene, plan: &Plan) -> Result<Plan, InputError> {
    let bare = Spec { lenses: Vec::new(), overlaps: Vec::new(), ..spec.clone() };
    let mut bare = Plan::new(&bare, scene)?;
    bare.view = plan.view.clone();
    Ok(bare)
}

fn measure(
    device: &Headless,
    scene: &Scene,
    plan: &Plan,
    bare: &Plan,
    frames: u32,
    messages: Messages,
) -> Result<Contents, Error> {
    // The first frames are the longest: each makes its pipelines.
    let bar = Stages::new(messages).progress(1 + 3 * (u64::from(frames) + 1));
    let mut renderer = device.renderer(scene)?;
    // Before any other frame, which might make room that this plan does not need.
    let fused = RenderOptions::default();
    bar.set_message(FUSED);
    device.render_with(&mut renderer, scene, plan, fused, &mut None)?;
    bar.inc(1);
    let storage = device.lens_storage(&mut renderer, scene, plan, fused)?;
    let renderer = std::cell::RefCell::new(renderer);
    let contestants = [(NO_LENS, bare, Engine::Fused), (FUSED, plan, Engine::Fused), (PEEL, plan, Engine::Peel)];
    let contender = |(name, plan, engine)| {
        let (renderer, bar, options) = (&renderer, &bar, RenderOptions { engine, aovs: false });
        let mut is_settled = false;
        Contender::new(name, move || {
            let mut renderer = renderer.borrow_mut();
            bar.set_message(name);
            if !is_settled {
                device.render_with(&mut renderer, scene, plan, options, &mut None)?;
                is_settled = true;
            }
            let sample = sample(device, &mut renderer, scene, plan, options);
            bar.inc(1);
            sample
        })
    };
    let mut contenders = contestants.map(contender);
    let measured = interleaved(&mut contenders, frames as usize, |_| ())?;
    drop(contenders);
    bar.finish_and_clear();
    let mut renderer = renderer.into_inner();
    let triangles = contestants.map(|(_, plan, engine)| {
        let options = RenderOptions { engine, aovs: false };
        device.time_frame(&mut renderer, scene, plan, options, false).map(|cost| cost.triangles)
    });
    Ok(Contents { measured, triangles: triangles.into_iter().collect::<Result<_, _>>()?, storage })
}

/// One frame, and how long each of its stages took: on the device's clock where it has one, else in a second frame
/// that waits for each stage.
fn sample(
    device: &Headless,
    renderer: &mut Renderer,
    scene: &Scene,
    plan: &Plan,
    options: RenderOptions,
) -> Result<Sample, Error> {
    let cost = device.time_frame(renderer, scene, plan, options, true)?;
    let (seconds, parts) = match cost.stages {
        Some(parts) => (parts.iter().sum(), parts),
        None => {
            let mut timings = Some(Timings::default());
            device.render_with(renderer, scene, plan, options, &mut timings)?;
            let waited = timings.unwrap_or_default();
            (cost.wall - cost.prepare, [waited.layers, waited.visibility, waited.resolve])
        }
    };
    let mut stages: Vec<(&'static str, f64)> = STAGES.into_iter().zip(parts).collect();
    stages.extend([("upload", cost.prepare), ("whole frame", cost.wall)]);
    Ok(Sample { seconds, stages })
}

impl Account<'_> {
    fn verdicts(&self) -> Vec<Verdict> {
        let case = |of: &str, to: &str| Case { name: format!("{of} / {to}"), of: of.into(), to: to.into(), bar: None };
        let cases = [case(FUSED, NO_LENS), case(PEEL, NO_LENS), case(PEEL, FUSED)];
        cases.iter().filter_map(|case| Verdict::new(case, &self.contents.measured)).collect()
    }

    fn text(&self) -> String {
        let [width, height] = self.plan.view.size;
        let clock = match self.device_clock {
            true => "times are the device's own",
            false => "times are from submission to the end, those of the stages each waited for",
        };
        let rounds = self.contents.measured.first().map_or(0, |m| m.samples.len());
        let samples = self.plan.samples;
        let mut text = format!(
            "{}: {}, {width} x {height}, {} a pixel\nmedians of {} each; {clock}\n\n",
            self.spec.source.name,
            count_of(self.plan.lenses.len(), "enabled lens"),
            count_of(samples, "sample"),
            count_of(rounds, "interleaved frame"),
        );
        let stages: Vec<&str> =
            self.contents.measured.first().map(Measured::stages).unwrap_or_default().iter().map(|s| s.0).collect();
        let heads: String = stages.iter().map(|stage| format!(" {stage:>12}")).collect();
        text += &format!("{:<8} {:>12} {:>8}{heads}\n", "", "milliseconds", "ratio");
        for m in &self.contents.measured {
            let ratio = m.ratio_to(&self.contents.measured[0]);
            let parts: String = m.stages().iter().map(|(_, seconds)| format!(" {:>12.2}", 1e3 * seconds)).collect();
            text += &format!("{:<8} {:>12.2} {ratio:>8.2}{parts}\n", m.name, 1e3 * m.median());
        }
        for (m, Triangles { drawn, asking }) in self.contents.measured.iter().zip(&self.contents.triangles) {
            let (name, drawn) = (&m.name, count_of(*drawn, "triangle"));
            text += &format!("\n{name}: draws {drawn} a sample; the fragments of {asking} ask for their lenses");
        }
        text += &format!("\n\nlenses keep {} on the device\n", bytes(self.contents.storage.total()));
        for (what, count) in self.contents.storage.parts() {
            text += &format!("{what:>14} {:>12}\n", bytes(count));
        }
        text
    }

    fn json(&self) -> serde_json::Value {
        let mut value = crate::bench::json(&self.verdicts(), &self.contents.measured);
        for (i, Triangles { drawn, asking }) in self.contents.triangles.iter().enumerate() {
            value["frames"][i]["triangles"] = json!({ "drawn": drawn, "asking": asking });
        }
        value["spec"] = json!(self.spec.source.name);
        value["adapter"] = json!(self.adapter);
        value["size"] = json!(self.plan.view.size);
        value["samples"] = json!(self.plan.samples);
        value["lenses"] = json!(self.plan.lenses.len());
        value["clock"] = json!(if self.device_clock { "device" } else { "wall" });
        let mut storage: serde_json::Map<String, serde_json::Value> =
            self.contents.storage.parts().iter().map(|(what, count)| (what.replace(' ', "_"), json!(count))).collect();
        storage.insert("total".into(), json!(self.contents.storage.total()));
        value["lens_storage"] = storage.into();
        value
    }
}

fn bytes(count: u64) -> String {
    match count {
        0..1024 => format!("{count} B"),
        1024..1_048_576 => format!("{:.1} KiB", count as f64 / 1024.0),
        _ => format!("{:.1} MiB", count as f64 / 1_048_576.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Model;

    #[test]
    fn the_picture_without_lenses_has_the_same_depths() {
        let text = "[scene]\nfile = \"none.glb\"\n[camera]\neye = [0, 0, 9]\ntarget = [0, 0, 0]\n\
            [[lens]]\nname = \"a\"\nfilters = [\"erase\"]\nshape.sphere = { center = [0, 0, 0], radius = 3 }\n";
        let spec = Spec::parse(text, "a test", "".as_ref()).expect("the spec is right");
        let scene = Scene::new(vec![Model::default()], Vec::new());
        let plan = Plan::new(&spec, &scene).expect("the plan is right");
        let fitted = Plan::new(&Spec { lenses: Vec::new(), ..spec.clone() }, &scene).expect("the plan is right");
        assert_ne!(fitted.view, plan.view, "lenses count where depths are fitted");
        let bare = without_lenses(&spec, &scene, &plan).expect("the plan is right");
        assert_eq!((bare.view, bare.lenses.len()), (plan.view, 0));
    }

    #[test]
    fn amounts_have_units() {
        assert_eq!([0, 1023, 1536, 3 << 20].map(bytes), ["0 B", "1023 B", "1.5 KiB", "3.0 MiB"]);
    }
}
