//! Standard output, whose errors count, and standard error, whose errors never do.

use std::fmt::{self, Display, Write as _};
use std::io::{self, BufWriter, IsTerminal, Write};
use std::sync::atomic::{AtomicBool, Ordering};

use clap::ColorChoice;

use super::report::report;
use super::wrap::Wrapped;
use crate::{InputError, printable};

/// Columns of text on a wide terminal.
const WIDEST: usize = 100;

/// Whether there is no standard output at all.
pub static IS_CLOSED: AtomicBool = AtomicBool::new(false);

/// Text to standard output, without what would steer a terminal: names of models may hold anything.
pub fn print(text: &str) -> Result<(), InputError> {
    write_out(|out| out.write_all(printable::message(text).as_bytes()))
}

/// The same as it comes, there may be very much; on a terminal in lines that fit it.
pub fn print_text(text: &impl Display) -> Result<(), InputError> {
    let width = terminal_width();
    write_out(|out| {
        let mut out = Text { out, failed: None };
        let written = match width {
            Some(width) => write!(Wrapped::new(&mut out, width), "{text}"),
            None => write!(out, "{text}"),
        };
        match (written, out.failed) {
            (Ok(()), _) => Ok(()),
            (Err(_), failed) => Err(failed.unwrap_or_else(|| io::Error::other("a value cannot be written as text"))),
        }
    })
}

/// The same for JSON.
pub fn print_json(value: &impl serde::Serialize) -> Result<(), InputError> {
    write_out(|out| {
        serde_json::to_writer_pretty(Json(&mut *out), value)?;
        out.write_all(b"\n")
    })
}

/// Bytes to standard output. A reader that went away (`| head`) is no error; anything else that keeps bytes from
/// arriving is.
pub fn write_out(write: impl FnOnce(&mut dyn Write) -> io::Result<()>) -> Result<(), InputError> {
    let written = raw_stdout().map(BufWriter::new).and_then(|mut out| {
        write(&mut out)?;
        out.flush()
    });
    settle(written)
}

/// What an attempt to write to standard output comes to.
pub fn settle(written: io::Result<()>) -> Result<(), InputError> {
    let written = if IS_CLOSED.load(Ordering::Relaxed) { Err(io::Error::other("it is closed")) } else { written };
    match written {
        Err(error) if error.kind() == io::ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(InputError::new(format!("standard output cannot be written: {error}"))
            .help("what it was redirected to may be full or closed")),
        Ok(()) => Ok(()),
    }
}

/// The descriptor itself: `Stdout` takes one that cannot be written for one that takes all.
#[cfg(unix)]
fn raw_stdout() -> io::Result<std::fs::File> {
    use std::os::fd::AsFd;
    io::stdout().as_fd().try_clone_to_owned().map(Into::into)
}

#[cfg(not(unix))]
fn raw_stdout() -> io::Result<io::StdoutLock<'static>> {
    Ok(io::stdout().lock())
}

/// `None`: it is no terminal, and lines stay whole.
fn terminal_width() -> Option<usize> {
    let (_, columns) = io::stdout().is_terminal().then(|| console::Term::stdout().size())?;
    Some(usize::from(columns).clamp(20, WIDEST))
}

/// JSON, which serde_json hands on in whole characters.
struct Json<'a>(&'a mut dyn Write);

impl Write for Json<'_> {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.0.write_all(printable::json(&String::from_utf8_lossy(bytes)).as_bytes())?;
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        self.0.flush()
    }
}

/// Text goes to a file or a terminal as bytes.
struct Text<'a> {
    out: &'a mut dyn Write,
    failed: Option<io::Error>,
}

impl fmt::Write for Text<'_> {
    fn write_str(&mut self, text: &str) -> fmt::Result {
        self.out.write_all(printable::message(text).as_bytes()).map_err(|error| {
            self.failed = Some(error);
            fmt::Error
        })
    }
}

/// What the program says beside its result, on standard error. Where that cannot be written it is lost.
#[derive(Debug, Clone, Copy)]
pub struct Messages {
    pub quiet: bool,
    pub color: ColorChoice,
}

impl Messages {
    pub fn error(self, error: &InputError) {
        say(&report(error, self.has_color()));
    }

    pub fn warning(self, text: impl Display) {
        say(&printable::message(&format!("warning: {text}\n")));
    }

    /// Left out where the user wants quiet.
    pub fn note(self, text: impl Display) {
        if !self.quiet {
            say(&printable::message(&format!("{text}\n")));
        }
    }

    /// What was asked for, in lines of its own.
    pub fn answer(self, lines: &str) {
        say(lines);
    }

    fn has_color(self) -> bool {
        let is_set = |name| std::env::var_os(name).is_some_and(|value: std::ffi::OsString| !value.is_empty());
        match self.color {
            ColorChoice::Always => true,
            ColorChoice::Never => false,
            ColorChoice::Auto => io::stderr().is_terminal() && !is_set("NO_COLOR"),
        }
    }
}

fn say(text: &str) {
    let _ = io::stderr().write_all(text.as_bytes());
}
