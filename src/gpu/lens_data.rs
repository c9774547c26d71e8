//! The lenses of a plan as records: their volumes as functions of the pixel, their surfaces, their filters.

use glam::{DAffine3, DVec3};

use super::depth_maps::{DepthMap, DepthMaps};
use super::records::{self, LensRecord, extended, words_of};
use crate::lens::{Form, Plane, Solid};
use crate::plan::{Lens, Plan};
use crate::view::View;

/// Lenses with the lists that they point into.
#[derive(Debug, Clone, Default)]
pub struct LensData {
    /// A record and the words of the set that it hides, for each lens.
    pub lenses: Vec<u8>,
    /// Planes and corners.
    pub vectors: Vec<[f32; 4]>,
}

/// What a ray is, relative to the eye, at a point (x, y) of the picture: `fixed` and `base + x dx + y dy`.
#[derive(Debug, Clone, Copy)]
pub struct AffineRay {
    /// The origin of a perspective camera's rays, the direction of an orthographic one's.
    pub fixed: DVec3,
    pub base: DVec3,
    pub dx: DVec3,
    pub dy: DVec3,
}

impl AffineRay {
    pub fn new(view: &View) -> Self {
        let corner = view.ray(0.0, 0.0);
        let (dx, dy) = view.pixel_steps();
        let origin = corner.origin - view.eye;
        if view.is_perspective() {
            Self { fixed: origin, base: corner.direction, dx, dy }
        } else {
            Self { fixed: corner.direction, base: origin, dx, dy }
        }
    }

    /// The same in another space, of which `local` is the map from the space around the eye.
    fn in_space(&self, local: &DAffine3, perspective: bool) -> Self {
        let point = |p| local.transform_point3(p);
        let vector = |v| local.transform_vector3(v);
        let (fixed, base) =
            if perspective { (point(self.fixed), vector(self.base)) } else { (vector(self.fixed), point(self.base)) };
        Self { fixed, base, dx: vector(self.dx), dy: vector(self.dy) }
    }

    /// The coefficients of a plane: its distance along the origins and its rate along the directions, one of them
    /// fixed (first), the other a function of the pixel.
    fn plane(&self, plane: &Plane, perspective: bool) -> [f32; 4] {
        let n = plane.normal;
        let (fixed, base) = if perspective {
            (plane.distance(self.fixed), n.dot(self.base))
        } else {
            (n.dot(self.fixed), plane.distance(self.base))
        };
        [fixed, base, n.dot(self.dx), n.dot(self.dy)].map(|c| c as f32)
    }
}

impl LensData {
    pub fn new(plan: &Plan, words: u32, maps: &DepthMaps) -> Self {
        let mut data = Self::default();
        let ray = AffineRay::new(&plan.view);
        for (rank, lens) in plan.lenses.iter().enumerate() {
            let mut record = data.record(plan, lens, &ray);
            if let Some(map) = maps.of_lens(rank) {
                set_map(&mut record, map, lens.volume.contains(plan.view.eye));
            }
            data.lenses.extend_from_slice(bytemuck::bytes_of(&record));
            words_of(&lens.hides, words).for_each(|word| data.lenses.extend_from_slice(&word.to_le_bytes()));
            // Records start at multiples of 16 bytes.
            data.lenses.resize(data.lenses.len().next_multiple_of(16), 0);
        }
        data
    }

    fn record(&mut self, plan: &Plan, lens: &Lens, ray: &AffineRay) -> LensRecord {
        let volume = &lens.volume.parts[0];
        let perspective = plan.view.is_perspective();
        let local_from_eye = volume.local_from_world * DAffine3::from_translation(plan.view.eye);
        let local = ray.in_space(&local_from_eye, perspective);
        let normals = volume.local_from_world.matrix3.transpose();
        let mut record = LensRecord {
            ray_fixed: extended(local.fixed),
            ray_base: extended(local.base),
            ray_dx: extended(local.dx),
            ray_dy: extended(local.dy),
            normal_x: extended(normals.x_axis),
            normal_y: extended(normals.y_axis),
            normal_z: extended(normals.z_axis),
            first_op: lens.ops.start as u32,
            op_count: lens.ops.len() as u32,
            ..bytemuck::Zeroable::zeroed()
        };
        if let Some(glass) = lens.glass {
            record.glass = glass;
            record.flags |= records::LENS_GLASS;
        }
        if volume.is_flat {
            record.flags |= records::LENS_FLAT;
            record.first_corner = self.vectors.len() as u32;
            record.corner_count = volume.hull.len() as u32;
            self.vectors.extend(volume.hull.iter().map(|p| extended(*p - plan.view.eye)));
        }
        self.set_form(&mut record, volume, &local, perspective);
        record
    }

    fn set_form(&mut self, record: &mut LensRecord, volume: &Solid, ray: &AffineRay, perspective: bool) {
        match &volume.form {
            Form::Sphere => record.form = records::FORM_SPHERE,
            Form::Cone { r0, r1 } => {
                record.form = records::FORM_CONE;
                (record.r0, record.r1) = (*r0 as f32, *r1 as f32);
            }
            Form::Capsule { length } => {
                record.form = records::FORM_CAPSULE;
                record.length = *length as f32;
            }
            Form::HalfSpaces { planes, hidden } => {
                record.form = records::FORM_HALF_SPACES;
                record.first_plane = self.vectors.len() as u32;
                record.plane_count = planes.len() as u32;
                record.hidden = *hidden as u32;
                let to_world = volume.local_from_world.matrix3.transpose();
                for plane in planes {
                    self.vectors.push(ray.plane(plane, perspective));
                    self.vectors.push(extended((to_world * plane.normal).normalize_or_zero()));
                }
            }
            Form::Empty => record.form = records::FORM_EMPTY,
        }
    }
}

fn set_map(record: &mut LensRecord, map: &DepthMap, holds_eye: bool) {
    record.flags |= records::LENS_DEPTH_MAP | if holds_eye { records::LENS_HOLDS_EYE } else { 0 };
    record.map_first = map.first as u32;
    record.map_min = map.rect.min;
    record.map_size = [map.rect.max[0] - map.rect.min[0], map.rect.max[1] - map.rect.min[1]];
}
