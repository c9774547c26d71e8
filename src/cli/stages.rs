//! How long the stages of a run take, and how far it is.

use std::io::IsTerminal;
use std::time::Instant;

use indicatif::{ProgressBar, ProgressStyle};

use super::streams::Messages;

/// Seconds of the stages in the order in which they ran.
#[derive(Debug)]
pub struct Stages {
    pub messages: Messages,
    seconds: Vec<(&'static str, f64)>,
}

impl Stages {
    pub fn new(messages: Messages) -> Self {
        Self { messages, seconds: Vec::new() }
    }

    pub fn time<T>(&mut self, name: &'static str, work: impl FnOnce() -> T) -> T {
        let start = Instant::now();
        let result = work();
        self.note(name, start.elapsed().as_secs_f64());
        result
    }

    pub fn note(&mut self, name: &'static str, seconds: f64) {
        self.seconds.push((name, seconds));
    }

    pub fn text(&self) -> String {
        self.seconds.iter().map(|(name, seconds)| format!("{name:>10} {:9.1} ms\n", seconds * 1e3)).collect()
    }

    pub fn json(&self) -> serde_json::Value {
        let seconds = self.seconds.iter().map(|(name, s)| ((*name).to_string(), serde_json::json!(s)));
        serde_json::Value::Object(seconds.collect())
    }

    /// A bar on a terminal, nothing elsewhere.
    pub fn progress(&self, steps: u64) -> ProgressBar {
        if self.messages.quiet || !std::io::stderr().is_terminal() {
            return ProgressBar::hidden();
        }
        let style = ProgressStyle::with_template("{bar:40} {percent:>3} % {eta} {msg}");
        ProgressBar::new(steps).with_style(style.unwrap_or_else(|_| ProgressStyle::default_bar()))
    }
}
