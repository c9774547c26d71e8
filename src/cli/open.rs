//! What opening a model may take and reach, as the command line says it.

use bytesize::ByteSize;
use clap::Args;

use crate::scene::OpenOptions;

#[derive(Debug, Args)]
pub struct OpenArgs {
    /// Memory for all models and pictures of a spec and for drawing them on the CPU, as in 512MiB or 24GiB
    #[arg(long, value_name = "SIZE", default_value = "8GiB", value_parser = parse_size)]
    pub memory_limit: u64,
    /// Open buffers and images that lie outside the folder of the model that names them
    #[arg(long)]
    pub allow_outside: bool,
}

impl OpenArgs {
    pub fn options(&self) -> OpenOptions {
        OpenOptions { memory_limit: self.memory_limit, allow_outside: self.allow_outside }
    }
}

fn parse_size(text: &str) -> Result<u64, String> {
    let size: ByteSize = text.parse().map_err(|_| "expected a number of bytes, as in 512MiB or 24GiB")?;
    Ok(size.as_u64())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sizes_have_units() {
        assert_eq!(parse_size("8GiB"), Ok(OpenOptions::MEMORY_LIMIT));
        assert_eq!(parse_size("1.5 GB"), Ok(1_500_000_000));
        assert_eq!(parse_size("4096"), Ok(4096));
        assert!(parse_size("much").is_err());
        assert!(parse_size("-1GiB").is_err());
    }
}
