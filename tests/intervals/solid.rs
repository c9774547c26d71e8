//! Random lens shapes, with what plain geometry says of them: support points and a mesh.

use glam::{DAffine3, DMat3, DQuat, DVec3};
use lenspeel::lens::{Interval, LensMeshes, Placement, Volume, build_volume};
use lenspeel::spec::{At, Rotation, Shape};
use lenspeel::view::{Ray, View};

use crate::facets::{Triangle, capsule_profile, corners_of_planes, frame, hull_facets, lathe};
use crate::random::Random;

pub const KINDS: [&str; 11] =
    ["sphere", "ellipsoid", "cuboid", "cylinder", "cone", "apex", "capsule", "ball", "polytope", "hull", "flat"];

/// How much farther from the eye than its corners the end of a flat lens without depth is put in the mesh.
const FAR_AWAY: f64 = 1e4;

/// What a shape is the convex hull of.
enum Body {
    /// The unit ball under a linear map, about a point.
    Ellipsoid(DVec3, DMat3),
    /// Two balls of one radius.
    Balls([DVec3; 2], f64),
    /// Two discs across the line between their centres.
    Discs([DVec3; 2], [f64; 2]),
    Points(Vec<DVec3>),
}

/// A triangle of an inscribed mesh, world space.
pub struct Facet {
    pub corners: Triangle,
    /// Unit, outward.
    pub normal: DVec3,
    /// `normal·p` on the triangle, and its most over the whole solid: how far the solid bulges out of the mesh.
    pub offset: f64,
    pub reach: f64,
}

pub struct Solid {
    pub volume: Volume,
    pub facets: Vec<Facet>,
    /// World space, well inside.
    pub middle: DVec3,
    /// The largest distance between points of the mesh; of a flat lens, of its corners.
    pub size: f64,
    pub is_flat: bool,
    body: Body,
    map: DAffine3,
    /// Of a flat lens, world space.
    corners: Vec<DVec3>,
}

/// The volume of a shape that names no mesh.
pub fn build(shape: &Shape, placement: &Placement, view: &View) -> Result<Volume, String> {
    let shape = At::new(shape.clone(), 0..0);
    build_volume(&shape, placement, view, &LensMeshes::default()).map_err(|reason| reason.value)
}

/// The interval of a convex volume.
pub fn only_interval(volume: &Volume, ray: &Ray, near: f64, far: f64) -> Option<Interval> {
    let mut found = Vec::new();
    volume.intervals(ray, near, far, &mut found);
    assert!(found.len() <= 1, "{found:?}");
    found.pop()
}

impl Solid {
    /// The interval that the library finds; these solids have at most one.
    pub fn interval(&self, ray: &Ray, near: f64, far: f64) -> Option<Interval> {
        only_interval(&self.volume, ray, near, far)
    }

    /// The farthest point of the solid along a direction.
    pub fn support(&self, normal: DVec3) -> DVec3 {
        self.map.transform_point3(self.body.support(self.map.matrix3.transpose() * normal))
    }

    /// What is in front of the eye, by depth; of a flat lens, its corners and a stretch behind them.
    pub fn depths(&self, view: &View) -> [f64; 2] {
        if !self.is_flat {
            return [-view.forward, view.forward].map(|n| view.depth(self.support(n)));
        }
        let depths = || self.corners.iter().map(|p| view.depth(*p));
        [depths().fold(f64::INFINITY, f64::min), depths().fold(f64::NEG_INFINITY, f64::max) + 3.0 * self.size]
    }

    /// `None` for a flat lens seen almost edge on.
    pub fn new(kind: &str, random: &mut Random, placement: &Placement, view: &View) -> Option<Self> {
        let shape = shape(kind, random);
        let map = placement.attach * own_map(placement);
        let volume = build(&shape, placement, view).unwrap_or_else(|e| panic!("{shape:?}: {e}"));
        let (body, triangles, map, corners, between) = match &shape {
            Shape::Flat { corners, depth } => {
                let corners: Vec<DVec3> = corners.iter().map(|c| map.transform_point3(DVec3::from_array(*c))).collect();
                let (points, between) = frustum(&corners, *depth, &map, view)?;
                (Body::Points(points.clone()), hull_facets(&points), DAffine3::IDENTITY, corners, Some(between))
            }
            other => {
                let (body, triangles) = geometry(other);
                (body, triangles, map, Vec::new(), None)
            }
        };
        let is_flat = volume.is_flat();
        let triangles: Vec<Triangle> = triangles.into_iter().map(|t| t.map(|p| map.transform_point3(p))).collect();
        let middle = between.unwrap_or_else(|| middle(&triangles));
        let mut solid = Self { volume, facets: Vec::new(), middle, size: 0.0, is_flat, body, map, corners };
        let measured: Vec<DVec3> =
            if is_flat { solid.corners.clone() } else { triangles.iter().flatten().copied().collect() };
        solid.size = measured.iter().map(|p| p.distance(measured[0])).fold(0.0, f64::max);
        solid.facets = triangles.into_iter().map(|t| solid.facet(t)).collect();
        Some(solid)
    }

    fn facet(&self, corners: Triangle) -> Facet {
        let normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]).normalize();
        let normal = if normal.dot(corners[0] - self.middle) < 0.0 { -normal } else { normal };
        let reach = normal.dot(self.support(normal));
        Facet { corners, normal, offset: normal.dot(corners[0]), reach }
    }

    /// A random point inside.
    pub fn inner(&self, random: &mut Random) -> DVec3 {
        let tip = self.support(direction(random));
        let near = (self.size / tip.distance(self.middle)).min(1.0);
        self.middle + (tip - self.middle) * near * random.between(0.0, 0.9)
    }
}

fn middle(triangles: &[Triangle]) -> DVec3 {
    triangles.iter().flatten().sum::<DVec3>() / (3 * triangles.len()) as f64
}

impl Body {
    fn support(&self, n: DVec3) -> DVec3 {
        let farther = |a: DVec3, b: DVec3| if n.dot(b) > n.dot(a) { b } else { a };
        match self {
            Body::Ellipsoid(center, map) => *center + *map * (map.transpose() * n).normalize(),
            Body::Balls([a, b], radius) => farther(*a, *b) + n.normalize() * *radius,
            Body::Discs([a, b], [r0, r1]) => {
                let axis = (*b - *a).normalize();
                let across = n - axis * n.dot(axis);
                // Along the axis all of a cap is as far.
                let across = if across.length() > 1e-9 * n.length() { across.normalize() } else { DVec3::ZERO };
                farther(*a + across * *r0, *b + across * *r1)
            }
            Body::Points(points) => points.iter().copied().reduce(farther).expect("a solid has corners"),
        }
    }
}

/// Translation, rotation and scale as the format has them, by matrices.
fn own_map(placement: &Placement) -> DAffine3 {
    let scale = DMat3::from_diagonal(DVec3::from_array(placement.scale));
    let matrix = rotation_matrix(placement.rotation) * scale;
    DAffine3::from_mat3_translation(matrix, DVec3::from_array(placement.translation))
}

/// Intrinsic XYZ: about x, then about the turned y, then about the twice turned z.
fn rotation_matrix(rotation: Rotation) -> DMat3 {
    match rotation {
        Rotation::Euler(degrees) => {
            let [x, y, z] = degrees.map(|d| d.to_radians());
            DMat3::from_rotation_x(x) * DMat3::from_rotation_y(y) * DMat3::from_rotation_z(z)
        }
        Rotation::Quaternion([x, y, z, w]) => {
            let [x, y, z, w] = [x, y, z, w].map(|c| c / (x * x + y * y + z * z + w * w).sqrt());
            DMat3::from_cols(
                DVec3::new(1.0 - 2.0 * (y * y + z * z), 2.0 * (x * y + w * z), 2.0 * (x * z - w * y)),
                DVec3::new(2.0 * (x * y - w * z), 1.0 - 2.0 * (x * x + z * z), 2.0 * (y * z + w * x)),
                DVec3::new(2.0 * (x * z + w * y), 2.0 * (y * z - w * x), 1.0 - 2.0 * (x * x + y * y)),
            )
        }
    }
}

/// The body of a shape that is not flat, and triangles on its surface, in its own space.
fn geometry(shape: &Shape) -> (Body, Vec<Triangle>) {
    let v = DVec3::from_array;
    let turned = |triangles: Vec<Triangle>, matrix: DMat3, origin: DVec3| {
        triangles.into_iter().map(|t| t.map(|p| origin + matrix * p)).collect()
    };
    let solid = |points: Vec<DVec3>| {
        let facets = hull_facets(&points);
        (Body::Points(points), facets)
    };
    match shape {
        Shape::Sphere { center, radius } => {
            let mesh = turned(lathe(&capsule_profile(0.0)), DMat3::from_diagonal(DVec3::splat(*radius)), v(*center));
            (Body::Balls([v(*center); 2], *radius), mesh)
        }
        Shape::Ellipsoid { center, radii, rotation } => {
            let map = rotation_matrix(*rotation) * DMat3::from_diagonal(v(*radii));
            (Body::Ellipsoid(v(*center), map), turned(lathe(&capsule_profile(0.0)), map, v(*center)))
        }
        Shape::Box { center, size, rotation } => {
            let signs = |i: usize| DVec3::new((i & 1) as f64, (i >> 1 & 1) as f64, (i >> 2) as f64) - 0.5;
            let map = rotation_matrix(*rotation);
            solid((0..8).map(|i| v(*center) + map * (v(*size) * signs(i))).collect())
        }
        Shape::Cylinder { from, to, radius } => cone(v(*from), v(*to), *radius, *radius),
        Shape::Cone { from, to, from_radius, to_radius } => cone(v(*from), v(*to), *from_radius, *to_radius),
        Shape::Capsule { from, to, radius } => {
            let (from, to) = (v(*from), v(*to));
            let axes = frame(if from == to { DVec3::Z } else { to - from });
            let mesh = lathe(&capsule_profile(from.distance(to) / radius));
            (Body::Balls([from, to], *radius), turned(mesh, axes * *radius, from))
        }
        Shape::Polytope { planes } => solid(corners_of_planes(planes)),
        Shape::Hull { points } => solid(points.iter().map(|p| v(*p)).collect()),
        _ => unreachable!("a flat lens depends on the eye, and others are not drawn here"),
    }
}

fn cone(from: DVec3, to: DVec3, r0: f64, r1: f64) -> (Body, Vec<Triangle>) {
    let length = from.distance(to);
    let mesh = lathe(&[(0.0, 0.0), (r0, 0.0), (r1, length), (0.0, length)]);
    let axes = frame(to - from);
    (Body::Discs([from, to], [r0, r1]), mesh.into_iter().map(|t| t.map(|p| from + axes * p)).collect())
}

/// The corners of what the eye sees through a polygon (SEMANTICS 2.5), and the same a way farther from the eye;
/// with a point between them.
fn frustum(corners: &[DVec3], depth: Option<f64>, map: &DAffine3, view: &View) -> Option<(Vec<DVec3>, DVec3)> {
    let shape_from_world = map.inverse();
    let own: Vec<DVec3> = corners.iter().map(|c| shape_from_world.transform_point3(*c)).collect();
    let normal = (own[1] - own[0]).cross(own[2] - own[0]).normalize();
    let size = own.iter().map(|p| p.distance(own[0])).fold(0.0, f64::max);
    let sight = |corner: DVec3| if view.is_perspective() { corner - view.eye } else { view.forward };
    // How far one step along the line of sight of a corner leads away from the plane of the polygon.
    let step = normal.dot(shape_from_world.transform_vector3(sight(corners[0]))).abs();
    if step < 0.1 * if view.is_perspective() { size } else { 1.0 } {
        return None;
    }
    let steps = depth.map_or(FAR_AWAY, |depth| depth / step);
    let points = corners.iter().copied().chain(corners.iter().map(|c| *c + sight(*c) * steps)).collect();
    let center = corners.iter().sum::<DVec3>() / corners.len() as f64;
    Some((points, center + sight(center) * 0.5 * steps.min(1.0)))
}

pub fn direction(random: &mut Random) -> DVec3 {
    loop {
        let v = point(random, 1.0);
        if (0.1..1.0).contains(&v.length()) {
            return v.normalize();
        }
    }
}

fn point(random: &mut Random, reach: f64) -> DVec3 {
    DVec3::from_array(std::array::from_fn(|_| random.between(-reach, reach)))
}

pub fn rotation(random: &mut Random) -> Rotation {
    if random.chance(0.5) {
        Rotation::Euler(point(random, 180.0).to_array())
    } else {
        let axis = direction(random) * random.between(0.1, 3.0);
        Rotation::Quaternion([axis.x, axis.y, axis.z, random.between(-2.0, 2.0)])
    }
}

/// Attached to the scene, the camera or a node that is itself moved, turned and scaled; often mirrored.
pub fn placement(random: &mut Random, view: &View) -> Placement {
    let scale = |random: &mut Random| random.between(0.4, 2.5) * if random.chance(0.3) { -1.0 } else { 1.0 };
    let node = DAffine3::from_scale_rotation_translation(
        DVec3::new(scale(random), scale(random), scale(random)),
        DQuat::from_axis_angle(direction(random), random.between(0.0, 6.0)),
        point(random, 2.0),
    );
    let camera = DAffine3::from_mat3_translation(DMat3::from_cols(view.right, view.up, -view.forward), view.eye);
    Placement {
        attach: [DAffine3::IDENTITY, camera, node][random.index(3)],
        translation: point(random, 2.0).to_array(),
        rotation: rotation(random),
        scale: [scale(random), scale(random), scale(random)],
    }
}

fn shape(kind: &str, random: &mut Random) -> Shape {
    let center = point(random, 1.0);
    let (from, to) = (center.to_array(), (center + direction(random) * random.between(0.3, 2.0)).to_array());
    let radius = random.between(0.2, 1.2);
    let three = |random: &mut Random| std::array::from_fn(|_| random.between(0.3, 1.6));
    match kind {
        "sphere" => Shape::Sphere { center: from, radius },
        "ellipsoid" => Shape::Ellipsoid { center: from, radii: three(random), rotation: rotation(random) },
        "cuboid" => Shape::Box { center: from, size: three(random), rotation: rotation(random) },
        "cylinder" => Shape::Cylinder { from, to, radius },
        "cone" => Shape::Cone { from, to, from_radius: radius, to_radius: random.between(0.2, 1.2) },
        "apex" if random.chance(0.5) => Shape::Cone { from, to, from_radius: radius, to_radius: 0.0 },
        "apex" => Shape::Cone { from, to, from_radius: 0.0, to_radius: radius },
        "capsule" => Shape::Capsule { from, to, radius },
        "ball" => Shape::Capsule { from, to: from, radius },
        "polytope" => polytope(random),
        "hull" => Shape::Hull { points: (0..5 + random.index(5)).map(|_| point(random, 1.0).to_array()).collect() },
        "flat" => flat(random),
        other => panic!("no shape `{other}`"),
    }
}

/// A skewed box with a few corners cut off; its normals have any length.
fn polytope(random: &mut Random) -> Shape {
    let axes = DVec3::AXES.into_iter().flat_map(|axis| [axis, -axis]);
    let mut normals: Vec<DVec3> = axes.map(|axis| axis + point(random, 0.3)).collect();
    normals.extend((0..random.index(4)).map(|_| direction(random)));
    let plane = |n: DVec3| {
        let n = n * random.between(0.5, 2.0);
        [n.x, n.y, n.z, n.length() * random.between(0.5, 1.2)]
    };
    Shape::Polytope { planes: normals.into_iter().map(plane).collect() }
}

/// Points of an ellipse in their order around it, apart from each other.
fn flat(random: &mut Random) -> Shape {
    let axes = frame(direction(random));
    let (center, count) = (point(random, 1.0), 3 + random.index(4));
    let (a, b) = (random.between(0.5, 1.5), random.between(0.5, 1.5));
    let corner = |i: usize| {
        let angle = std::f64::consts::TAU * (i as f64 + random.between(-0.3, 0.3)) / count as f64;
        (center + axes.x_axis * a * angle.cos() + axes.y_axis * b * angle.sin()).to_array()
    };
    let corners = (0..count).map(corner).collect();
    Shape::Flat { corners, depth: random.chance(0.5).then(|| random.between(0.3, 2.0)) }
}
