//! `lenspeel check`.

use std::path::Path;

use crate::plan::{Account, Plan};
use crate::scene::{OpenOptions, Scene};
use crate::spec::Spec;
use crate::{InputError, cpu};

/// Opens and decides everything, prints warnings, and fails on them where `strict`.
pub fn run(path: &Path, strict: bool, options: &OpenOptions) -> Result<(), InputError> {
    let spec = Spec::load(path)?;
    let scene = Scene::open_with(&spec, options)?;
    let plan = Plan::new(&spec, &scene)?;
    let account = Account::new(&spec, &plan);
    // On the GPU nodes share their meshes: a warning, no error.
    let memory = cpu::check_memory(&scene, &plan).err().map(|error| error.to_string());
    let warnings: Vec<&String> = plan.warnings.iter().chain(&memory).collect();
    let findings = warnings.len() + account.undecided.len();
    let mut text: String = warnings.iter().map(|w| format!("warning: {w}\n")).collect();
    text += &account.undecided_text();
    super::print(&text);
    if strict && findings > 0 {
        let message = format!("{}: {findings} warning(s), and --strict allows none", spec.source.name);
        return Err(InputError::new(message).help("see the lines above"));
    }
    let count = |n: usize, what: &str| format!("{n} {what}{}", if n == 1 { "" } else { "s" });
    let at_least = if account.ended.is_some() { "at least " } else { "" };
    super::print(&format!(
        "{}: good: {}, {at_least}{}, {}\n",
        spec.source.name,
        count(plan.lenses.len(), "lens").replace("lenss", "lenses"),
        count(account.regions.len(), "region"),
        count(findings, "warning"),
    ));
    if let Some(ended) = &account.ended {
        super::print(&format!("note: {ended}; undecided pairs were looked for in those\n"));
    }
    Ok(())
}
