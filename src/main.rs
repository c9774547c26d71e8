//! The program: see `lenspeel help`.
// Not `forbid`: what runs before `main` is put there by a macro of `ctor`, and that allows itself to.
#![deny(unsafe_code)]

use std::process::ExitCode;
use std::sync::atomic::{AtomicBool, Ordering};

/// Rust's runtime opens a device that takes all where standard output is closed; only before that can it be told.
static STDOUT_IS_CLOSED: AtomicBool = AtomicBool::new(false);

#[cfg(unix)]
#[ctor::ctor(unsafe)]
fn look_at_standard_output() {
    use std::os::fd::AsFd;
    let is_closed = std::io::stdout().as_fd().try_clone_to_owned().is_err();
    STDOUT_IS_CLOSED.store(is_closed, Ordering::Relaxed);
}

fn main() -> ExitCode {
    lenspeel::cli::run(STDOUT_IS_CLOSED.load(Ordering::Relaxed))
}
