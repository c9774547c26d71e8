//! The parts of lenses as records: solids as functions of the pixel, and their surfaces.

use glam::{DAffine3, DMat3, DVec3};

use super::cells::{Cells, has_planes};
use super::records::{self, PartRecord, extended, rows};
use crate::lens::{Form, MeshSolid, Plane, Solid};
use crate::view::View;

/// A triangle's first corner has in its upper bits the slot of its piece; twin of `mesh.wgsl`.
const SLOT_SHIFT: u32 = 26;

/// Parts with the vectors that they point into.
#[derive(Debug, Clone, Default)]
pub struct PartData {
    pub records: Vec<PartRecord>,
    /// Planes and corners.
    pub vectors: Vec<[f32; 4]>,
    /// Meshes, and the programs of lenses and rules.
    pub words: Vec<u32>,
}

/// The pixels' rays in some space: that of the picture's middle, and steps across the picture by a pixel, of which parts
/// ([`View::shares`]) count for origins and for directions.
#[derive(Debug, Clone, Copy)]
struct AffineRay {
    origin: DVec3,
    direction: DVec3,
    dx: DVec3,
    dy: DVec3,
}

impl AffineRay {
    /// `local`: the map from the space around the view's origin.
    fn new(view: &View, local: &DAffine3) -> Self {
        let (dx, dy) = view.pixel_steps();
        Self {
            origin: local.translation,
            direction: local.transform_vector3(view.forward),
            dx: local.transform_vector3(dx),
            dy: local.transform_vector3(dy),
        }
    }

    /// The coefficients of a plane: the middle ray's distance and rate, and what a pixel's steps add; over `length`, that of
    /// its gradient in the world: faces of two lenses that lie in one plane come out alike, and at one depth.
    fn plane(&self, plane: &Plane, length: f64) -> [f32; 4] {
        let n = plane.normal / length;
        [plane.distance(self.origin) / length, n.dot(self.direction), n.dot(self.dx), n.dot(self.dy)].map(|c| c as f32)
    }

    /// How far outside the surfaces of a form its origin is, as squares: of a ball, of the side of a cone or a capsule, and
    /// of the ball at a capsule's other end.
    fn outside(&self, form: &Form) -> [f64; 3] {
        let o = self.origin;
        let ball = |p: DVec3| p.length_squared() - 1.0;
        let side = |radius: f64| o.truncate().length_squared() - radius * radius;
        match form {
            Form::Sphere => [ball(o), 0.0, 0.0],
            Form::Cone { r0, r1 } => [0.0, side(r0 + (r1 - r0) * o.z), 0.0],
            Form::Capsule { length } => [ball(o), side(1.0), ball(o - DVec3::Z * *length)],
            Form::HalfSpaces { .. } | Form::Mesh(_) | Form::Empty => [0.0; 3],
        }
    }
}

/// A part's own space.
struct PartFrame {
    /// From the space around the view's origin.
    local: DAffine3,
    /// The pixels' rays in it.
    ray: AffineRay,
    /// From gradients in it to those in the world.
    to_world: DMat3,
}

impl PartData {
    /// Appends a part of the lens of the given rank. `whole`: a mesh is asked for more than where pixels' rays cross it.
    pub fn add(&mut self, view: &View, rank: u32, solid: &Solid, cells: Option<&Cells>, whole: bool, crossings: u32) {
        let local = solid.local_from_world * DAffine3::from_translation(view.origin());
        let ray = AffineRay::new(view, &local);
        let outside = ray.outside(&solid.form);
        let with = |v: DVec3, w: f64| v.extend(w).as_vec4().to_array();
        let normals = solid.local_from_world.matrix3.transpose();
        let [local_x, local_y, local_z] = rows(&local);
        let mut record = PartRecord {
            ray_origin: with(ray.origin, outside[0]),
            ray_direction: with(ray.direction, outside[1]),
            ray_dx: with(ray.dx, outside[2]),
            ray_dy: extended(ray.dy),
            normal_x: extended(normals.x_axis),
            normal_y: extended(normals.y_axis),
            normal_z: extended(normals.z_axis),
            local_x,
            local_y,
            local_z,
            lens: rank,
            ..bytemuck::Zeroable::zeroed()
        };
        if solid.is_flat {
            record.flags |= records::PART_FLAT;
            record.first_corner = self.vectors.len() as u32;
            record.corner_count = solid.hull.len() as u32;
            self.vectors.extend(solid.hull.iter().map(|p| extended(*p - view.origin())));
        }
        let frame = PartFrame { local, ray, to_world: normals };
        self.set_form(&mut record, solid, &frame);
        match &solid.form {
            Form::Mesh(mesh) if has_planes(mesh) => {
                record.form = records::FORM_HALF_SPACES;
                self.set_planes(&mut record, mesh.planes(), &frame);
            }
            Form::Mesh(mesh) => {
                record.crossing_room = crossings;
                let projected = cells.and_then(|cells| cells.projected.as_ref());
                if mesh.is_by_parity() {
                    record.flags |= records::PART_PARITY;
                }
                if whole || projected.is_none() || mesh.is_by_parity() {
                    self.set_mesh(&mut record, mesh);
                }
                if let Some(projected) = projected {
                    record.first_projected = self.vectors.len() as u32;
                    (record.origin, record.reference) = (projected.origin, projected.reference);
                    self.vectors.extend_from_slice(&projected.vectors);
                }
            }
            _ => {}
        }
        self.records.push(record);
    }

    fn set_form(&mut self, record: &mut PartRecord, solid: &Solid, frame: &PartFrame) {
        match &solid.form {
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
                record.hidden = *hidden as u32;
                self.set_planes(record, planes.iter().copied().map(Some), frame);
            }
            Form::Mesh(_) => record.form = records::FORM_MESH,
            Form::Empty => record.form = records::FORM_EMPTY,
        }
    }

    /// Planes of the part's own space; `None` stands for one that keeps nothing out.
    fn set_planes(&mut self, record: &mut PartRecord, planes: impl Iterator<Item = Option<Plane>>, frame: &PartFrame) {
        record.first_plane = self.vectors.len() as u32;
        for plane in planes {
            record.plane_count += 1;
            let Some(plane) = plane else {
                self.vectors.extend([[0.0; 4], [0.0, 0.0, 0.0, 1e37]]);
                continue;
            };
            let gradient = frame.to_world * plane.normal;
            let length = gradient.length();
            self.vectors.push(frame.ray.plane(&plane, length));
            let offset = (plane.offset - plane.normal.dot(frame.local.translation)) / length;
            self.vectors.push(gradient.normalize_or_zero().extend(offset).as_vec4().to_array());
        }
    }

    fn set_mesh(&mut self, record: &mut PartRecord, mesh: &MeshSolid) {
        record.first_node = self.words.len() as u32;
        record.node_count = mesh.tree.nodes.len() as u32;
        self.words.extend_from_slice(bytemuck::cast_slice(&mesh.tree.nodes));
        record.first_triangle = self.words.len() as u32;
        let faces = mesh.tree.triangles.iter().zip(&mesh.roles);
        self.words.extend(faces.flat_map(|([a, b, c], role)| [a | role.slot() << SLOT_SHIFT, *b, *c]));
        record.first_vertex = self.words.len() as u32;
        self.words.extend(mesh.tree.vertices.iter().flat_map(|v| v.as_vec3().to_array()).map(f32::to_bits));
    }
}
