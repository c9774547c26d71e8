//! From a spec file of the project to its plan.

use std::path::Path;

use lenspeel::plan::Plan;
use lenspeel::scene::Scene;
use lenspeel::spec::Spec;

/// All that a backend needs.
pub struct Opened {
    pub scene: Scene,
    pub plan: Plan,
}

/// Opens a spec's text as if it were the file at `path`, after a change; messages call the file by its name alone.
pub fn open(path: &Path, text: &str, change: impl FnOnce(&mut Spec)) -> Result<(Spec, Opened), String> {
    let name = path.file_name().map(|name| name.to_string_lossy().into_owned()).unwrap_or_default();
    let folder = path.parent().unwrap_or(Path::new(""));
    let mut spec = Spec::parse(text, &name, folder).map_err(|error| error.to_string())?;
    change(&mut spec);
    let scene = Scene::open(&spec).map_err(|error| error.to_string())?;
    let plan = Plan::new(&spec, &scene).map_err(|error| error.to_string())?;
    Ok((spec, Opened { scene, plan }))
}
