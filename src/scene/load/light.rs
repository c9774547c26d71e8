//! Lights of `KHR_lights_punctual`.

use gltf::khr_lights_punctual::Kind;

use super::{File, object};
use crate::InputError;
use crate::scene::{Light, LightKind};

pub fn load(file: &File<'_>) -> Result<Vec<Light>, InputError> {
    file.document.lights().into_iter().flatten().map(|light| read(file, &light)).collect()
}

fn read(file: &File<'_>, light: &gltf::khr_lights_punctual::Light<'_>) -> Result<Light, InputError> {
    let label = object("light", light.index(), light.name());
    let bad = |what: &str| Err(file.error(&label, what));
    if !light.color().iter().chain([&light.intensity()]).all(|v| v.is_finite() && *v >= 0.0) {
        return bad("its colour or intensity is negative or not finite");
    }
    if light.range().is_some_and(|r| r <= 0.0 || r.is_nan()) {
        return bad("its range is not positive");
    }
    let kind = match light.kind() {
        Kind::Directional => LightKind::Directional,
        Kind::Point => LightKind::Point,
        Kind::Spot { inner_cone_angle: inner, outer_cone_angle: outer } => {
            if !(inner >= 0.0 && inner < outer && outer <= std::f32::consts::FRAC_PI_2) {
                return bad("its cone angles are not 0 <= inner < outer <= pi/2");
            }
            LightKind::Spot { inner, outer }
        }
    };
    Ok(Light {
        name: light.name().unwrap_or_default().to_string(),
        color: light.color(),
        intensity: light.intensity(),
        range: light.range().filter(|r| r.is_finite()),
        kind,
    })
}
