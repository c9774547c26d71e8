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
mod open;
mod render;
mod report;
mod schema;
mod shapes;
mod stages;
mod targets;
mod words;
mod wrap;

use std::fmt::{self, Write as _};
use std::io::{IsTerminal, Write};
use std::path::Path;
use std::process::ExitCode;

use clap::Parser;

use crate::InputError;
use crate::scene::{Model, OpenOptions};
use crate::spec::Spec;
use args::{Cli, Command};

pub use filters::{filter_text, filters_index, filters_markdown, filters_text};
pub use info::{InfoChoice, info_json, info_text};
pub use init::init_text;
pub use report::report;
pub use schema::{keys_markdown, schema};
pub use shapes::{shape_text, shapes_markdown, shapes_text};

/// The input is wrong; clap itself exits with 2 when the usage is.
const WRONG_INPUT: u8 = 1;

/// Runs the program on the arguments of the process.
pub fn run() -> ExitCode {
    let result = match Cli::parse().command {
        Command::Render(args) => render::run(&args),
        Command::Check { spec, strict, open } => check::run(&spec, strict, &open.options()),
        Command::Explain(args) => explain::run(&args),
        Command::Pick(args) => explain::pick(&args),
        #[cfg(feature = "gpu")]
        Command::Bench(args) => bench::run(&args),
        #[cfg(not(feature = "gpu"))]
        Command::Bench(_) => Err(InputError::new(
            "`bench` measures the GPU backend, and this program was built without the `gpu` feature",
        )
        .help("build it with default features")),
        Command::Info(args) => info::run(&args),
        Command::Init { model, output, open } => init_command(&model, output.as_deref(), &open.options()),
        Command::Filters { name: Some(name), .. } => filters::filter_text(&name).map(|text| print_wrapped(&text)),
        Command::Filters { markdown, .. } => {
            print(&if markdown { filters_markdown() } else { filters_text() });
            Ok(())
        }
        Command::Shapes { name: Some(name), .. } => shapes::shape_text(&name).map(|text| print_wrapped(&text)),
        Command::Shapes { markdown, .. } => {
            print(&if markdown { shapes_markdown() } else { shapes_text() });
            Ok(())
        }
        Command::Schema { markdown: true } => {
            print(&keys_markdown());
            Ok(())
        }
        Command::Schema { markdown: false } => {
            print_json(&schema());
            Ok(())
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            let terminal = std::io::stderr().is_terminal();
            eprint!("{}", report(&error, 100, terminal && std::env::var_os("NO_COLOR").is_none()));
            ExitCode::from(WRONG_INPUT)
        }
    }
}

/// To standard output; a reader that went away (`| head`) is no error.
fn print(text: &str) {
    let _ = std::io::stdout().write_all(text.as_bytes());
}

/// The same in lines that fit a terminal, as they come: there may be very many.
fn print_wrapped(text: &impl fmt::Display) {
    let mut out = Out(std::io::BufWriter::new(std::io::stdout().lock()));
    let _ = write!(wrap::Wrapped::new(&mut out), "{text}");
}

/// The same for JSON, as it comes.
fn print_json(value: &impl serde::Serialize) {
    let mut out = std::io::BufWriter::new(std::io::stdout().lock());
    let _ = serde_json::to_writer_pretty(&mut out, value);
    let _ = out.write_all(b"\n").and_then(|()| out.flush());
}

/// Text goes to a file or a terminal as bytes.
struct Out<W>(W);

impl<W: Write> fmt::Write for Out<W> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.0.write_all(text.as_bytes()).map_err(|_| fmt::Error)
    }
}

fn init_command(path: &Path, output: Option<&Path>, options: &OpenOptions) -> Result<(), InputError> {
    let model = Model::load_with(path, None, options)?;
    let starter = |file: &str| {
        let text = init_text(&model, file);
        // A model may be larger or smaller than the numbers of a spec reach.
        Spec::parse(&text, "the starter spec", Path::new("")).map(|_| text)
    };
    let Some(output) = output else {
        return starter(&path.display().to_string()).map(|text| print(&text));
    };
    if output.exists() {
        let message = format!("{} is there already, and a starter spec would replace it", output.display());
        return Err(InputError::new(message).help("choose another name, or remove it first"));
    }
    let text = starter(&relative(path, output).display().to_string())?;
    crate::output::write_whole(output, text.as_bytes())
}

/// A path to `file` that holds in a spec at `spec`.
fn relative(file: &Path, spec: &Path) -> std::path::PathBuf {
    let folder = spec.parent().unwrap_or(Path::new(""));
    if folder.as_os_str().is_empty() {
        return file.to_path_buf();
    }
    if let Ok(inside) = file.strip_prefix(folder) {
        return inside.to_path_buf();
    }
    std::fs::canonicalize(file).unwrap_or_else(|_| file.to_path_buf())
}
