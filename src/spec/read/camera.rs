//! `[camera]`.

use super::item::Item;
use super::keys;
use super::number::{cross, difference, length};
use super::table::Table;
use crate::InputError;
use crate::spec::range::SMALLEST_SIZE;
use crate::spec::{At, CameraPlace, CameraSpec, NumberRange, ProjectionSpec};

/// Sine of the smallest angle between `up` and the view that still says which way is up.
const LEAST_UP_SINE: f64 = 1e-6;

pub fn read(item: &Item) -> Result<At<CameraSpec>, InputError> {
    let table = Table::open(item, "[camera]", keys::CAMERA)?;
    let place = match table.get("node") {
        Some(node) => of_node(&table, &node)?,
        None => free(&table)?,
    };
    let near = clip(&table, "near", &place);
    let far = clip(&table, "far", &place);
    if let (Some(near), Some(far)) = (&near, &far)
        && near.value >= far.value
    {
        let message = format!("`near` must be below `far`, but {} is not below {}", near.value, far.value);
        return Err(
            InputError::at(item.file.source, near.span.clone(), message).label(far.span.clone(), "`far` is here")
        );
    }
    Ok(At::new(CameraSpec { place, near, far }, table.span))
}

fn of_node(table: &Table, node: &Item) -> Result<CameraPlace, InputError> {
    for key in ["eye", "target", "up", "fov_y", "orthographic_height"] {
        if let Some(item) = table.get(key) {
            return Err(item
                .error(format!("[camera] has both `node` and `{key}`"))
                .help("a camera of the file brings its own place and view: leave out one of the two")
                .label(node.span.clone(), "`node` is here"));
        }
    }
    Ok(CameraPlace::Node(node.at(node.text()?.to_owned())))
}

fn free(table: &Table) -> Result<CameraPlace, InputError> {
    let eye = table.read("eye", Item::vector);
    let target = table.read("target", Item::vector);
    let up = table.get("up").map(|up| up.direction()).transpose()?.unwrap_or([0.0, 1.0, 0.0]);
    if let (Some(eye), Some(target)) = (eye, target) {
        check_view(table, eye, target, up)?;
    }
    Ok(CameraPlace::Free { eye, target, up, projection: projection(table)? })
}

fn check_view(table: &Table, eye: [f64; 3], target: [f64; 3], up: [f64; 3]) -> Result<(), InputError> {
    let view = difference(target, eye);
    let distance = length(view);
    if distance < SMALLEST_SIZE {
        return Err(table
            .need("target")?
            .error("`eye` and `target` are the same point")
            .help("the view goes from one to the other"));
    }
    // Unit vectors first, so that the product neither overflows nor vanishes.
    let sine = length(cross(view.map(|x| x / distance), up.map(|x| x / length(up))));
    if sine < LEAST_UP_SINE {
        let place = table.get("up").map_or(table.need("target")?, |up| up);
        return Err(place
            .error("`up` is parallel to the view from `eye` to `target`")
            .help("give another `up`, such as [0, 0, 1] when looking straight down"));
    }
    Ok(())
}

fn projection(table: &Table) -> Result<ProjectionSpec, InputError> {
    match (table.get("fov_y"), table.get("orthographic_height")) {
        (Some(fov), Some(height)) => Err(height
            .error("[camera] has both `fov_y` and `orthographic_height`")
            .help("keep `fov_y` for a perspective view, `orthographic_height` for a parallel one")
            .label(fov.span, "`fov_y` is here")),
        (None, Some(height)) => height.number(NumberRange::POSITIVE).map(ProjectionSpec::OrthographicHeight),
        (Some(fov), None) => fov.number(NumberRange::open(0.0, 180.0)).map(ProjectionSpec::FovY),
        (None, None) => Ok(ProjectionSpec::FovY(45.0)),
    }
}

/// A distance of the near or far plane; a perspective camera needs it in front of the eye.
fn clip(table: &Table, key: &'static str, place: &CameraPlace) -> Option<At<f64>> {
    let perspective = matches!(place, CameraPlace::Free { projection: ProjectionSpec::FovY(_), .. });
    let range = if perspective { NumberRange::POSITIVE } else { NumberRange::ANY };
    table.read(key, |item| Ok(item.at(item.number(range)?)))
}
