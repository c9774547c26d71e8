//! Every committed spec: its plan, its regions, its golden picture, and the same picture from both GPU engines.
//!
//! One entry a spec makes all its tests, named `<folder>/<spec>::<what>`. Goldens are written by the CPU backend
//! alone, with `LENSPEEL_UPDATE_GOLDENS=1 cargo test --test specs`; snapshots are insta's.

mod art;
mod controls;
#[cfg(feature = "gpu")]
mod drawn;
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

#[path = "../support/timed.rs"]
mod timed;

use std::sync::Arc;

use libtest_mimic::{Arguments, Trial};

use entry::{Entry, Kind};

fn main() {
    let arguments = Arguments::from_args();
    let entries: Vec<Arc<Entry>> = entry::all().into_iter().map(Arc::new).collect();
    let mut trials = controls::trials();
    trials.extend(entries.iter().flat_map(trials_on_cpu));
    #[cfg(feature = "gpu")]
    trials.extend(drawn::trials(&arguments, &entries));
    timed::run(&arguments, trials).exit();
}

fn trials_on_cpu(entry: &Arc<Entry>) -> Vec<Trial> {
    let mut trials = vec![trial(entry, "plan", snapshot::plan), trial(entry, "regions", snapshot::regions)];
    if entry.kind != Kind::Showcase {
        trials.push(trial(entry, "golden", golden::check));
    }
    if pick::SPECS.contains(&entry.name.as_str()) {
        trials.push(trial(entry, "pick", pick::on_cpu));
    }
    trials
}

fn trial(entry: &Arc<Entry>, what: &str, check: impl Fn(&Entry) -> Result<(), String> + Send + 'static) -> Trial {
    let entry = entry.clone();
    timed::trial(format!("{}::{what}", entry.name), move || check(&entry))
}
