//! Translates the appearance shaders (plain WGSL functions) to Rust, so that the CPU backend and the GPU
//! backend share one source.

use std::{env, error::Error, fs, path::Path};

/// In the order in which they are joined; a file may use what an earlier or later one declares.
const FILES: [&str; 7] = ["surface", "color", "filters", "geometry", "texture", "light", "glass"];

fn main() -> Result<(), Box<dyn Error>> {
    let mut wgsl = String::new();
    for file in FILES {
        let path = format!("shaders/appearance/{file}.wgsl");
        println!("cargo::rerun-if-changed={path}");
        wgsl += &fs::read_to_string(path)?;
    }
    let module = naga::front::wgsl::parse_str(&wgsl).map_err(|e| e.emit_to_string(&wgsl))?;
    let info = naga::valid::Validator::new(naga::valid::ValidationFlags::all(), naga::valid::Capabilities::empty())
        .validate(&module)
        .map_err(|e| e.emit_to_string(&wgsl))?;
    let config = naga_rust_back::Config::new()
        .public_items(true)
        .rule(naga_rust_back::Effect::Inline(naga_rust_back::Inline::Maybe));
    let rust = naga_rust_back::write_string(&module, &info, config)?;
    let out = env::var("OUT_DIR")?;
    fs::write(Path::new(&out).join("appearance.rs"), rust)?;
    fs::write(Path::new(&out).join("appearance.wgsl"), wgsl)?;
    Ok(())
}
