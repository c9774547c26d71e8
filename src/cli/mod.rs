//! Texts of the program's subcommands, as plain functions of the data they show.

mod info;
mod init;
pub mod report;

pub use info::info_text;
pub use init::init_text;
