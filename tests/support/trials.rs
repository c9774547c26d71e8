//! GPU tests that share one device, as trials.
//!
//! Without an adapter they report as ignored; with `LENSPEEL_REQUIRE_GPU=1` a missing adapter is a failure.

#[path = "timed.rs"]
mod timed;

use std::process::ExitCode;
use std::sync::Arc;

use lenspeel::gpu::{Headless, choose_named};
use libtest_mimic::Arguments;

pub type Test = fn(&Headless) -> Result<(), String>;

/// Runs those of the named tests that the command line asks for.
pub fn run(tests: &[(&str, Test)]) -> ExitCode {
    let arguments = Arguments::from_args();
    let device = device();
    let required = std::env::var("LENSPEEL_REQUIRE_GPU").is_ok_and(|v| v != "0" && !v.is_empty());
    let ignored = device.is_err() && !required;
    if let (Err(reason), true) = (&device, ignored) {
        eprintln!("GPU tests are ignored: {reason}");
    }
    let device = Arc::new(device);
    let trials = tests
        .iter()
        .map(|&(name, test)| {
            let device = device.clone();
            let run = move || match &*device {
                Ok(device) => test(device),
                Err(reason) => Err(reason.clone()),
            };
            timed::trial(name, run).with_ignored_flag(ignored)
        })
        .collect();
    timed::run(&arguments, trials).exit_code()
}

fn device() -> Result<Headless, String> {
    let choice = choose_named(None).map_err(|e| e.to_string())?;
    Headless::new(&choice).map_err(|e| e.to_string())
}
