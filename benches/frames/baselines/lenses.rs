//! The lenses of a plan as closed forms around the eye.

use glam::DVec3;
use lenspeel::lens::{Form, MeshSolid, Plane, Solid};
use lenspeel::plan::{Lens, Plan};

/// A lens of one convex part.
pub enum Closed {
    Sphere {
        /// Relative to the eye, in the world.
        center: DVec3,
        radius: f64,
    },
    /// Unit normals, outward, and offsets.
    Planes(Vec<[f32; 4]>),
}

/// A lens's closed form; `None` where this baseline knows none.
pub fn closed(lens: &Lens, plan: &Plan) -> Option<Closed> {
    let [solid] = &lens.volume.parts[..] else { return None };
    match &solid.form {
        Form::Sphere if is_round(solid) => {
            let center = solid.world_from_local.translation - plan.view.eye;
            Some(Closed::Sphere { center, radius: solid.world_from_local.matrix3.x_axis.length() })
        }
        Form::HalfSpaces { planes, hidden: 0 } => {
            Some(Closed::Planes(planes.iter().map(|p| around_eye(solid, p.normal, p.offset, plan.view.eye)).collect()))
        }
        Form::Mesh(mesh) => {
            let planes = hull_planes(mesh)?;
            Some(Closed::Planes(planes.iter().map(|p| around_eye(solid, p.normal, p.offset, plan.view.eye)).collect()))
        }
        _ => None,
    }
}

/// The planes of a mesh's triangles; `None` where it is not convex.
fn hull_planes(mesh: &MeshSolid) -> Option<Vec<Plane>> {
    let middle = mesh.tree.vertices.iter().sum::<DVec3>() / mesh.tree.vertices.len() as f64;
    let outward = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|i| mesh.tree.vertices[i as usize]);
        let normal = (b - a).cross(c - a);
        Plane::through(if normal.dot(a - middle) < 0.0 { -normal } else { normal }, a)
    };
    let planes: Vec<Plane> = mesh.tree.triangles.iter().map(outward).collect();
    let holds = |p: &Plane| mesh.tree.vertices.iter().all(|v| p.distance(*v) < 1e-6);
    planes.iter().all(holds).then_some(planes)
}

/// Whether the map of a unit sphere stretches no axis more than another.
fn is_round(solid: &Solid) -> bool {
    let axes = solid.world_from_local.matrix3;
    let [x, y, z] = [axes.x_axis, axes.y_axis, axes.z_axis].map(DVec3::length);
    (x - y).abs().max((x - z).abs()) < 1e-9 * x
}

/// A plane of a solid's own space, in the world around the eye.
fn around_eye(solid: &Solid, normal: DVec3, offset: f64, eye: DVec3) -> [f32; 4] {
    let map = &solid.local_from_world;
    let world = map.matrix3.transpose() * normal;
    let offset = offset - normal.dot(map.transform_point3(eye));
    (world / world.length()).extend(offset / world.length()).as_vec4().to_array()
}

/// Centres and squared radii, where all lenses of a plan are spheres.
pub fn spheres(plan: &Plan) -> Option<Vec<[f32; 4]>> {
    let sphere = |lens| match closed(lens, plan)? {
        Closed::Sphere { center, radius } => Some(center.extend(radius * radius).as_vec4().to_array()),
        Closed::Planes(_) => None,
    };
    plan.lenses.iter().map(sphere).collect()
}
