//! The program: see `lenspeel help`.
#![forbid(unsafe_code)]

use std::process::ExitCode;

fn main() -> ExitCode {
    lenspeel::cli::run()
}
