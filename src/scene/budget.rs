//! What opening a scene may take and reach.

use bytesize::ByteSize;

use crate::InputError;

/// What [`Scene::open_with`](super::Scene::open_with) and [`Model::load_with`](super::Model::load_with) may take and reach.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct OpenOptions {
    /// Bytes of memory for all that a spec names together, its models, their pictures and what drawing them on the CPU
    /// takes. Held against what a file asks for before that is taken, by an estimate on the safe side.
    pub memory_limit: u64,
    /// Buffers and images may lie outside the folder of the model that names them.
    pub allow_outside: bool,
}

impl OpenOptions {
    /// 8 GiB, on every machine: what is refused does not depend on where it is opened.
    pub const MEMORY_LIMIT: u64 = 8 << 30;
}

impl Default for OpenOptions {
    fn default() -> Self {
        Self { memory_limit: Self::MEMORY_LIMIT, allow_outside: false }
    }
}

/// What to do about a refusal.
pub(crate) const TO_TAKE_LESS: &str =
    "simplify or split it, or allow more with `--memory-limit SIZE` (in the library: `OpenOptions`)";

/// Bytes taken so far, and the most there may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Budget {
    limit: u64,
    used: u64,
}

impl Default for Budget {
    fn default() -> Self {
        Self::new(OpenOptions::MEMORY_LIMIT)
    }
}

impl Budget {
    pub fn new(limit: u64) -> Self {
        Self { limit, used: 0 }
    }

    /// Bytes that may still be taken.
    pub fn left(&self) -> u64 {
        self.limit.saturating_sub(self.used)
    }

    /// Takes `bytes`, or says that `what` takes them and how many there are.
    pub fn take(&mut self, bytes: u64, what: impl FnOnce() -> String) -> Result<(), InputError> {
        if bytes > self.left() {
            return Err(self.refusal(bytes, &what()));
        }
        self.used += bytes;
        Ok(())
    }

    /// Bytes that are needed no more.
    pub fn give_back(&mut self, bytes: u64) {
        self.used = self.used.saturating_sub(bytes);
    }

    /// The error of something that takes more than is left.
    pub fn refusal(&self, bytes: u64, what: &str) -> InputError {
        let beside = match self.used {
            0 => String::new(),
            used => format!(" beside the {} that are taken already", size_text(used)),
        };
        let limit = size_text(self.limit);
        InputError::new(format!("{what}: it takes about {} of memory{beside}, the limit is {limit}", size_text(bytes)))
            .help(TO_TAKE_LESS)
    }
}

/// A number of bytes as people read it.
fn size_text(bytes: u64) -> String {
    ByteSize::b(bytes).display().iec().to_string()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_adds_up_and_is_refused_with_numbers() {
        let mut budget = Budget::new(1 << 30);
        budget.take(1 << 29, || unreachable!()).expect("half of it");
        let error = budget.take(u64::MAX, || "a.glb: mesh 0".into()).expect_err("more than there is");
        assert!(
            error.message.starts_with("a.glb: mesh 0: it takes about 16.0 EiB of memory beside the 512.0 MiB"),
            "{error}"
        );
        assert!(error.message.ends_with("the limit is 1.0 GiB"), "{error}");
        budget.give_back(1 << 29);
        budget.take(1 << 30, || unreachable!()).expect("all of it");
    }
}
