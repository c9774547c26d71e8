//! From a shape as written to a volume in the world.

use glam::{DAffine3, DMat3, DQuat, DVec3};

use super::halfspaces::NotSolid;
use super::hull::hull_form;
use super::{Form, LensMeshes, Plane, Polyhedron, Solid, Tree, Volume};
use crate::scene::Aabb;
use crate::spec::{At, Rotation, Shape};
use crate::view::{Projection, View};

/// Where a lens stands: `world = attach * T * R * S * shape space`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Placement {
    /// World from the space the lens is attached to.
    pub attach: DAffine3,
    pub translation: [f64; 3],
    pub rotation: Rotation,
    pub scale: [f64; 3],
}

impl Placement {
    pub fn world_from_shape(&self) -> DAffine3 {
        let own = DAffine3::from_scale_rotation_translation(
            DVec3::from_array(self.scale),
            quaternion(self.rotation),
            DVec3::from_array(self.translation),
        );
        self.attach * own
    }
}

pub fn quaternion(rotation: Rotation) -> DQuat {
    match rotation {
        Rotation::Euler(degrees) => {
            let [x, y, z] = degrees.map(f64::to_radians);
            DQuat::from_euler(glam::EulerRot::XYZ, x, y, z)
        }
        Rotation::Quaternion(q) => DQuat::from_array(q).normalize(),
    }
}

/// The volume of a shape, or one sentence on why it has none, with the place of the part that is meant.
///
/// `meshes` holds what the scene has opened for `mesh` shapes.
pub fn build_volume(
    shape: &At<Shape>,
    placement: &Placement,
    view: &View,
    meshes: &LensMeshes,
) -> Result<Volume, At<String>> {
    let world = placement.world_from_shape();
    if !(world.matrix3.determinant().abs() > 1e-30 && world.is_finite()) {
        let reason = "its scale, rotation and the node it is attached to leave no volume".to_owned();
        return Err(At::new(reason, shape.span.clone()));
    }
    let mut parts = Vec::new();
    for shape in shape.parts() {
        parts.push(part(&shape.value, world, view, meshes).map_err(|reason| At::new(reason, shape.span.clone()))?);
    }
    let tree = tree(&shape.value, &mut 0);
    Ok(Volume { center: center(&tree, &parts), parts, tree })
}

/// The mean of the centres of what is put together; of a part its own.
fn center(tree: &Tree, parts: &[Solid]) -> DVec3 {
    match tree {
        Tree::Part(part) => parts[*part].center,
        Tree::Union(list) | Tree::Intersection(list) | Tree::Difference(list) => {
            list.iter().map(|tree| center(tree, parts)).sum::<DVec3>() / list.len() as f64
        }
    }
}

/// The tree of a shape whose parts are numbered in the order of the file, from `next` on.
fn tree(shape: &Shape, next: &mut usize) -> Tree {
    let mut trees = |list: &[At<Shape>]| list.iter().map(|shape| tree(&shape.value, next)).collect();
    match shape {
        Shape::Union(list) => Tree::Union(trees(list)),
        Shape::Intersection(list) => Tree::Intersection(trees(list)),
        Shape::Difference(list) => Tree::Difference(trees(list)),
        _ => {
            *next += 1;
            Tree::Part(*next - 1)
        }
    }
}

fn part(shape: &Shape, world: DAffine3, view: &View, meshes: &LensMeshes) -> Result<Solid, String> {
    let v = DVec3::from_array;
    match shape {
        Shape::Sphere { center, radius } => Ok(ball(world, v(*center), DQuat::IDENTITY, DVec3::splat(*radius))),
        Shape::Ellipsoid { center, radii, rotation } => Ok(ball(world, v(*center), quaternion(*rotation), v(*radii))),
        Shape::Box { center, size, rotation } => {
            let pose = DAffine3::from_scale_rotation_translation(v(*size) * 0.5, quaternion(*rotation), v(*center));
            Ok(solid(Form::HalfSpaces { planes: cube_planes(), hidden: 0 }, world * pose, unit_corners(-1.0)))
        }
        Shape::Cylinder { from, to, radius } => Ok(cone(world, v(*from), v(*to), *radius, *radius)),
        Shape::Cone { from, to, from_radius, to_radius } => Ok(cone(world, v(*from), v(*to), *from_radius, *to_radius)),
        Shape::Capsule { from, to, radius } => Ok(capsule(world, v(*from), v(*to), *radius)),
        Shape::Polytope { planes } => polytope(world, planes),
        Shape::Hull { points } => {
            let points: Vec<DVec3> = points.iter().map(|p| v(*p)).collect();
            let (form, pose) = hull_form(&points)
                .map_err(|_| "its points lie in one plane or on one line, so their hull has no volume".to_string())?;
            let into_form = pose.inverse();
            Ok(solid(form, world * pose, points.iter().map(|p| into_form.transform_point3(*p)).collect()))
        }
        Shape::HalfSpace { point, normal } => {
            Ok(unbounded(world, v(*point), &[Plane::through(v(*normal), DVec3::ZERO)]))
        }
        Shape::Slab { point, normal, thickness } => {
            let sides = [v(*normal), -v(*normal)].map(|normal| Plane::new(normal.normalize(), 0.5 * thickness));
            Ok(unbounded(world, v(*point), &sides))
        }
        Shape::Flat { corners, depth } => flat(world, corners, *depth, view),
        Shape::Mesh(mesh) => {
            let mesh = meshes.get(mesh).ok_or("the scene was opened without its mesh")?;
            Ok(solid(mesh.form.clone(), world * mesh.pose, mesh.corners.to_vec()))
        }
        Shape::Union(_) | Shape::Intersection(_) | Shape::Difference(_) => Err("it is made of parts".into()),
    }
}

/// A solid bounded by the hull of `corners` in its canonical space; its centre is the middle of their bounds.
fn solid(form: Form, world_from_local: DAffine3, corners: Vec<DVec3>) -> Solid {
    let center = Aabb::from_points(corners.iter().copied()).center();
    let hull = corners.iter().map(|p| world_from_local.transform_point3(*p)).collect();
    Solid::new(form, world_from_local, hull, world_from_local.transform_point3(center), false)
}

/// What lies inside planes that leave a side open, given around `point`, its centre.
fn unbounded(world: DAffine3, point: DVec3, planes: &[Plane]) -> Solid {
    let pose = world * DAffine3::from_translation(point);
    let form = Form::HalfSpaces { planes: planes.to_vec(), hidden: 0 };
    Solid::new(form, pose, Vec::new(), pose.translation, false)
}

/// Corners of the cube from `low` to 1.
fn unit_corners(low: f64) -> Vec<DVec3> {
    Aabb { min: DVec3::splat(low), max: DVec3::ONE }.corners().to_vec()
}

fn cube_planes() -> Vec<Plane> {
    [DVec3::X, DVec3::Y, DVec3::Z].into_iter().flat_map(|n| [Plane::new(n, 1.0), Plane::new(-n, 1.0)]).collect()
}

fn ball(world: DAffine3, center: DVec3, rotation: DQuat, radii: DVec3) -> Solid {
    let pose = DAffine3::from_scale_rotation_translation(radii, rotation, center);
    solid(Form::Sphere, world * pose, unit_corners(-1.0))
}

/// A pose with its origin at `from` and +z towards `to`.
fn axis_pose(from: DVec3, to: DVec3, radial: f64, along: f64) -> DAffine3 {
    let z = (to - from).normalize_or(DVec3::Z);
    let (x, y) = z.any_orthonormal_pair();
    DAffine3::from_mat3_translation(DMat3::from_cols(x * radial, y * radial, z * along), from)
}

fn cone(world: DAffine3, from: DVec3, to: DVec3, r0: f64, r1: f64) -> Solid {
    let radius = r0.max(r1);
    let pose = axis_pose(from, to, radius, from.distance(to));
    let corners = Aabb { min: DVec3::new(-1.0, -1.0, 0.0), max: DVec3::ONE }.corners().to_vec();
    solid(Form::Cone { r0: r0 / radius, r1: r1 / radius }, world * pose, corners)
}

fn capsule(world: DAffine3, from: DVec3, to: DVec3, radius: f64) -> Solid {
    let length = from.distance(to) / radius;
    let corners = Aabb { min: DVec3::NEG_ONE, max: DVec3::new(1.0, 1.0, length + 1.0) }.corners().to_vec();
    solid(Form::Capsule { length }, world * axis_pose(from, to, radius, radius), corners)
}

fn polytope(world: DAffine3, planes: &[[f64; 4]]) -> Result<Solid, String> {
    let planes: Vec<Plane> = planes.iter().map(|[x, y, z, d]| Plane::new(DVec3::new(*x, *y, *z), *d)).collect();
    let faces = Polyhedron::from_planes(&planes).map_err(|reason| match reason {
        NotSolid::Unbounded => "its planes leave a side open, and a polytope must be bounded".to_string(),
        NotSolid::Empty => "its planes have no volume in common".to_string(),
    })?;
    Ok(solid(Form::HalfSpaces { planes, hidden: 0 }, world, faces.vertices().collect()))
}

/// What the eye sees through a polygon (SEMANTICS 2.5): a cone of planes through the eye, cut by the polygon's own plane.
fn flat(world: DAffine3, corners: &[[f64; 3]], depth: Option<f64>, view: &View) -> Result<Solid, String> {
    let corners: Vec<DVec3> = corners.iter().map(|c| DVec3::from_array(*c)).collect();
    let normal = polygon_normal(&corners)?;
    let center = corners.iter().sum::<DVec3>() / corners.len() as f64;
    let shape_from_world = world.inverse();
    let eye = shape_from_world.transform_point3(view.eye);
    let forward = shape_from_world.transform_vector3(view.forward);
    let size = Aabb::from_points(corners.iter().copied()).size().length();
    // The polygon's normal on the side away from the eye.
    let (away, edge_on) = match view.projection {
        Projection::Perspective { .. } => {
            let distance = normal.dot(center - eye);
            (normal * distance.signum(), distance.abs() <= 1e-9 * size.max((center - eye).length()))
        }
        Projection::Orthographic { .. } => {
            let along = normal.dot(forward);
            (normal * along.signum(), along.abs() <= 1e-9 * forward.length())
        }
    };
    let hull = corners.iter().map(|p| world.transform_point3(*p)).collect();
    let world_center = world.transform_point3(center);
    if edge_on {
        return Ok(Solid::new(Form::Empty, world, hull, world_center, true));
    }
    let mut planes: Vec<Plane> = (0..corners.len())
        .map(|i| {
            let (a, b) = (corners[i], corners[(i + 1) % corners.len()]);
            let sight = match view.projection {
                Projection::Perspective { .. } => a - eye,
                Projection::Orthographic { .. } => forward,
            };
            let side = sight.cross(b - a);
            Plane::through(if side.dot(center - a) > 0.0 { -side } else { side }, a)
        })
        .collect();
    let hidden = planes.len();
    planes.push(Plane::through(-away, center));
    if let Some(depth) = depth {
        planes.push(Plane::through(away, center + away * depth));
    }
    Ok(Solid::new(Form::HalfSpaces { planes, hidden }, world, hull, world_center, true))
}

/// Unit normal (Newell) of a polygon that is planar and convex, or what is wrong with it.
fn polygon_normal(corners: &[DVec3]) -> Result<DVec3, String> {
    let count = corners.len();
    let next = |i: usize| corners[(i + 1) % count];
    let newell: DVec3 = (0..count).map(|i| (corners[i] - corners[0]).cross(next(i) - corners[0])).sum();
    let size = Aabb::from_points(corners.iter().copied()).size().length();
    if newell.length() <= 1e-9 * size * size {
        return Err("its corners lie on one line or on one point".into());
    }
    let normal = newell.normalize();
    let center = corners.iter().sum::<DVec3>() / count as f64;
    let off = corners.iter().map(|c| normal.dot(*c - center).abs()).fold(0.0, f64::max);
    if off > 1e-4 * size {
        return Err(format!("its corners are not in one plane: one is {off:.4} away from it"));
    }
    let turn = |i: usize| (next(i) - corners[i]).cross(next((i + 1) % count) - next(i)).dot(normal);
    for i in 0..count {
        if turn(i) < -1e-9 * size * size {
            return Err(format!("its corners do not go round a convex polygon (look at corner {})", (i + 1) % count));
        }
    }
    if let Some(i) = (0..count).find(|i| corners[*i].distance(next(*i)) <= 1e-9 * size) {
        return Err(format!("its corners {i} and {} are the same", (i + 1) % count));
    }
    let turns: f64 = (0..count).map(|i| (next(i) - corners[i]).angle_between(next((i + 1) % count) - next(i))).sum();
    if turns > std::f64::consts::TAU + 1e-3 {
        return Err("its corners cross over each other".into());
    }
    Ok(normal)
}
