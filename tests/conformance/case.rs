//! One case: a spec and what is expected of it.

use std::fs;
use std::path::{Path, PathBuf};

use lenspeel::cpu;
use lenspeel::frame::Frame;
use lenspeel::output::RegionMap;

use crate::compare::compare;
use crate::expected::Expected;
use crate::open::{Opened, open};

/// The specs of a folder, sorted.
pub fn specs(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a folder of cases");
    let mut paths: Vec<PathBuf> = entries
        .map(|entry| entry.expect("a readable folder").path())
        .filter(|path| path.extension().is_some_and(|extension| extension == "toml"))
        .collect();
    paths.sort();
    paths
}

pub fn stem(path: &Path) -> String {
    path.file_stem().expect("a file name").to_string_lossy().into_owned()
}

/// At the case's own size, one sample a pixel.
fn open_case(path: &Path) -> Result<Opened, String> {
    let text = fs::read_to_string(path).map_err(|error| format!("{}: {error}", path.display()))?;
    Ok(open(path, &text, |spec| spec.image.samples = 1)?.1)
}

pub fn on_cpu(opened: &Opened) -> Result<Frame, String> {
    Ok(cpu::Renderer::new(&opened.scene, &opened.plan)
        .and_then(|cpu| cpu.render(true, &|_| ()))
        .expect("the CPU draws it"))
}

/// Renders a case and compares everything that is expected of it.
pub fn check(path: &Path, render: impl FnOnce(&Opened) -> Result<Frame, String>) -> Result<(), String> {
    let opened = open_case(path)?;
    let folder = path.with_file_name("expected").join(stem(path));
    let expected = Expected::read(&folder, &opened.plan)?;
    check_order(&opened, &expected)?;
    let frame = render(&opened)?;
    check_stacks(&opened, &frame, &expected)?;
    compare(&expected.reference, &frame)?.verdict()
}

fn check_order(opened: &Opened, expected: &Expected) -> Result<(), String> {
    let order: Vec<&str> = opened.plan.lenses.iter().map(|lens| lens.name.as_str()).collect();
    if order == expected.order {
        return Ok(());
    }
    Err(format!("the order {:?} is wanted, {order:?} is there", expected.order))
}

/// The stacks of all regions that both have found.
fn check_stacks(opened: &Opened, frame: &Frame, expected: &Expected) -> Result<(), String> {
    let aovs = frame.aovs.as_ref().ok_or("the picture has no AOVs")?;
    for region in RegionMap::new(&opened.plan, &[], aovs).map_err(|e| e.to_string())?.regions {
        let got: Vec<serde_json::Value> = region.stack.iter().map(|entry| entry.json()).collect();
        if let Some(want) = expected.stacks.get(&region.region.set).filter(|want| **want != got) {
            return Err(format!("the stack of {}: {want:?} is wanted, {got:?} is there", region.lenses.join(" + ")));
        }
    }
    Ok(())
}
