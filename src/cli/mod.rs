//! Texts of the program's subcommands, as plain functions of the data they show.

mod filters;
mod info;
mod init;
mod report;
mod schema;

pub use filters::filters_text;
pub use info::info_text;
pub use init::init_text;
pub use report::report;
pub use schema::schema;
