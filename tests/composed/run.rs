//! Many cases, one after the other; a failure is made small and written where it can be run again.

use std::ops::Range;
use std::path::{Path, PathBuf};

use crate::case::Case;
use crate::check::{Answers, Tally, check};
use crate::product::Party;
use crate::shrink::shrink;
use crate::{files, generate};

/// Seeds in the tests; `LENSPEEL_COMPOSED_CASES` and `LENSPEEL_COMPOSED_SEED` ask for others. The GPU gets fewer, which
/// between them cut, move and have a rule: a software one takes seconds to compile the shaders of each mixture.
const SEEDS: Range<u64> = 0..40;
const SEEDS_ON_GPU: Range<u64> = 3..6;

/// The seeds to run for a party, from `LENSPEEL_COMPOSED_SEED` on; those that need the same shaders one after the other,
/// for a software GPU keeps only a few.
fn seeds(party: Party) -> Vec<u64> {
    let number = |name: &str| {
        let text = std::env::var(name).ok()?;
        Some(text.parse::<u64>().unwrap_or_else(|_| panic!("{name} must be a whole number, not `{text}`")))
    };
    let usual = if matches!(party, Party::Cpu) { SEEDS } else { SEEDS_ON_GPU };
    let first = number("LENSPEEL_COMPOSED_SEED").unwrap_or(usual.start);
    let count = number("LENSPEEL_COMPOSED_CASES").unwrap_or(usual.end - usual.start);
    let mut seeds: Vec<u64> = (first..first + count).collect();
    seeds.sort_by_cached_key(|seed| {
        let case = generate::case(*seed);
        (case.lenses.len() > 12, !case.solids.is_empty())
    });
    seeds
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("composed").join(name)
}

/// Every case against one party; all failures, and how much was compared.
pub fn all(party: Party) -> Result<(), String> {
    let mut failures = Vec::new();
    let mut tally = Tally::default();
    let seeds = seeds(party);
    for seed in seeds.iter().copied() {
        let folder = folder(&format!("{}-{seed}", party.name()));
        let case = generate::case(seed);
        let answers = Answers::new(&case, seed);
        tally += answers.tally();
        match check(&files::write(&case, &folder), &answers, party) {
            Ok(()) => std::fs::remove_dir_all(&folder).map_err(|error| error.to_string())?,
            Err(difference) => failures.push(failure(seed, party, &folder, &difference)),
        }
    }
    println!("{}: {} cases, {tally:?}", party.name(), seeds.len());
    if tally.doubtful * 2 > tally.pixels {
        failures.push(format!("{} of {} pixels are doubtful", tally.doubtful, tally.pixels));
    }
    if failures.is_empty() { Ok(()) } else { Err(failures.join("\n")) }
}

/// Writes the smallest case that fails, and says how.
fn failure(seed: u64, party: Party, folder: &Path, difference: &str) -> String {
    let small = folder.join("small");
    let outcome = |case: &Case| check(&files::write(case, &small), &Answers::new(case, seed), party);
    // A case that the product refuses differs in another way.
    let fails = |case: &Case| outcome(case).is_err_and(|text| text.contains("is expected"));
    if !fails(&generate::case(seed)) {
        return format!("seed {seed}, {}, in {}: {difference}", party.name(), folder.display());
    }
    let smallest = shrink(&generate::case(seed), fails);
    let text = outcome(&smallest).err().unwrap_or_default();
    format!("seed {seed}, {}: {difference}\n  smaller, in {}: {text}", party.name(), small.join("case.toml").display())
}
