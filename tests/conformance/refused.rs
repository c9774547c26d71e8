//! Specs that the program must refuse.

use std::path::Path;
use std::process::Command;

/// Exit code 1, and a message that names the file and a line of it.
pub fn check(path: &Path) -> Result<(), String> {
    let output = Command::new(env!("CARGO_BIN_EXE_lenspeel"))
        .arg("check")
        .arg(path)
        .env("NO_COLOR", "1")
        .output()
        .map_err(|error| error.to_string())?;
    let message = String::from_utf8_lossy(&output.stderr);
    if output.status.code() != Some(1) {
        return Err(format!("exit code {:?} instead of 1:\n{message}", output.status.code()));
    }
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    if names_line(&message, &file) { Ok(()) } else { Err(format!("no line of {file} is named:\n{message}")) }
}

/// Whether `file:LINE` stands in a message, its parts possibly broken over lines.
fn names_line(message: &str, file: &str) -> bool {
    let unbroken: String = message.chars().filter(|c| !c.is_whitespace()).collect();
    unbroken
        .match_indices(&format!("{file}:"))
        .any(|(at, found)| unbroken[at + found.len()..].starts_with(|c: char| c.is_ascii_digit()))
}
