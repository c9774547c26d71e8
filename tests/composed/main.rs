//! Whole compositions at random: pictures of all backends and engines against a direct, slow reading of SEMANTICS.
//!
//! `LENSPEEL_COMPOSED_CASES` and `LENSPEEL_COMPOSED_SEED` ask for more cases, or others. A case that fails is made
//! small and written to the target folder as a spec with its models.

mod case;
mod check;
mod controls;
mod files;
mod generate;
#[path = "../support/gltf.rs"]
mod gltf;
#[cfg(feature = "gpu")]
#[path = "../support/gpu.rs"]
mod gpu;
#[path = "../support/open.rs"]
mod open;
mod oracle;
mod product;
#[path = "../support/random.rs"]
mod random;
mod run;
mod shrink;
#[path = "../support/timed.rs"]
mod timed;
mod write;

use libtest_mimic::Arguments;

use product::Party;

fn main() {
    let arguments = Arguments::from_args();
    let trial = |party: Party| timed::trial(format!("cases::{}", party.name()), move || run::all(party));
    let mut trials = vec![trial(Party::Cpu)];
    #[cfg(feature = "gpu")]
    {
        let ignored = gpu::is_ignored();
        trials.extend(gpu::ENGINES.map(|(engine, _)| trial(Party::Gpu(engine)).with_ignored_flag(ignored)));
    }
    trials.extend(
        controls::ALL.map(|control| timed::trial(format!("controls::{}", control.0), move || controls::run(control))),
    );
    timed::run(&arguments, trials).exit();
}
