//! Trials that are timed: after the last one the slowest are told.

use std::sync::{Mutex, PoisonError};
use std::time::{Duration, Instant};

use libtest_mimic::{Arguments, Conclusion, Failed, Trial};

/// How many are told, and of fewer trials none.
const TOLD: usize = 10;

static TOOK: Mutex<Vec<(Duration, String)>> = Mutex::new(Vec::new());

pub fn trial(name: impl Into<String>, check: impl FnOnce() -> Result<(), String> + Send + 'static) -> Trial {
    let name = name.into();
    Trial::test(name.clone(), move || {
        let start = Instant::now();
        let outcome = check().map_err(Failed::from);
        TOOK.lock().unwrap_or_else(PoisonError::into_inner).push((start.elapsed(), name));
        outcome
    })
}

/// Runs those trials that the command line asks for.
pub fn run(arguments: &Arguments, trials: Vec<Trial>) -> Conclusion {
    let conclusion = libtest_mimic::run(arguments, trials);
    let mut took = TOOK.lock().unwrap_or_else(PoisonError::into_inner);
    if took.len() > TOLD {
        took.sort();
        println!("the slowest:");
        took.iter().rev().take(TOLD).for_each(|(time, name)| println!("{:7.1} s {name}", time.as_secs_f64()));
        println!();
    }
    conclusion
}
