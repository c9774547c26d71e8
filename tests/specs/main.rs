//! Every committed spec: its plan, its regions, its golden picture, and the same picture from both GPU engines.
//!
//! One entry a spec makes all its tests, named `<folder>/<spec>::<what>`. Goldens are written by the CPU backend
//! alone, with `LENSPEEL_UPDATE_GOLDENS=1 cargo test --test specs`; snapshots are insta's.

mod art;
mod controls;
mod entry;
mod golden;
mod pick;
mod reference;
mod snapshot;

#[path = "../support/compare.rs"]
mod compare;
#[path = "../support/edges.rs"]
mod edges;
#[cfg(feature = "gpu")]
#[path = "../support/gpu.rs"]
mod gpu;
#[path = "../support/open.rs"]
mod open;

use std::sync::Arc;

use libtest_mimic::{Arguments, Failed, Trial};

use entry::{Entry, Kind};

fn main() {
    let arguments = Arguments::from_args();
    let mut trials = controls::trials();
    for entry in entry::all() {
        trials.extend(trials_of(Arc::new(entry)));
    }
    #[cfg(feature = "gpu")]
    ignore_without_adapter(&mut trials);
    libtest_mimic::run(&arguments, trials).exit();
}

fn trials_of(entry: Arc<Entry>) -> Vec<Trial> {
    let mut trials = vec![trial(&entry, "plan", snapshot::plan), trial(&entry, "regions", snapshot::regions)];
    if entry.kind != Kind::Showcase {
        trials.push(trial(&entry, "golden", golden::check));
    }
    if pick::SPECS.contains(&entry.name.as_str()) {
        trials.push(trial(&entry, "pick", pick::on_cpu));
        #[cfg(feature = "gpu")]
        trials.extend([trial(&entry, "pick-gpu", pick::on_gpu), trial(&entry, "report-gpu", pick::reports_agree)]);
    }
    #[cfg(feature = "gpu")]
    trials.extend(gpu::ENGINES.map(|(engine, name)| {
        trial(&entry, name, move |entry| {
            let actual = gpu::render(&entry.open()?.1, engine)?;
            compare::compare(entry.reference()?, &actual)?.verdict()
        })
    }));
    trials
}

fn trial(entry: &Arc<Entry>, what: &str, check: impl Fn(&Entry) -> Result<(), String> + Send + 'static) -> Trial {
    let entry = entry.clone();
    Trial::test(format!("{}::{what}", entry.name), move || check(&entry).map_err(Failed::from))
}

/// Looks for an adapter once, for all GPU tests.
#[cfg(feature = "gpu")]
fn ignore_without_adapter(trials: &mut Vec<Trial>) {
    if gpu::is_ignored() {
        let needs_gpu = |name: &str| {
            name.ends_with("-gpu") || gpu::ENGINES.iter().any(|(_, engine)| name.ends_with(&format!("::{engine}")))
        };
        *trials = trials.drain(..).map(|t| if needs_gpu(t.name()) { t.with_ignored_flag(true) } else { t }).collect();
    }
}
