//! Many cases, one after the other; a failure is made small and written where it can be run again.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use crate::case::Case;
use crate::check::{Answers, Tally, check};
use crate::product::Party;
use crate::shrink::shrink;
use crate::{files, generate};

/// Cases in the tests; `LENSPEEL_COMPOSED_CASES` asks for another number.
const CASES: u64 = 60;
/// Seeds that once found something; they come first.
const FOUND: &[u64] = &[];

/// The seeds to run: some, from `LENSPEEL_COMPOSED_SEED` on if that is set.
fn seeds() -> Vec<u64> {
    let number = |name: &str| {
        let text = std::env::var(name).ok()?;
        Some(text.parse().unwrap_or_else(|_| panic!("{name} must be a whole number, not `{text}`")))
    };
    let first = number("LENSPEEL_COMPOSED_SEED");
    let count = number("LENSPEEL_COMPOSED_CASES").unwrap_or(if first.is_some() { 1 } else { CASES });
    let found = FOUND.iter().copied().filter(|_| first.is_none());
    found.chain((0..count).map(|i| first.unwrap_or(0) + i)).collect()
}

/// The answers of a seed, worked out once for all parties.
fn answers(index: usize, seed: u64) -> &'static Answers {
    static ALL: OnceLock<Vec<OnceLock<Answers>>> = OnceLock::new();
    let all = ALL.get_or_init(|| seeds().iter().map(|_| OnceLock::new()).collect());
    all[index].get_or_init(|| Answers::new(&generate::case(seed), seed))
}

fn folder(name: &str) -> PathBuf {
    Path::new(env!("CARGO_TARGET_TMPDIR")).join("composed").join(name)
}

/// Every case against one party; all failures, and how much was compared.
pub fn all(party: Party) -> Result<(), String> {
    let mut failures = Vec::new();
    let mut tally = Tally::default();
    let seeds = seeds();
    for (index, seed) in seeds.iter().copied().enumerate() {
        let folder = folder(&format!("{}-{seed}", party.name()));
        let case = generate::case(seed);
        let answers = answers(index, seed);
        tally += answers.tally();
        match check(&files::write(&case, &folder), answers, party) {
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
