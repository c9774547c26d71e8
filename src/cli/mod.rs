//! The program's subcommands; what they print is made by plain functions of the data they show.

mod args;
mod backend;
#[cfg(feature = "gpu")]
mod bench;
mod check;
mod excerpt;
mod explain;
mod filters;
mod info;
mod init;
mod manual;
#[cfg(all(target_os = "linux", feature = "gpu"))]
mod mesa;
mod open;
mod outputs;
mod render;
mod report;
mod schema;
mod shapes;
mod stages;
mod streams;
mod words;
mod wrap;

use std::ffi::OsStr;
use std::process::ExitCode;
use std::sync::atomic::Ordering;

use clap::{ColorChoice, CommandFactory, FromArgMatches, ValueEnum};

use crate::InputError;
use args::{Cli, Command};
use streams::{Messages, print, print_json, print_text};

pub use filters::{filter_text, filters_index, filters_markdown, filters_text};
pub use info::{InfoChoice, info_json, info_text};
pub use init::init_text;
pub use report::report;
pub use schema::{keys_markdown, schema};
pub use shapes::{shape_text, shapes_markdown, shapes_text};

/// The input is wrong, or the result cannot be written; clap itself exits with 2 when the usage is.
const FAILED: u8 = 1;

/// Runs the program on the arguments of the process. Whether standard output was closed when the process began can be
/// known only before Rust's runtime has begun, too.
pub fn run(stdout_is_closed: bool) -> ExitCode {
    streams::IS_CLOSED.store(stdout_is_closed, Ordering::Relaxed);
    let color = color_of(std::env::args_os().skip(1));
    let matches = Cli::command().color(color).try_get_matches();
    match matches.and_then(|matches| Cli::from_arg_matches(&matches)) {
        Ok(cli) => {
            let messages = Messages { quiet: cli.quiet, color };
            #[cfg(all(target_os = "linux", feature = "gpu"))]
            if cli.command.may_open_device() {
                mesa::without_device_selection();
            }
            ended(run_command(cli.command, messages), messages)
        }
        Err(usage) if usage.use_stderr() => {
            let _ = usage.print();
            ExitCode::from(usage.exit_code() as u8)
        }
        // Help and version are what was asked for.
        Err(answer) => ended(streams::settle(answer.print()), Messages { quiet: false, color }),
    }
}

fn ended(result: Result<(), InputError>, messages: Messages) -> ExitCode {
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            messages.error(&error);
            ExitCode::from(FAILED)
        }
    }
}

/// What `--color` says, before the arguments are known to be right: usage errors have colours, too.
fn color_of(mut arguments: impl Iterator<Item = std::ffi::OsString>) -> ColorChoice {
    let mut color = ColorChoice::Auto;
    while let Some(argument) = arguments.next().filter(|argument| argument != "--") {
        let value = match argument.to_str().and_then(|text| text.strip_prefix("--color")) {
            Some("") => arguments.next(),
            Some(rest) => rest.strip_prefix('=').map(Into::into),
            None => None,
        };
        let choice =
            value.as_deref().and_then(OsStr::to_str).and_then(|value| ColorChoice::from_str(value, false).ok());
        color = choice.unwrap_or(color);
    }
    color
}

fn run_command(command: Command, messages: Messages) -> Result<(), InputError> {
    match command {
        Command::Render(args) => render::run(&args, messages),
        Command::Check { spec, strict, open } => check::run(&spec, strict, &open.options()),
        Command::Explain(args) => explain::run(&args, messages),
        Command::Pick(args) => explain::pick(&args, messages),
        #[cfg(feature = "gpu")]
        Command::Bench(args) => bench::run(&args, messages),
        #[cfg(not(feature = "gpu"))]
        Command::Bench(_) => Err(InputError::new(
            "`bench` measures the GPU backend, and this program was built without the `gpu` feature",
        )
        .help("build it with default features")),
        Command::Info(args) => info::run(&args),
        Command::Init { model, output, open } => init::run(&model, output.as_deref(), &open.options(), messages),
        Command::Filters { name: Some(name), .. } => print_text(&filters::filter_text(&name)?),
        Command::Filters { markdown, .. } => print(&if markdown { filters_markdown() } else { filters_text() }),
        Command::Shapes { name: Some(name), .. } => print_text(&shapes::shape_text(&name)?),
        Command::Shapes { markdown, .. } => print(&if markdown { shapes_markdown() } else { shapes_text() }),
        Command::Schema { markdown: true } => print(&keys_markdown()),
        Command::Schema { markdown: false } => print_json(&schema()),
        Command::Completions { shell } => manual::completions(shell),
        Command::Man { command } => manual::page(command.as_deref()),
    }
}
