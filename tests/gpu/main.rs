//! The GPU backend against the CPU backend on a scene made in code, and what only the GPU has: windows, limits,
//! lists that overflow, targets of a host.
//!
//! Without an adapter these report as ignored; with `LENSPEEL_REQUIRE_GPU=1` a missing adapter is a failure.

mod agree;
mod bench;
mod cases;
mod compounds;
mod host;
mod intervals;
mod limits;
mod panes;
mod scene;
mod stacks;

use std::process::ExitCode;
use std::sync::Arc;

use lenspeel::gpu::{self, Headless};
use libtest_mimic::{Arguments, Failed, Trial};

type Test = fn(&Headless) -> Result<(), String>;

fn main() -> ExitCode {
    let arguments = Arguments::from_args();
    let device = device();
    let required = std::env::var("LENSPEEL_REQUIRE_GPU").is_ok_and(|v| v != "0" && !v.is_empty());
    let ignored = device.is_err() && !required;
    if let (Err(reason), true) = (&device, ignored) {
        eprintln!("GPU tests are ignored: {reason}");
    }
    let device = Arc::new(device);
    let trials = cases::ALL
        .iter()
        .map(|(name, test): &(&str, Test)| {
            let device = device.clone();
            let run = move || match &*device {
                Ok(device) => test(device).map_err(Failed::from),
                Err(reason) => Err(Failed::from(reason.as_str())),
            };
            Trial::test(*name, run).with_ignored_flag(ignored)
        })
        .collect();
    libtest_mimic::run(&arguments, trials).exit_code()
}

fn device() -> Result<Headless, String> {
    let choice = gpu::choose_named(None).map_err(|e| e.to_string())?;
    Headless::new(&choice).map_err(|e| e.to_string())
}
