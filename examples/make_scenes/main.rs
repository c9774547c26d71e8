//! Writes the project's own models into `lens-specs/models` (or the folder given): the same bytes on every run.

mod scenes;

use std::path::PathBuf;

fn main() -> std::io::Result<()> {
    let folder = std::env::args_os()
        .nth(1)
        .map_or_else(|| PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/lens-specs/models")), PathBuf::from);
    std::fs::create_dir_all(&folder)?;
    let mut total = 0;
    for file in scenes::all() {
        std::fs::write(folder.join(file.name), &file.bytes)?;
        println!("{:>9} bytes  {}", file.bytes.len(), file.name);
        total += file.bytes.len();
    }
    println!("{total:>9} bytes in all");
    Ok(())
}
