//! The GPU backend against the CPU backend on a scene made in code, and what only the GPU has: windows, limits,
//! lists that overflow, targets of a host.

mod agree;
mod bench;
mod cases;
mod compounds;
mod custom;
mod host;
mod intervals;
mod limits;
mod panes;
mod scene;
mod stacks;

#[path = "../support/trials.rs"]
mod trials;

use std::process::ExitCode;

use trials::Test;

fn main() -> ExitCode {
    trials::run(cases::ALL)
}
