//! Which specs the engines of the GPU backend draw, and in which order.

use std::path::Path;
use std::sync::Arc;

use lenspeel::gpu::Needs;
use libtest_mimic::{Arguments, Trial};
use rayon::prelude::*;

use crate::entry::Entry;
use crate::{compare, gpu, pick, trial};

/// A spec and what decides who draws it when; a spec that cannot be opened needs nothing, and its trials say why.
struct Drawn<'a> {
    entry: &'a Arc<Entry>,
    needs: Option<Needs>,
    /// There are several lenses or rules.
    overlaps: bool,
    first_of_folder: bool,
}

/// The trials of those specs that the command line asks for. Specs that need the same shaders come one after the other
/// (see `support/gpu.rs`), from two ends of the order in turn, so that two tests that run at a time draw with two devices.
pub fn trials(arguments: &Arguments, entries: &[Arc<Entry>]) -> Vec<Trial> {
    let ignored = gpu::is_ignored();
    let mut drawn: Vec<Drawn> = (0..entries.len())
        .into_par_iter()
        .filter(|number| is_asked(arguments, &entries[*number]))
        .map(|number| {
            let folder = |number: usize| Path::new(&entries[number].name).parent();
            let first_of_folder = number == 0 || folder(number - 1) != folder(number);
            Drawn::new(&entries[number], first_of_folder)
        })
        .collect();
    drawn.sort_by_key(|drawn| drawn.needs.map(|needs| (needs.for_accounts(), needs)));
    let all = drawn.iter().flat_map(Drawn::trials).collect();
    in_turn(all).into_iter().map(|trial| trial.with_ignored_flag(ignored)).collect()
}

impl<'a> Drawn<'a> {
    fn new(entry: &'a Arc<Entry>, first_of_folder: bool) -> Self {
        let opened = entry.open().ok().map(|(_, opened)| opened);
        let overlaps = opened.as_ref().is_some_and(|opened| opened.plan.lenses.len() + opened.plan.rules.len() > 1);
        Self { entry, needs: opened.map(|opened| gpu::needs(&opened)), overlaps, first_of_folder }
    }

    /// `peel` draws where layers matter: where there are several lenses or rules, or one that asks for layers because
    /// it takes away, moves, closes, has several parts or may be seen through. Elsewhere the engines differ in nothing but
    /// how a lens of one part is cut off, which the first spec of a folder shows.
    fn is_peeled(&self) -> bool {
        self.first_of_folder || self.overlaps || self.needs.is_none_or(|needs| needs.layers || needs.taken_away)
    }

    fn trials(&self) -> Vec<Trial> {
        let entry = self.entry;
        let is_drawn = |name: &str| name != "peel" || self.is_peeled();
        let engines = gpu::ENGINES.into_iter().filter(|(_, name)| is_drawn(name));
        let mut trials: Vec<Trial> = engines
            .map(|(engine, name)| {
                trial(entry, name, move |entry| {
                    let actual = gpu::render(&entry.open()?.1, engine)?;
                    compare::compare(entry.reference()?, &actual)?.verdict()
                })
            })
            .collect();
        if pick::SPECS.contains(&entry.name.as_str()) {
            trials.extend([trial(entry, "pick-gpu", pick::on_gpu), trial(entry, "report-gpu", pick::reports_agree)]);
        }
        trials
    }
}

/// Whether a trial of a spec, one of all that there can be, has the name that the command line asks for.
fn is_asked(arguments: &Arguments, entry: &Entry) -> bool {
    let Some(filter) = &arguments.filter else { return true };
    let names = ["fused", "peel", "pick-gpu", "report-gpu"].map(|what| format!("{}::{what}", entry.name));
    names.iter().any(|name| if arguments.exact { name == filter } else { name.contains(filter) })
}

/// From the first half and from the second in turn.
fn in_turn(mut first: Vec<Trial>) -> Vec<Trial> {
    let mut second = first.split_off(first.len().div_ceil(2)).into_iter();
    first.into_iter().flat_map(|trial| [Some(trial), second.next()]).flatten().collect()
}
