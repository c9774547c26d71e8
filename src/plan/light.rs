//! The lights of a picture: the spec's, else the file's, else a rig.

use glam::Vec3;

use crate::appearance as wgsl;
use crate::scene::{LightKind, Model, Scene};
use crate::spec::{LightSpec, Spec};
use crate::view::View;

/// One light; the layout of WGSL's `Light`.
#[repr(C)]
#[derive(Debug, Clone, Copy, PartialEq, bytemuck::Pod, bytemuck::Zeroable)]
pub struct LightRecord {
    /// A `LIGHT_...` constant of the shaders.
    pub kind: u32,
    /// Scene units; 0 is unlimited.
    pub range: f32,
    pub cos_inner: f32,
    pub cos_outer: f32,
    /// Relative to the view's origin, along the world's axes.
    pub position: [f32; 4],
    /// The way the light travels, unit length, world space.
    pub direction: [f32; 4],
    /// Linear colour times intensity.
    pub color: [f32; 4],
}

#[derive(Debug, Clone, PartialEq)]
pub struct Lighting {
    pub ambient: f32,
    /// Where a little more of the ambient light comes from; unit length.
    pub up: Vec3,
    pub lights: Vec<LightRecord>,
}

/// Ambient light of the rig, and beside the lights of a file.
const RIG_AMBIENT: f32 = 0.35;
const FILE_AMBIENT: f32 = 0.1;

pub(super) fn resolve(spec: &Spec, scene: &Scene, view: &View) -> Lighting {
    let up = view.up.as_vec3();
    if let Some(light) = &spec.light {
        return Lighting { ambient: light.ambient, up, lights: declared(light) };
    }
    let file = file_lights(&scene.models[0], view.origin());
    if file.is_empty() {
        Lighting { ambient: RIG_AMBIENT, up, lights: rig(view) }
    } else {
        Lighting { ambient: FILE_AMBIENT, up, lights: file }
    }
}

fn directional(direction: Vec3, color: [f32; 3], intensity: f32) -> LightRecord {
    LightRecord {
        kind: wgsl::LIGHT_DIRECTIONAL.0,
        range: 0.0,
        cos_inner: 1.0,
        cos_outer: 0.0,
        position: [0.0; 4],
        direction: direction.normalize().extend(0.0).to_array(),
        color: [color[0] * intensity, color[1] * intensity, color[2] * intensity, 1.0],
    }
}

fn declared(light: &LightSpec) -> Vec<LightRecord> {
    light
        .directional
        .iter()
        .map(|d| {
            let [r, g, b, _] = d.color.to_linear();
            directional(glam::DVec3::from_array(d.direction).normalize().as_vec3(), [r, g, b], d.intensity)
        })
        .collect()
}

/// A warm key from the upper left of the eye, a cool fill from the right, and a faint light from behind.
fn rig(view: &View) -> Vec<LightRecord> {
    let world = |x: f64, y: f64, z: f64| (view.right * x + view.up * y + view.forward * z).as_vec3();
    vec![
        directional(world(0.55, -0.75, 0.75), [1.0, 0.97, 0.92], 2.4),
        directional(world(-0.9, -0.15, 0.6), [0.86, 0.93, 1.0], 0.8),
        directional(world(0.2, -0.4, -1.0), [1.0, 1.0, 1.0], 0.5),
    ]
}

fn file_lights(model: &Model, origin: glam::DVec3) -> Vec<LightRecord> {
    let lit = model.nodes.iter().filter(|n| n.is_shown()).filter_map(|n| Some((n, &model.lights[n.light?])));
    lit.map(|(node, light)| {
        let forward = -node.world_from_local.matrix3.z_axis;
        let base = directional(forward.normalize_or(glam::DVec3::NEG_Z).as_vec3(), light.color, light.intensity);
        let position = (node.world_from_local.translation - origin).as_vec3().extend(1.0).to_array();
        let range = light.range.unwrap_or(0.0);
        match light.kind {
            LightKind::Directional => base,
            LightKind::Point => LightRecord { kind: wgsl::LIGHT_POINT.0, range, position, ..base },
            LightKind::Spot { inner, outer } => LightRecord {
                kind: wgsl::LIGHT_SPOT.0,
                range,
                position,
                cos_inner: inner.cos(),
                cos_outer: outer.cos(),
                ..base
            },
        }
    })
    .collect()
}
