//! The plan and the regions of a spec, as recorded.

use std::path::Path;

use lenspeel::plan::Account;

use crate::art;
use crate::entry::Entry;

/// The whole account: order, regions, stacks, and the reason for each.
pub fn plan(entry: &Entry) -> Result<(), String> {
    let (spec, opened) = entry.open()?;
    check(entry, "plan", &Account::new(&spec, &opened.plan).text(&spec, &opened.plan));
    Ok(())
}

/// The region map as text.
pub fn regions(entry: &Entry) -> Result<(), String> {
    let (_, opened) = entry.open()?;
    let frame = &entry.reference()?.frame;
    let aovs = frame.aovs.as_ref().ok_or("the reference has no AOVs")?;
    check(entry, "regions", &art::of(&opened.plan, frame.size, aovs));
    Ok(())
}

fn check(entry: &Entry, what: &str, text: &str) {
    let name = Path::new(&entry.name);
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/specs/snapshots");
    let file = name.file_name().unwrap_or_default().to_string_lossy();
    let mut settings = insta::Settings::clone_current();
    settings.set_snapshot_path(folder.join(name.parent().unwrap_or(Path::new(""))));
    settings.set_prepend_module_to_snapshot(false);
    settings.set_omit_expression(true);
    settings.bind(|| insta::assert_snapshot!(format!("{file}.{what}"), text));
}
