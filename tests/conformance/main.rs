//! Specs whose region maps, node maps and colours were computed independently, and specs that must be refused.
//!
//! They lie in `../shared/conformance` beside the project; where that folder is missing the tests report as ignored.

mod case;
mod expected;
mod npy;
mod refused;

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

use std::path::Path;

use libtest_mimic::{Arguments, Trial};

/// A folder with fewer is not the one that is meant.
const LEAST_CASES: usize = 20;

fn main() {
    let arguments = Arguments::from_args();
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/conformance");
    let trials = if folder.is_dir() {
        trials(&folder)
    } else {
        println!("{} is not there: its cases are ignored", folder.display());
        vec![Trial::test("conformance", || Ok(())).with_ignored_flag(true)]
    };
    timed::run(&arguments, trials).exit();
}

fn trials(folder: &Path) -> Vec<Trial> {
    let specs = case::specs(folder);
    assert!(specs.len() >= LEAST_CASES, "only {} cases in {}", specs.len(), folder.display());
    let mut trials = Vec::new();
    for path in specs {
        let name = case::stem(&path);
        trials.extend(backends(&name, &path));
    }
    for path in case::specs(&folder.join("errors")) {
        trials.push(timed::trial(format!("errors/{}", case::stem(&path)), move || refused::check(&path)));
    }
    trials
}

/// The CPU backend and, where there is one, both engines of the GPU backend.
fn backends(name: &str, path: &Path) -> Vec<Trial> {
    let on_cpu = path.to_path_buf();
    #[cfg_attr(not(feature = "gpu"), expect(unused_mut, reason = "the GPU adds to it"))]
    let mut trials = vec![timed::trial(format!("{name}::cpu"), move || case::check(&on_cpu, case::on_cpu))];
    #[cfg(feature = "gpu")]
    {
        let ignored = gpu::is_ignored();
        trials.extend(gpu::ENGINES.map(|(engine, what)| {
            let path = path.to_path_buf();
            let check = move || case::check(&path, |opened| gpu::render(opened, engine));
            timed::trial(format!("{name}::{what}"), check).with_ignored_flag(ignored)
        }));
    }
    trials
}
