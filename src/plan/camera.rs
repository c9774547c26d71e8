//! From `[camera]` to a view.

use glam::DVec3;

use super::lenses::Placed;
use super::{anchor, instances};
use crate::InputError;
use crate::scene::{Aabb, Camera, FARTHEST, Scene};
use crate::spec::{By, CameraPlace, ProjectionSpec, Spec};
use crate::view::{Anchor, Merging, Projection, View};

/// Where the default camera looks from, seen from the centre of the bounds.
const DEFAULT_DIRECTION: DVec3 = DVec3::new(1.0, 0.7, 1.3);
const DEFAULT_FOV_Y: f64 = 45.0;
/// Fitted planes keep at least this share of the depth away from what they must not cut.
const LEAST_MARGIN: f64 = 1e-4;
/// How near the fitted near plane of an eye among what it sees is, as a share of how far that is: nothing is lost by a
/// very near plane, as drawn depths are floating-point numbers that fall with the distance.
const NEAREST: f64 = 1e-12;
/// What double precision leaves of the eye's own coordinates.
const EYE_ROUNDING: f64 = 1e-14;
/// Of what a scene's depth comes to, no more than so many pictures counts as what is drawn.
const DEEPEST: f64 = 8.0;

/// The camera of a spec; near and far are placeholders until [`fit_depths`].
pub(super) fn place(spec: &Spec, scene: &Scene) -> Result<View, InputError> {
    let bounds = scene.models[0].bounds();
    let size = spec.image.size;
    let free = |eye, target, up, projection| free_view(size, eye, target, up, projection, &bounds);
    let Some(camera) = &spec.camera else {
        return free(None, None, DVec3::Y, ProjectionSpec::FovY(DEFAULT_FOV_Y)).map_err(InputError::new);
    };
    let at = |message: String| InputError::at(&spec.source, camera.span.clone(), message);
    match &camera.value.place {
        CameraPlace::Free { eye, target, up, projection } => {
            free(eye.map(DVec3::from_array), target.map(DVec3::from_array), DVec3::from_array(*up), *projection)
                .map_err(at)
        }
        CameraPlace::Node(name) => node_view(size, &name.value, scene)
            .map_err(|(message, help)| InputError::at(&spec.source, name.span.clone(), message).help(help)),
    }
}

fn free_view(
    size: [u32; 2],
    eye: Option<DVec3>,
    target: Option<DVec3>,
    up: DVec3,
    projection: ProjectionSpec,
    bounds: &Aabb,
) -> Result<View, String> {
    let bounds = if bounds.is_empty() { Aabb { min: DVec3::NEG_ONE, max: DVec3::ONE } } else { *bounds };
    let target = target.unwrap_or(bounds.center());
    let forward = eye.map_or(-DEFAULT_DIRECTION, |eye| target - eye).normalize_or_zero();
    let right = forward.cross(up).normalize_or_zero();
    if forward == DVec3::ZERO || right == DVec3::ZERO {
        return Err(
            "the camera needs an `eye` apart from its `target`, and an `up` across the line between them".into()
        );
    }
    let projection = match projection {
        ProjectionSpec::FovY(degrees) => Projection::Perspective { tan_half_y: (degrees.to_radians() * 0.5).tan() },
        ProjectionSpec::OrthographicHeight(height) => Projection::Orthographic { half_height: height * 0.5 },
    };
    let up = right.cross(forward);
    let anchor = Anchor::default();
    let mut view = View { eye: target, right, up, forward, projection, anchor, near: 0.0, far: 1.0, size };
    view.eye = eye.unwrap_or_else(|| target - forward * fitting_distance(&view, &bounds));
    Ok(view)
}

/// How far back from the target the eye of a view must be for the bounds to just fit the picture.
fn fitting_distance(view: &View, bounds: &Aabb) -> f64 {
    let aspect = f64::from(view.size[0]) / f64::from(view.size[1]);
    let tan_y = match view.projection {
        Projection::Perspective { tan_half_y } => tan_half_y,
        Projection::Orthographic { .. } => return bounds.size().length(),
    };
    let needed = |corner: DVec3| {
        let offset = corner - view.eye;
        let across = (offset.dot(view.right).abs() / (tan_y * aspect)).max(offset.dot(view.up).abs() / tan_y);
        across - offset.dot(view.forward)
    };
    // Of a scene that is a point any distance shows as much.
    let least = if bounds.size() == DVec3::ZERO { 1.0 } else { 0.0 };
    bounds.corners().into_iter().map(needed).fold(least, f64::max) * 1.03
}

fn node_view(size: [u32; 2], name: &str, scene: &Scene) -> Result<View, (String, String)> {
    let model = &scene.models[0];
    let has_camera = |i: &usize| model.nodes[*i].camera.is_some();
    let known = || {
        let names: Vec<String> =
            (0..model.nodes.len()).filter(has_camera).map(|i| format!("`{}`", model.nodes[i].name)).collect();
        if names.is_empty() {
            "the file has no cameras".into()
        } else {
            format!("cameras of the file: {}", names.join(", "))
        }
    };
    let found: Vec<usize> =
        (0..model.nodes.len()).filter(|i| model.nodes[*i].name == name).filter(has_camera).collect();
    let [index] = found[..] else {
        let problem = if found.is_empty() { "no camera node" } else { "several camera nodes" };
        return Err((format!("{problem} of `{}` is named `{name}`", model.name), known()));
    };
    let node = &model.nodes[index];
    let axes = node.world_from_local.matrix3;
    let forward = (-axes.z_axis).normalize_or_zero();
    let right = forward.cross(axes.y_axis).normalize_or_zero();
    if forward == DVec3::ZERO || right == DVec3::ZERO {
        return Err((format!("the camera node `{name}` has a scale of zero"), known()));
    }
    let camera = model.cameras[node.camera.unwrap_or_default()];
    let (projection, near, far) = match camera {
        Camera::Perspective { fov_y, near, far } => {
            (Projection::Perspective { tan_half_y: (fov_y * 0.5).tan() }, near, far.unwrap_or(f64::INFINITY))
        }
        Camera::Orthographic { half_height, near, far } => (Projection::Orthographic { half_height }, near, far),
    };
    let eye = node.world_from_local.translation;
    let anchor = Anchor::default();
    Ok(View { eye, right, up: right.cross(forward), forward, projection, anchor, near, far, size })
}

/// Sets near and far: as given, else as the file's camera has them, else so that nothing in front of the eye is cut; and
/// where depths are counted from.
pub(super) fn fit_depths(
    view: &mut View,
    spec: &Spec,
    scene: &Scene,
    volumes: &[Option<Placed>],
    order: &[usize],
) -> Result<(), InputError> {
    let camera = spec.camera.as_ref();
    let (given_near, given_far) = camera
        .map_or((None, None), |c| (c.value.near.as_ref().map(|n| n.value), c.value.far.as_ref().map(|f| f.value)));
    let from_file = camera.is_some_and(|c| matches!(c.value.place, CameraPlace::Node(_)));
    let (depth, unit) = anchor::find(view, scene);
    let content = Content::new(view, spec, scene, volumes, order);
    let Fitted { near: fitted_near, far: fitted_far, drawn } = content.fitted(view, depth, unit);
    let (near, far) = if from_file { (view.near, view.far) } else { (fitted_near, fitted_far) };
    view.near = given_near.unwrap_or(near);
    view.far = given_far.unwrap_or(if far.is_finite() { far } else { fitted_far.max(view.near * 2.0) });
    // A plane that was given moves the fitted one out of its way.
    if view.near >= view.far {
        match (given_near, given_far) {
            (Some(near), None) => view.far = near + near.abs().max(1.0),
            (None, Some(far)) => {
                view.near = if view.is_perspective() { far * NEAREST } else { far - far.abs().max(1.0) }
            }
            _ => {
                let message = format!("near ({}) must be smaller than far ({})", view.near, view.far);
                let span = camera.map_or(0..0, |c| c.span.clone());
                return Err(InputError::at(&spec.source, span, message));
            }
        }
    }
    let drawn = [drawn[0].max(view.near), drawn[1].min(view.far)];
    let drawn = if drawn[0] < drawn[1] { drawn } else { [view.near, view.far] };
    let merging = Merging {
        eye: view.is_perspective().then_some(depth),
        most: 1e-6 * content.diagonal(view),
        across: view.half_diagonal() * if view.is_perspective() { depth } else { 1.0 },
    };
    view.anchor = Anchor { depth, unit, drawn: drawn.map(|from_eye| from_eye - depth), merging };
    (view.near, view.far) = (view.near - depth, view.far - depth);
    Ok(())
}

/// What there is to be seen.
struct Content {
    /// World bounds of the models.
    bounds: Aabb,
    /// The depths from the eye of all of the scene, where lenses move it too, and of the lenses.
    scene: [f64; 2],
    lenses: [f64; 2],
}

/// Planes that cut nothing, as depths from the eye.
struct Fitted {
    near: f64,
    far: f64,
    /// Around all of the scene that may be seen.
    drawn: [f64; 2],
}

const NONE: [f64; 2] = [f64::INFINITY, f64::NEG_INFINITY];

fn both(a: [f64; 2], b: [f64; 2]) -> [f64; 2] {
    [a[0].min(b[0]), a[1].max(b[1])]
}

impl Content {
    fn new(view: &View, spec: &Spec, scene: &Scene, volumes: &[Option<Placed>], order: &[usize]) -> Self {
        let models = || scene.models.iter().map(|m| m.bounds()).filter(|b| !b.is_empty());
        let hulls: Vec<DVec3> = volumes.iter().flatten().flat_map(|placed| placed.volume.hull()).collect();
        let bounds = models().fold(Aabb::EMPTY, Aabb::union);
        // Whatever lenses move is seen inside them only, but a flat lens reaches as far as there is something to see, and
        // what moves whole objects shows them wherever that is.
        let mut points: Vec<DVec3> = models().flat_map(|b| b.corners()).collect();
        let mut seen = Aabb::from_points(points.iter().chain(&hulls).copied());
        for index in order {
            let (Some(placed), lens) = (&volumes[*index], &spec.lenses[*index]) else { continue };
            let is_bounded = lens.by == By::Pixel && placed.volume.bounds().size().is_finite();
            for filter in &lens.filters {
                if let Some(reach) = instances::reach(&filter.value, placed, &seen, view) {
                    points.extend(if is_bounded { placed.volume.bounds().corners() } else { reach.corners() });
                    if !is_bounded {
                        seen = seen.union(reach);
                    }
                }
            }
        }
        let depths = |points: &[DVec3]| {
            let depths = points.iter().map(|p| view.depth(*p)).filter(|depth| depth.is_finite());
            depths.fold(NONE, |range, depth| both(range, [depth, depth]))
        };
        Self { bounds, scene: depths(&points), lenses: depths(&hulls) }
    }

    /// Room is kept for rounding, which is a share of depths as they are counted from `anchor`; `unit`: as
    /// [`Anchor::unit`].
    fn fitted(&self, view: &View, anchor: f64, unit: f64) -> Fitted {
        let [low, high] = both(self.scene, self.lenses);
        let [low, high] = if low > high { [0.0, 1.0] } else { [low, high] };
        let margin = |[low, high]: [f64; 2]| {
            let farthest = (low - anchor).abs().max((high - anchor).abs()).max(1e-5 * unit);
            (0.01 * (high - low)).max(LEAST_MARGIN * farthest)
        };
        let wider = |range: [f64; 2]| [range[0] - margin(range), range[1] + margin(range)];
        let [near, far] = wider([low, high]);
        let drawn = if self.scene[0] > self.scene[1] { [near, far] } else { wider(self.scene) };
        if !view.is_perspective() {
            return Fitted { near: near.max(-FARTHEST), far: far.min(FARTHEST), drawn };
        }
        let nearest = (NEAREST * unit).max(EYE_ROUNDING * view.eye.abs().max_element());
        let far = if high > 0.0 { far.min(FARTHEST) } else { 1.0 };
        Fitted { near: near.max(nearest), far, drawn }
    }

    /// Of what the picture shows. All of an orthographic picture is drawn to one scale, so that of a scene far larger than
    /// it only that counts; what a perspective one shows is as large as it is far.
    fn diagonal(&self, view: &View) -> f64 {
        let range = both(self.scene, self.lenses);
        let whole = if self.bounds.is_empty() { (range[1] - range[0]).max(0.0) } else { self.bounds.size().length() };
        if view.is_perspective() { whole } else { whole.min(DEEPEST * view.half_diagonal()) }
    }
}
