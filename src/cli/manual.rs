//! `lenspeel completions` and `lenspeel man`: the command line as shells and `man` know it.

use clap::CommandFactory;
use clap_complete::Shell;
use clap_mangen::Man;

use super::args::Cli;
use super::streams::{print, write_out};
use crate::InputError;
use crate::spec::suggest;

pub fn completions(shell: Shell) -> Result<(), InputError> {
    let mut command = Cli::command();
    let name = command.get_name().to_owned();
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut command, name, &mut text);
    write_out(|out| out.write_all(&text))
}

/// The page of the program, or of one of its subcommands.
pub fn page(subcommand: Option<&str>) -> Result<(), InputError> {
    let mut command = Cli::command();
    command.build();
    let page = match subcommand {
        None => command,
        Some(name) => match command.find_subcommand(name) {
            Some(found) => found.clone(),
            None => {
                let names: Vec<&str> = command.get_subcommands().map(clap::Command::get_name).collect();
                return Err(
                    InputError::new(format!("there is no subcommand `{name}`")).help(suggest::help(name, names))
                );
            }
        },
    };
    let mut text = Vec::new();
    let source = concat!("lenspeel ", env!("CARGO_PKG_VERSION"));
    Man::new(page)
        .source(source)
        .render(&mut text)
        .map_err(|error| InputError::new(format!("no manual page: {error}")))?;
    print(&String::from_utf8_lossy(&text))
}
